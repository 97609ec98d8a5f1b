#include "docent/collision_avoidance/virtual_measurements/mount_doubt.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace docent::collision_avoidance::mount_doubt_test {

TEST(MountDoubt, SpreadsWhatIsNearOverTheHeadingsThatMayBe) {
  std::array<double, 180> ranges{};
  ranges.fill(6.0);
  ranges[1] = 1.0;
  lower_by_doubt(ranges, {6.0 * std::numbers::pi / 180.0, 0.2});
  EXPECT_DOUBLE_EQ(ranges[1], 0.8);
  EXPECT_DOUBLE_EQ(ranges[4], 0.8);
  EXPECT_DOUBLE_EQ(ranges[178], 0.8) << "all round";
  EXPECT_DOUBLE_EQ(ranges[5], 5.8);
}

TEST(MountDoubt, OfNothingChangesNothing) {
  std::array<double, 4> ranges{1.0, 2.0, 3.0, 0.05};
  const auto before = ranges;
  lower_by_doubt(ranges, {});
  EXPECT_EQ(ranges, before);
  lower_by_doubt(ranges, {0.0, 0.1});
  EXPECT_DOUBLE_EQ(ranges[3], 0.0) << "never below nought";
  lower_by_doubt(ranges, {0.0, 5.0, 0.35});
  EXPECT_DOUBLE_EQ(ranges[0], 0.35) << "the robot may leave";
  EXPECT_DOUBLE_EQ(ranges[3], 0.0);
}

}  // namespace docent::collision_avoidance::mount_doubt_test
