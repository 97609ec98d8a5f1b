#include "docent/recording/rising_stamps.h"

#include <gtest/gtest.h>

namespace docent::recording::rising_stamps_test {
namespace {

Time at(double time) { return time_from_seconds(100.0 + time); }

TEST(RisingStamps, StayAsTheyAre) {
  RisingStamps stamps;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(stamps.follow(at(0.05 * i)), at(0.05 * i));
  EXPECT_EQ(stamps.follow(at(4.8)), at(4.8)) << "overtaken";
  EXPECT_EQ(stamps.follow(at(4.85)), at(4.85)) << "likewise";
  EXPECT_EQ(stamps.follow(at(5.0)), at(5.0));
  EXPECT_EQ(stamps.set_back(), 0);
}

TEST(RisingStamps, GoOnWhenTheClockWasSetBack) {
  for (const double back : {0.5, 3.0, 1e6}) {
    RisingStamps stamps;
    for (int i = 0; i < 200; ++i) {
      const double true_time = 0.05 * i;
      const Time given = stamps.follow(at(i < 100 ? true_time : true_time - back));
      if (i < 100 || i >= 102) {
        EXPECT_NEAR(to_seconds(given - at(true_time)), 0.0, 1e-6) << i;
      }
    }
    EXPECT_EQ(stamps.set_back(), 1);
  }
}

}  // namespace
}  // namespace docent::recording::rising_stamps_test
