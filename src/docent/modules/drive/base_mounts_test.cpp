#include "docent/modules/drive/base_mounts.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"

namespace docent::modules {
namespace {

robot::RobotConfig with(const std::string& scanners) {
  robot::RobotConfig config;
  EXPECT_TRUE(config.set("body.scanners=[" + scanners + "]"));
  return config;
}

geometry_msgs::TransformStamped link(const std::string& parent, const std::string& child, const Pose2& pose,
                                     bool is_upside_down = false) {
  geometry_msgs::TransformStamped transform{{{}, parent}, child, {{pose.x, pose.y, 0.2}, to_quaternion(pose.theta)}};
  auto& turned = transform.transform.rotation;
  if (is_upside_down) turned = {turned.w, turned.z, 0.0, 0.0};
  return transform;
}

TEST(BaseMounts, AreTakenWhereRobotYamlSaysNone) {
  auto config = with("{name: front, frame: laser_link}");
  ASSERT_TRUE(wants_mounts_of_base(config.body()));
  BaseMounts mounts{config.body()};
  EXPECT_EQ(mounts.set_in(config),
            "scanner front: robot.yaml says no x, y and heading, and no /tf_static says where laser_link is on "
            "base_link");
  // A plate is turned by 90 degrees, and the scanner hangs below it, ahead of its middle.
  mounts.hear_static({{link("base_link", "plate", {0.1, 0.0, Angle::degrees(90.0)})}});
  mounts.hear({{link("/plate", "/laser_link", {0.2, 0.0, Angle::degrees(0.0)}, true)}});
  EXPECT_EQ(mounts.set_in(config), "");
  const robot::Scanner& scanner = config.body().scanners.at(0);
  EXPECT_NEAR(scanner.x, 0.1, 1e-9);
  EXPECT_NEAR(scanner.y, 0.2, 1e-9);
  EXPECT_NEAR(scanner.heading, 90.0, 1e-9);
  EXPECT_TRUE(scanner.upside_down);
}

TEST(BaseMounts, ThatRobotYamlSaysCountAndAContradictionIsNamed) {
  auto config = with("{name: front, frame: laser_link, x: 0.1, y: 0, heading: 0}, {name: rear, frame: back}");
  BaseMounts mounts{config.body()};
  EXPECT_EQ(mounts.transforms(false).transforms.size(), 1U);
  EXPECT_EQ(mounts.transforms(true).transforms.size(), 1U);
  mounts.hear_static(mounts.transforms(false));
  EXPECT_EQ(mounts.contradictions(), "") << "its own";
  mounts.hear_static({{link("base_link", "laser_link", {0.12, 0.0, Angle::degrees(1.0)})}});
  EXPECT_EQ(mounts.contradictions(), "") << "as good as the same";
  mounts.hear_static({{link("base_link", "laser_link", {0.1, 0.0, Angle::degrees(180.0)})}});
  EXPECT_EQ(mounts.contradictions(),
            "/tf_static has scanner front at x 0.100, y 0.000, heading -180.0, robot.yaml at x 0.100, y 0.000, heading "
            "0.0, which counts");
  mounts.hear_static({{link("base_link", "laser_link", {0.1, 0.0, Angle::degrees(0.0)}, true)}});
  EXPECT_NE(mounts.contradictions().find("upside down"), std::string::npos);
  mounts.hear_static({{link("base_link", "back", {-0.2, 0.0, Angle::degrees(180.0)})}});
  EXPECT_EQ(mounts.set_in(config), "");
  EXPECT_EQ(config.body().scanners[0].x, 0.1);
  EXPECT_EQ(config.body().scanners[1].x, -0.2);
}

TEST(BaseMounts, AScannerInTheMiddleIsSaidByAnyOfItsKeys) {
  EXPECT_FALSE(wants_mounts_of_base(with("{name: front, frame: laser_link, heading: 0}").body()));
  EXPECT_FALSE(wants_mounts_of_base(robot::RobotConfig{}.body())) << "those of the papers' robot";
}

}  // namespace
}  // namespace docent::modules
