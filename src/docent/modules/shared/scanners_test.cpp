#include "docent/modules/shared/scanners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "docent/transport/virtual_time_bus.h"

namespace docent::modules::scanners_test {
namespace {

sensor_msgs::LaserScan clockwise_scan() {
  sensor_msgs::LaserScan scan;
  scan.angle_min = 1.0F;
  scan.angle_max = -1.0F;
  scan.angle_increment = -1.0F;
  scan.range_min = 0.1F;
  scan.range_max = 30.0F;
  scan.ranges = {3.0F, std::numeric_limits<float>::infinity(), 2.0F};
  return scan;
}

TEST(Scanners, EveryModuleGetsSweepsInOneForm) {
  transport::VirtualTimeHub hub;
  const auto module = hub.connect("module");
  const auto driver = hub.connect("driver");
  robot::RobotBody body;
  std::vector<sensor_msgs::LaserScan> got;
  const auto readers = subscribe_scanners(*module, body, [&](std::size_t, const auto& scan) { got.push_back(scan); });
  driver->publisher(topics::scan_topic("front")).publish(clockwise_scan());
  hub.run_until(hub.now() + seconds(0.1));
  ASSERT_EQ(got.size(), 1U) << "angle_increment below 0 is no fault";
  EXPECT_FLOAT_EQ(got[0].angle_min, -1.0F);
  EXPECT_FLOAT_EQ(got[0].angle_max, 1.0F);
  EXPECT_FLOAT_EQ(got[0].angle_increment, 1.0F);
  EXPECT_EQ(got[0].ranges, (std::vector<float>{2.0F, 30.0F, 3.0F}));
  EXPECT_EQ(readers->notes(), "");
}

TEST(Scanners, WhatRobotYamlSaysHolds) {
  robot::RobotBody body;
  body.scanners = {{}};
  body.scanners[0].upside_down = true;
  body.scanners[0].max_range = 2.5;
  body.scanners[0].zero = "nothing";
  ScannerReaders readers{body};
  sensor_msgs::LaserScan scan = clockwise_scan();
  scan.ranges[1] = 0.0F;
  const sensor_msgs::LaserScan read = readers.read(0, scan);
  EXPECT_EQ(read.range_max, 2.5F);
  EXPECT_EQ(read.ranges, (std::vector<float>{2.5F, 2.5F, 2.0F})) << "hung clockwise is counter-clockwise";
  EXPECT_FLOAT_EQ(read.angle_min, -1.0F);
  EXPECT_EQ(readers.notes(), "scan says that it looks 30.0 m far, body.scanners says 2.5 m");
}

}  // namespace
}  // namespace docent::modules::scanners_test
