#include "docent/apps/ros/ros_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "docent/apps/ros/ros_report.h"
#include "docent/messages/topics.h"

namespace docent::apps::ros {
namespace {

using transport::Endpoint;
using transport::topic_info;

/// "geometry_msgs/msg/Twist" as DDS has it.
std::string dds_type(const std::string& type) {
  const auto slash = type.rfind('/');
  std::string text = type.substr(0, slash) + "::dds_::" + type.substr(slash + 1) + "_";
  text.replace(text.find('/'), 1, "::");
  return text;
}

const Wire kWire{[](const auto& topic) { return std::string{"rt/"} + topic.name; },
                 [](const auto& topic) { return dds_type(topic.type->name); }};
constexpr const char* kHealth = "rt/docent/health";

/// A driver that speaks Fast DDS, and what it does.
class ABase : public ::testing::Test {
 protected:
  ABase() { check_.heard.participants = {{"base", "Fast DDS", "enclave=/;"}, {"robot", "Cyclone DDS", ""}}; }
  void add(bool writes, const std::string& who, const std::string& topic, const std::string& type) {
    check_.heard.endpoints.push_back(
        {.writes = writes, .participant = who, .topic = topic, .type = dds_type(type), .user_data = ""});
    check_.heard.endpoints.back().is_reliable = true;
  }
  [[nodiscard]] Finding find(const Arrivals& arrivals) const {
    const Need scan{topic_info(topics::kScanFront), true, "the robot stands", {"avoid"}};
    return finding_of(scan, arrivals, 2.0, kWire, check_.heard);
  }
  Check check_;
};

TEST(RosCheck, NeedsAreThoseOfTheBody) {
  robot::RobotBody body;
  body.scanners = {{}};
  body.sonars = 0;
  body.infrareds = 0;
  body.tactile = false;
  std::vector<std::string> needed;
  for (const Need& need : needs_of(body, true, false))
    if (need.is_needed) needed.emplace_back(need.topic.name);
  EXPECT_EQ(needed, (std::vector<std::string>{"odom", "scan_front"}));
  body.sonars = 8;
  body.tactile = true;
  const auto is_needed = [&](const char* name, bool needs_sonar) {
    const auto needs = needs_of(body, needs_sonar, false);
    return std::any_of(needs.begin(), needs.end(),
                       [&](const Need& need) { return need.is_needed && std::string_view{need.topic.name} == name; });
  };
  EXPECT_TRUE(is_needed("sonar", true));
  EXPECT_FALSE(is_needed("sonar", false));
  EXPECT_TRUE(is_needed("tactile", true));
  EXPECT_FALSE(is_needed("battery_state", true));
  const auto of_create3 = needs_of(body, true, true);
  const auto names = [&](const char* name) {
    return std::count_if(of_create3.begin(), of_create3.end(),
                         [&](const Need& need) { return std::string_view{need.topic.name} == name; });
  };
  EXPECT_EQ(names("hazard_detection"), 1) << "of which its bumpers are made";
  EXPECT_EQ(names("tactile"), 0);
}

TEST(RosCheck, OpenEyesWantTheirTopics) {
  const robot::RobotBody body;
  const auto of = [&](const Eyes& eyes) {
    std::vector<std::string> names;
    for (const Need& need : needs_of(body, true, false, eyes))
      if (const std::string name = need.topic.name;
          name.find("depth") == 0 || name.find("ceiling") == 0 || name.find("fix") != std::string::npos) {
        names.push_back(name);
        EXPECT_FALSE(need.is_needed) << "the robot drives without it";
      }
    return names;
  };
  EXPECT_EQ(of({}), std::vector<std::string>{});
  EXPECT_EQ(of({.sight = true}), (std::vector<std::string>{"depth_camera/image", "depth_camera/camera_info"}));
  EXPECT_EQ(of({.ceiling = true}),
            (std::vector<std::string>{"ceiling_camera/image", "ceiling_camera/camera_info", "docent/pose_fix"}));
}

TEST_F(ABase, WhatArrivesIsFine) {
  add(true, "base", "rt/scan_front", "sensor_msgs/msg/LaserScan");
  const Finding finding = find({.messages = 20, .refused = 0, .refusal = ""});
  EXPECT_TRUE(finding.arrives());
  EXPECT_EQ(finding.rate, 10.0);
  EXPECT_TRUE(finding.faults.empty());
  EXPECT_EQ(finding.topic, "/scan_front");
}

TEST_F(ABase, AnotherNameIsPointedAt) {
  add(true, "base", "rt/scan", "sensor_msgs/msg/LaserScan");
  const Finding finding = find({});
  ASSERT_EQ(finding.faults.size(), 2U);
  EXPECT_EQ(finding.faults[0], "nobody publishes it");
  EXPECT_NE(finding.faults[1].find("-r scan:=scan_front"), std::string::npos) << finding.faults[1];
}

TEST_F(ABase, AnotherTypeSilenceAndRefusedMessagesAreTold) {
  EXPECT_EQ(find({}).faults, std::vector<std::string>{"nobody publishes it"});
  add(true, "base", "rt/scan_front", "sensor_msgs/msg/LaserScan");
  EXPECT_NE(find({}).faults.at(0).find("says nothing"), std::string::npos);
  EXPECT_NE(find({.messages = 0, .refused = 7, .refusal = "range_max is not above range_min"})
                .faults.at(0)
                .find("7 messages refused: range_max"),
            std::string::npos);
  check_.heard.endpoints[0].type = dds_type("sensor_msgs/msg/PointCloud2");
  EXPECT_NE(
      find({}).faults.at(0).find("a program with Fast DDS publishes it, but its type is sensor_msgs/msg/PointCloud2"),
      std::string::npos);
}

TEST_F(ABase, CommandsOfTheWrongTypeAndOfOthersAreFaults) {
  check_commands(check_, kWire);
  ASSERT_EQ(check_.notes.size(), 1U) << "nobody reads them";
  EXPECT_TRUE(check_.is_fine());
  add(true, "robot", "rt/docent/health", "docent_msgs/msg/Health");
  add(true, "robot", "rt/cmd_vel", "geometry_msgs/msg/Twist");
  add(false, "base", "rt/cmd_vel", "geometry_msgs/msg/Twist");
  check_.notes.clear();
  check_commands(check_, kWire);
  EXPECT_TRUE(check_.faults.empty() && check_.notes.empty()) << "Docent's own writer is no stranger";
  add(true, "second", "rt/docent/health", "docent_msgs/msg/Health");
  add(true, "second", "rt/cmd_vel", "geometry_msgs/msg/Twist");
  check_commands(check_, kWire);
  ASSERT_EQ(check_.faults.size(), 1U);
  EXPECT_NE(check_.faults[0].find("two robots of one name"), std::string::npos) << check_.faults[0];
  check_.faults.clear();
  check_.heard.endpoints.pop_back();
  add(true, "base", "rt/cmd_vel", "geometry_msgs/msg/Twist");
  add(false, "base", "rt/cmd_vel", "geometry_msgs/msg/TwistStamped");
  check_commands(check_, kWire);
  ASSERT_EQ(check_.faults.size(), 2U);
  EXPECT_NE(check_.faults[0].find("only Docent may"), std::string::npos);
  EXPECT_NE(check_.faults[1].find("body.stamped_commands: true"), std::string::npos);
  EXPECT_FALSE(check_.is_fine());
}

TEST_F(ABase, AReportHasAllOfIt) {
  add(true, "base", "rt/scan", "sensor_msgs/msg/LaserScan");
  check_.seconds = 2.0;
  check_.interfaces = {{"lo", "127.0.0.1", true}, {"eth0", "10.0.0.7", false}};
  check_.reach = {3, "lo", ""};
  check_.lines = transport::ros_lines(check_.reach, "/share");
  check_.findings = {find({})};
  check_.nodes = {{"base", "/turtlebot4/motion_control", 3, 12}};
  const std::string text = text_of(check_, kHealth);
  for (const char* part :
       {"domain 3", "eth0 10.0.0.7: not heard (--interface eth0)", "export ROS_DOMAIN_ID=3", "1 Fast DDS",
        "nodes of ROS 2: /turtlebot4/motion_control\n",
        "/scan (sensor_msgs/msg/LaserScan), from 1 Fast DDS: reliable, volatile", "MISSING /scan_front: avoid",
        "without it: the robot stands", "Not all that is needed arrives."})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  const auto json = nlohmann::json::parse(json_of(check_, kHealth));
  EXPECT_FALSE(json["fine"]);
  EXPECT_EQ(json["settings"]["domain"], 3);
  EXPECT_EQ(json["needs"][0]["topic"], "/scan_front");
  EXPECT_FALSE(json["needs"][0]["arrives"]);
  EXPECT_EQ(json["participants"][0]["user_data"], "enclave=/;");
  EXPECT_EQ(json["nodes"][0]["name"], "/turtlebot4/motion_control");
  EXPECT_EQ(json["nodes"][0]["writers"], 12);
}

}  // namespace
}  // namespace docent::apps::ros
