#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "docent/collision_avoidance/expected_sweeps/parallax.h"
#include "docent/collision_avoidance/expected_sweeps/straight_walls.h"
#include "docent/recording/laser_log.h"

namespace docent {
namespace {

using collision_avoidance::ParallaxCheck;
using collision_avoidance::SensorSweep;
using collision_avoidance::StraightWallsCheck;
namespace fs = std::filesystem;

constexpr double kLeastRange = 0.05;      // [m]
constexpr double kMostRange = 50.0;       // [m]
constexpr std::size_t kMostScans = 2500;  // of one log

std::vector<fs::path> logs() {
  const char* data = std::getenv("DOCENT_DATA");
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(fs::path{data != nullptr ? data : "../shared/data"} / "logs", ignored))
    if (entry.path().extension() == ".gz") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

struct Seen {
  int sweeps = 0;
  int blamed = 0;
  int in_order = 0;
  double offset = 0.0;  ///< [m] the last that was said
};

/// @param says_all  a check forgets what it has said: does it ever blame?
template <class Check>
Seen look(const recording::LaserLog& log, double offset, bool says_all) {
  Check check;
  Seen seen;
  for (const recording::LoggedScan& scan : log.scans) {
    if (scan.rear) continue;
    if (++seen.sweeps > static_cast<int>(kMostScans)) break;
    const double most = std::min(scan.max_range > 0.0 ? scan.max_range : log.max_range, kMostRange);
    SensorSweep sweep{scan.time, {}, scan.first_bearing.radians(), scan.bearing_step, kLeastRange, most, scan.ranges};
    for (float& range : sweep.ranges)
      if (range < static_cast<float>(most))
        range = static_cast<float>(std::max(0.01, static_cast<double>(range) + offset));
    const auto found = check.add(view_of(sweep, scan.odom_from_base * scan.base_from_laser));
    if (says_all && found != Check::Finding::nothing) check.forget();
    if (found == Check::Finding::in_order) ++seen.in_order;
    if (found != Check::Finding::offset) continue;
    ++seen.blamed;
    seen.offset = check.offset();
  }
  return seen;
}

TEST(RecordedWalls, NoScannerInOrderIsBlamedAndAnOffsetIsFoundInEachBuilding) {
  const auto all = logs();
  if (all.empty()) GTEST_SKIP() << "no recorded data (DOCENT_DATA): no recorded walls";
  int sweeps = 0;
  for (const fs::path& path : all) {
    const auto log = recording::read_laser_log(path);
    ASSERT_TRUE(log) << log.error().message;
    const Seen in_order = look<StraightWallsCheck>(*log, 0.0, false);
    EXPECT_EQ(in_order.blamed, 0) << path << " by " << in_order.offset << " m";
    const Seen longer = look<StraightWallsCheck>(*log, 0.5, false);
    EXPECT_GT(longer.blamed, 0) << path;
    EXPECT_NEAR(longer.offset, 0.5, 0.25) << path;
    sweeps += in_order.sweeps;
  }
  EXPECT_GT(sweeps, 5000);
}

TEST(RecordedWalls, WhatPassesByBlamesNoScannerInOrderHoweverOftenItIsAsked) {
  const auto all = logs();
  if (all.empty()) GTEST_SKIP() << "no recorded data (DOCENT_DATA): nothing passes by";
  int in_order_said = 0;
  for (const fs::path& path : all) {
    const auto log = recording::read_laser_log(path);
    ASSERT_TRUE(log) << log.error().message;
    const Seen in_order = look<ParallaxCheck>(*log, 0.0, true);
    EXPECT_EQ(in_order.blamed, 0) << path << " by " << in_order.offset << " m";
    const Seen longer = look<ParallaxCheck>(*log, 0.5, false);
    EXPECT_GT(longer.blamed, 0) << path;
    EXPECT_NEAR(longer.offset, 0.5, 0.25) << path;
    in_order_said += in_order.in_order;
  }
  EXPECT_GT(in_order_said, 500);
}

}  // namespace
}  // namespace docent
