#include "docent/collision_avoidance/clocks/driver_stamps.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance {
namespace {

constexpr Pose2 kHere{1.0, 2.0, {}};
Time at(double seconds) { return time_from_seconds(seconds); }

TEST(DriverStamps, ZeroIsNone) {
  EXPECT_EQ(stamp_or({}, at(5.0)), at(5.0));
  EXPECT_EQ(stamp_or(at(4.0), at(5.0)), at(4.0));
  OdometryStamps stamps;
  EXPECT_EQ(stamps.mend(at(7.0), {}, kHere, false), at(7.0));
  EXPECT_EQ(stamps.mend(at(7.1), {}, kHere, false), at(7.1));
}

TEST(DriverStamps, WhoRepeatsThatItStandsSaysItOfNow) {
  OdometryStamps stamps;
  // The driver's clock is 3 s behind, and it stands since 7.02 s.
  EXPECT_EQ(stamps.mend(at(10.02), at(7.02), kHere, true), at(7.02));
  EXPECT_EQ(stamps.mend(at(10.04), at(7.02), kHere, true), at(7.02)) << "one may have come twice";
  EXPECT_EQ(stamps.mend(at(10.12), at(7.02), kHere, true), at(7.12));
  EXPECT_EQ(stamps.mend(at(40.02), at(7.02), kHere, true), at(37.02));
  EXPECT_EQ(stamps.mend(at(40.07), at(37.07), {1.001, 2.0, {}}, false), at(37.07)) << "it drives on";
  EXPECT_EQ(stamps.mend(at(40.09), at(37.07), {1.001, 2.0, {}}, true), at(37.07)) << "counted anew";
}

TEST(DriverStamps, WhoRepeatsThatItMovesHangs) {
  OdometryStamps stamps;
  for (int i = 0; i < 20; ++i) EXPECT_EQ(stamps.mend(at(10.0 + 0.05 * i), at(10.0), kHere, false), at(10.0));
}

}  // namespace
}  // namespace docent::collision_avoidance
