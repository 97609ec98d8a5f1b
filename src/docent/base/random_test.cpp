#include "docent/base/random.h"

#include <gtest/gtest.h>

#include <array>

namespace docent {
namespace {

TEST(Rng, TheSameSeedGivesTheSameDraws) {
  Rng a{7};
  Rng b{7};
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(a(), b());
}

TEST(Rng, FirstDrawsAreFixedForever) {
  // Golden values: a change here changes every recorded run.
  Rng rng{42};
  EXPECT_EQ(rng(), 15021278609987233951ULL);
  EXPECT_EQ(rng(), 5881210131331364753ULL);
}

TEST(Rng, StreamsWithOtherNamesDiffer) {
  const Rng rng{7};
  Rng a = rng.stream("crowd");
  Rng b = rng.stream("laser");
  EXPECT_NE(a(), b());
}

TEST(Rng, NormalHasMeanZeroAndVarianceOne) {
  Rng rng{1};
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = rng.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.01);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.02);
}

TEST(Rng, IntegersCoverTheRangeEvenly) {
  Rng rng{3};
  std::array<int, 6> counts{};
  for (int i = 0; i < 60000; ++i) ++counts[static_cast<std::size_t>(rng.integer(0, 5))];
  for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
}

}  // namespace
}  // namespace docent
