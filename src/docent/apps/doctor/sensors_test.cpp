#include "docent/apps/doctor/sensors.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::doctor_command {
namespace {

geometry_msgs::TransformStamped link_of(const std::string& parent, const std::string& child, double x, double heading) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation = {x, 0.0, 0.2};
  transform.transform.rotation = to_quaternion(Angle::degrees(heading));
  return transform;
}

/// What is said of a scanner at x 0.10, heading 0, by robot.yaml, beside these transforms of the base.
Finding scanner_beside(const std::vector<geometry_msgs::TransformStamped>& transforms, bool has_mount = true,
                       bool in_tf_static = true) {
  transport::VirtualTimeHub hub;
  const auto base = hub.connect("base");
  const auto doctor = hub.connect("doctor");
  robot::RobotBody body;
  robot::Scanner scanner;
  scanner.frame = "laser_link";
  scanner.x = has_mount ? 0.1 : 0.0;
  scanner.has_mount = has_mount;
  body.scanners = {scanner};
  body.sonars = body.infrareds = 0;
  body.tactile = false;
  Sensors sensors{*doctor, body, {}};
  const auto scans = base->publisher(topics::kScanFront);
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  base->publisher(in_tf_static ? topics::kStaticTransforms : topics::kTransforms).publish(message);
  for (int i = 1; i <= 30; ++i)
    base->after(seconds(0.1 * i), [&base, &scans] {
      sensor_msgs::LaserScan scan;
      scan.header = {to_message(base->now()), "laser_link"};
      scan.angle_min = -1.5F;
      scan.angle_increment = 3.0F / 179.0F;
      scan.range_min = 0.1F;
      scan.range_max = 10.0F;
      scan.ranges.assign(180, 2.0F);
      scans.publish(scan);
    });
  hub.run_until(time_from_seconds(3.2));
  for (Finding& finding : sensors.findings(Time{}))
    if (finding.name == "scanner front") return std::move(finding);
  return {};
}

TEST(Sensors, AMountIsFoundFromWhicheverFrameTheBaseIsNamedAfter) {
  for (const bool in_tf_static : {true, false}) {
    const auto verdict = [&](double x, const std::vector<geometry_msgs::TransformStamped>& others,
                             const std::string& parent) {
      auto all = others;
      all.push_back(link_of(parent, "laser_link", x, 0.0));
      return scanner_beside(all, true, in_tf_static);
    };
    const std::vector<geometry_msgs::TransformStamped> above{link_of("base_footprint", "base_link", 0.0, 0.0)},
        below{link_of("base_link", "base_footprint", 0.0, 0.0)},
        shifted{link_of("base_footprint", "base_link", 0.3, 0.0)};
    for (const auto& frames : {std::vector<geometry_msgs::TransformStamped>{}, above, below}) {
      for (const char* parent : {"base_link", "base_footprint"}) {
        const Finding right = verdict(0.1, frames, parent), wrong = verdict(0.25, frames, parent);
        EXPECT_EQ(right.verdict, Verdict::fine) << right.text;
        EXPECT_EQ(wrong.verdict, Verdict::wrong) << "hung on " << parent;
        EXPECT_NE(wrong.text.find("/tf_static has it at x 0.25"), std::string::npos) << wrong.text;
      }
    }
    EXPECT_EQ(verdict(0.4, shifted, "base_footprint").verdict, Verdict::fine) << "0.1 m before base_link";
    EXPECT_EQ(verdict(0.1, shifted, "base_link").verdict, Verdict::fine);
  }
  EXPECT_EQ(scanner_beside({}).verdict, Verdict::fine) << "robot.yaml counts";
}

TEST(Sensors, AMountThatIsLeftToTheBaseIsShownOrMissed) {
  const Finding told = scanner_beside({link_of("base_footprint", "laser_link", 0.25, 90.0)}, false);
  EXPECT_EQ(told.verdict, Verdict::fine) << told.text;
  EXPECT_NE(told.text.find("/tf_static has it at x 0.25, y 0.00, heading 90.0"), std::string::npos) << told.text;
  const Finding missing = scanner_beside({}, false);
  EXPECT_EQ(missing.verdict, Verdict::wrong);
  EXPECT_NE(missing.text.find("no /tf_static says where 'laser_link' is on base_link"), std::string::npos)
      << missing.text;
}

}  // namespace
}  // namespace docent::apps::doctor_command
