#include "docent/modules/message_fitness.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace docent {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

sensor_msgs::LaserScan scan_all_round() {
  sensor_msgs::LaserScan scan;
  scan.angle_min = -static_cast<float>(std::numbers::pi);
  scan.angle_increment = static_cast<float>(std::numbers::pi / 90.0);
  scan.range_max = 6.0F;
  scan.ranges.assign(180, 2.0F);
  return scan;
}

TEST(MessageFitness, AScanNeedsNumbersForItsBeamsNotForItsReadings) {
  EXPECT_TRUE(is_fit(scan_all_round()));
  for (const auto part : {&sensor_msgs::LaserScan::angle_min, &sensor_msgs::LaserScan::angle_increment,
                          &sensor_msgs::LaserScan::range_min, &sensor_msgs::LaserScan::range_max}) {
    auto scan = scan_all_round();
    scan.*part = kNan;
    EXPECT_FALSE(is_fit(scan));
    EXPECT_FALSE(is_fit_all_round(scan));
  }
  auto scan = scan_all_round();
  scan.ranges[7] = kNan;
  EXPECT_TRUE(is_fit(scan)) << "no reading";
  EXPECT_FALSE(is_fit_all_round(scan));
  scan.ranges.assign(1, 2.0F);
  EXPECT_FALSE(is_fit_all_round(scan)) << "most directions are missing";
}

TEST(MessageFitness, OneNumberThatIsNoneSpoilsTheMessage) {
  sensor_msgs::Range range;
  range.max_range = 5.0F;
  range.range = kNan;
  EXPECT_TRUE(is_fit(range));
  range.field_of_view = kNan;
  EXPECT_FALSE(is_fit(range));

  docent_msgs::Belief belief;
  belief.cells.resize(3);
  EXPECT_TRUE(is_fit(belief));
  belief.cells[2].mass = kNan;
  EXPECT_FALSE(is_fit(belief));

  docent_msgs::Target target;
  EXPECT_TRUE(is_fit(target));
  target.heading_tolerance = kNan;
  EXPECT_FALSE(is_fit(target));

  nav_msgs::Odometry odometry;
  EXPECT_TRUE(is_fit(odometry));
  odometry.pose.pose.orientation.z = kNan;
  EXPECT_FALSE(is_fit(odometry));

  docent_msgs::Limits limits;
  limits.max_speed = kNan;
  EXPECT_FALSE(is_fit(limits));
}

}  // namespace
}  // namespace docent
