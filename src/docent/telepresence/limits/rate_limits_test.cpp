#include "docent/telepresence/limits/rate_limits.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(RateLimits, ABurstAndThenSoManyASecond) {
  RateLimits limits{{2.0, 3.0}};
  const Time now = time_from_seconds(100);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(limits.take("a", now));
  EXPECT_FALSE(limits.take("a", now));
  EXPECT_TRUE(limits.take("b", now)) << "another caller";
  EXPECT_TRUE(limits.take("a", now + seconds(0.5)));
  EXPECT_FALSE(limits.take("a", now + seconds(0.5)));
  EXPECT_FALSE(limits.take("a", now)) << "a clock that goes back gives nothing";
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(limits.take("a", now + seconds(100)));
  EXPECT_FALSE(limits.take("a", now + seconds(100)));
}

TEST(RateLimits, AFloodOfCallersDoesNotFreeTheOneWhoFloods) {
  RateLimits limits{{0.001, 3.0}, 100};
  const Time now = time_from_seconds(100);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(limits.take("flood", now));
  for (int i = 0; i < 10'000; ++i) {
    EXPECT_TRUE(limits.take("x" + std::to_string(i), now));
    EXPECT_LE(limits.size(), 100U);
  }
  EXPECT_FALSE(limits.take("flood", now));
}

}  // namespace
}  // namespace docent::telepresence
