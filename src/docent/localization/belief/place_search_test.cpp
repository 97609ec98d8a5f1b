#include "docent/localization/belief/place_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace docent::localization {
namespace {

constexpr double kRange = 10.0;  // [m]

/// An L of two halls and a pillar: no two places look the same.
OccupancyGrid halls() {
  OccupancyGrid map;
  map.frame = {300, 240, 0.1, {-3.0, -4.0}};
  map.cells.assign(map.frame.size(), 100);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Point2 at{-3.0 + 0.1 * (static_cast<double>(i % 300) + 0.5),
                    -4.0 + 0.1 * (static_cast<double>(i / 300) + 0.5)};
    const bool long_hall = at.x > 0.0 && at.x < 24.0 && at.y > 0.0 && at.y < 5.0;
    const bool side_hall = at.x > 16.0 && at.x < 21.0 && at.y >= 5.0 && at.y < 14.0;
    const bool pillar = at.x > 7.0 && at.x < 8.0 && at.y > 2.0 && at.y < 3.0;
    if ((long_hall || side_hall) && !pillar) map.cells[i] = 0;
  }
  return map;
}

sensor_models::RangeSweep sweep_at(const sensor_models::RayCaster& caster, const Pose2& pose) {
  sensor_models::RangeSweep sweep;
  for (int i = 0; i < 120; ++i) {
    sensor_models::SweepBeam beam;
    beam.bearing = (3.0 * i - 180.0) * std::numbers::pi / 180.0;
    beam.range =
        caster.cast(pose.position(), unit(pose.theta + Angle::radians(beam.bearing)), kRange, kRange).value_or(kRange);
    beam.no_return = beam.range >= kRange;
    sweep.beams.push_back(beam);
  }
  return sweep;
}

TEST(PlaceSearch, FindsTheRobotAnywhereInTheMap) {
  const sensor_models::RayCaster caster{halls()};
  const PlaceSearch search{caster, halls()};
  for (const Pose2& pose : {Pose2{3.0, 2.0, Angle::degrees(33)}, Pose2{18.0, 9.0, Angle::degrees(-100)},
                            Pose2{22.0, 3.5, Angle::degrees(170)}, Pose2{6.2, 1.1, Angle::degrees(90)}}) {
    PlaceSearch::Wanted wanted;
    wanted.max_range = kRange;
    const auto found = search.find(sweep_at(caster, pose), wanted);
    ASSERT_FALSE(found.empty());
    EXPECT_GT(found.front().fit, 0.6);
    const auto is_here = [&](const FoundPlace& place) {  // some other may fit as well to the end of a hall
      return distance(place.map_from_robot.position(), pose.position()) < 0.3 &&
             std::abs((place.map_from_robot.theta - pose.theta).degrees()) < 5.0;
    };
    EXPECT_TRUE(std::any_of(found.begin(), found.begin() + std::ssize(found), is_here));
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i].fit, found[i - 1].fit + 1e-9);
  }
}

TEST(PlaceSearch, BlindOrHurriedItFindsNothing) {
  const sensor_models::RayCaster caster{halls()};
  const PlaceSearch search{caster, halls()};
  PlaceSearch::Wanted wanted;
  wanted.max_range = kRange;
  EXPECT_TRUE(search.find({}, wanted).empty());
  wanted.work = 0;
  EXPECT_TRUE(search.find(sweep_at(caster, {3.0, 2.0, {}}), wanted).empty());
}

}  // namespace
}  // namespace docent::localization
