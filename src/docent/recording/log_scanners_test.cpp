#include "docent/recording/log_scanners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace docent::recording::log_scanners_test {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// A drive of 5 m along a hall whose far walls lie beyond 4 m, by a scanner of 360 beams.
LaserLog drive(float nothing) {
  LaserLog log;
  log.max_range = 4.0;
  for (int n = 0; n < 60; ++n) {
    LoggedScan scan;
    scan.bearing_step = 3.14159265358979 / 180.0;
    scan.max_range = 4.0;
    scan.odom_from_base = {0.1 * n, 0.0, Angle::degrees(3.0 * n)};
    for (int beam = 0; beam < 360; ++beam) {
      const double bearing = (beam + 3.0 * n) * scan.bearing_step;
      const double range = 2.0 / std::max(std::abs(std::sin(bearing)), 1e-9);
      scan.ranges.push_back(range < 4.0 ? static_cast<float>(range) : nothing);
    }
    log.scans.push_back(std::move(scan));
  }
  return log;
}
std::vector<std::string> frames_of(const LaserLog& log) { return std::vector<std::string>(log.scans.size(), "top"); }

TEST(LogScanners, ZeroIsNothingOfADriverThatMeansIt) {
  LaserLog log = drive(0.0F);
  settle_scanners(log, frames_of(log));
  const LaserLog expected = drive(kInf);
  for (std::size_t i = 0; i < log.scans.size(); ++i) EXPECT_EQ(log.scans[i].ranges, expected.scans[i].ranges) << i;
  ASSERT_EQ(log.notes.size(), 1U);
  EXPECT_NE(log.notes[0].find("writes 0"), std::string::npos);
}

TEST(LogScanners, ZeroIsNoReadingOfADriverThatHasAnotherWordForNothing) {
  LaserLog log = drive(kInf);
  for (LoggedScan& scan : log.scans) scan.ranges[7] = 0.0F;
  settle_scanners(log, frames_of(log));
  for (const LoggedScan& scan : log.scans) EXPECT_TRUE(std::isnan(scan.ranges[7]));
  EXPECT_TRUE(log.notes.empty());
}

TEST(LogScanners, WhatNeverMovesIsTheRobotItself) {
  LaserLog log = drive(kInf);
  for (std::size_t i = 0; i < log.scans.size(); ++i)
    for (std::size_t beam = 90; beam < 95; ++beam) log.scans[i].ranges[beam] = 0.2F + 0.01F * static_cast<float>(i % 2);
  const LaserLog before = log;
  settle_scanners(log, frames_of(log));
  for (std::size_t i = 0; i < log.scans.size(); ++i)
    for (std::size_t beam = 0; beam < 360; ++beam)
      EXPECT_EQ(std::isnan(log.scans[i].ranges[beam]), beam >= 90 && beam < 95) << i << ", " << beam;

  LaserLog mixed = before;  // a beam that grazes the post reads anything behind it
  for (LoggedScan& scan : mixed.scans) scan.ranges[95] = 0.6F;
  for (std::size_t i = 0; i < mixed.scans.size(); i += 2) mixed.scans[i].ranges[89] = 0.9F;
  settle_scanners(mixed, frames_of(mixed));
  for (std::size_t i = 0; i < mixed.scans.size(); ++i) {
    EXPECT_TRUE(std::isnan(mixed.scans[i].ranges[95])) << i;
    EXPECT_EQ(std::isnan(mixed.scans[i].ranges[89]), i % 2 == 0) << i;
    EXPECT_FALSE(std::isnan(mixed.scans[i].ranges[88])) << i;
  }

  LaserLog standing = before;  // a wall beside a robot that does not drive says nothing
  for (LoggedScan& scan : standing.scans) scan.odom_from_base = {};
  settle_scanners(standing, frames_of(standing));
  EXPECT_FALSE(std::isnan(standing.scans[0].ranges[92]));
}

TEST(LogScanners, AScannerThatSaysMoreThanItSeesHasTheReachThatItShows) {
  LaserLog log = drive(kInf);
  log.max_range = 64.0;
  for (LoggedScan& scan : log.scans) scan.max_range = 64.0;
  settle_scanners(log, frames_of(log));
  EXPECT_NEAR(log.max_range, 4.0, 0.1);
  EXPECT_NEAR(log.scans[0].max_range, 4.0, 0.1);
  LaserLog honest = drive(kInf);
  settle_scanners(honest, frames_of(honest));
  EXPECT_EQ(honest.max_range, 4.0);
  EXPECT_TRUE(honest.notes.empty());
}

}  // namespace
}  // namespace docent::recording::log_scanners_test
