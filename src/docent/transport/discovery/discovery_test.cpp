#include "docent/transport/discovery/discovery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "docent/transport/dds_bus.h"

namespace docent::transport::discovery_test {
namespace {

constexpr int kDomain = 49;  // other tests run at the same time in other domains

Endpoint scan_writer() {
  return {.writes = true,
          .participant = "01",
          .topic = "rt/scan_front",
          .type = "sensor_msgs::msg::dds_::LaserScan_",
          .user_data = "",
          .is_reliable = false,
          .is_latched = false};
}

TEST(Discovery, NamesAreThoseOfRos2) {
  EXPECT_EQ(ros_topic("rt/minerva/scan_front"), "/minerva/scan_front");
  EXPECT_EQ(ros_topic("ros_discovery_info"), "ros_discovery_info");
  EXPECT_EQ(ros_type("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(ros_type("Chatter"), "Chatter");
}

TEST(Discovery, WhatDoesNotComeTogetherIsSaid) {
  const auto scan = topic_info(topics::kScanFront);
  const std::string type = "sensor_msgs::msg::dds_::LaserScan_";
  EXPECT_EQ(mismatch(scan, type, scan_writer()), "") << "a driver may offer best effort";
  Endpoint other = scan_writer();
  other.type = "sensor_msgs::msg::dds_::PointCloud2_";
  EXPECT_EQ(mismatch(scan, type, other), "its type is sensor_msgs/msg/PointCloud2, not sensor_msgs/msg/LaserScan");

  const auto map = topic_info(topics::kStaticMap);
  EXPECT_NE(mismatch(map, type, scan_writer()).find("best effort"), std::string::npos);
  other = scan_writer();
  other.is_reliable = true;
  EXPECT_NE(mismatch(map, type, other).find("volatile"), std::string::npos);
  other.is_latched = true;
  EXPECT_EQ(mismatch(map, type, other), "");

  Endpoint reader = scan_writer();
  reader.writes = false;
  EXPECT_EQ(mismatch(scan, type, reader), "");
  reader.is_reliable = true;
  EXPECT_EQ(mismatch(scan, type, reader), "") << "Docent's writers offer reliable";
  reader.is_latched = true;
  EXPECT_NE(mismatch(scan, type, reader).find("transient local"), std::string::npos);
  EXPECT_EQ(mismatch(map, type, reader), "");
  reader.has_deadline = true;
  EXPECT_NE(mismatch(map, type, reader).find("deadline"), std::string::npos);
  reader.has_partition = true;
  EXPECT_NE(mismatch(map, type, reader).find("partition"), std::string::npos);
}

TEST(Discovery, AnotherRobotTellsItsHealthAndCommandsABase) {
  Discovered heard;
  const auto writes = [&](const char* who, const char* topic) {
    heard.endpoints.push_back({.writes = true, .participant = who, .topic = topic, .type = "", .user_data = ""});
  };
  writes("joystick", "rt/cmd_vel");
  writes("localize", "rt/docent/health");
  EXPECT_FALSE(has_robot(heard, "rt/docent/health", "rt/cmd_vel")) << "a module without a base, and a joystick";
  writes("robot", "rt/cmd_vel");
  writes("robot", "rt/docent/health");
  EXPECT_TRUE(has_robot(heard, "rt/docent/health", "rt/cmd_vel"));
  EXPECT_FALSE(has_robot(heard, "rt/minerva/docent/health", "rt/minerva/cmd_vel")) << "of another name";
}

TEST(Discovery, WhoIsOnTheDomainIsFound) {
  const auto base = std::move(*DdsBus::create({kDomain, "", {}}));
  [[maybe_unused]] const auto scans = base->publisher(topics::kScanFront);
  base->subscribe<geometry_msgs::Twist>(topics::kCommandVelocity, [](const auto&) {});
  const auto bus = std::move(*DdsBus::create({kDomain, "", {}}));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{10};
  Discovered heard;
  while (heard.endpoints.size() < 2 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
    heard = discovered(bus->participant());
  }
  ASSERT_EQ(heard.participants.size(), 1U) << "itself is left out";
  EXPECT_EQ(heard.participants[0].vendor, "Cyclone DDS");
  const auto has = [&](bool writes, const std::string& topic, const std::string& type) {
    return std::any_of(heard.endpoints.begin(), heard.endpoints.end(), [&](const Endpoint& one) {
      return one.writes == writes && one.topic == topic && one.type == type && one.is_reliable &&
             one.participant == heard.participants[0].id;
    });
  };
  EXPECT_TRUE(has(true, "rt/scan_front", "sensor_msgs::msg::dds_::LaserScan_"));
  EXPECT_TRUE(has(false, "rt/cmd_vel", "geometry_msgs::msg::dds_::Twist_"));
}

}  // namespace
}  // namespace docent::transport::discovery_test
