#include "docent/localization/judgement/rivals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::localization {
namespace {

constexpr double kRange = 10.0;  // [m]

/// A room of 12 x 6 m, the same after half a turn, but for a case near its right end when `with_case`.
OccupancyGrid room(bool with_case) {
  OccupancyGrid map;
  map.frame = {140, 80, 0.1, {-1.0, -1.0}};
  map.cells.assign(map.frame.size(), 100);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Point2 at{-1.0 + 0.1 * (static_cast<double>(i % 140) + 0.5),
                    -1.0 + 0.1 * (static_cast<double>(i / 140) + 0.5)};
    const bool floor = at.x > 0.0 && at.x < 12.0 && at.y > 0.0 && at.y < 6.0;
    const bool box = with_case && at.x > 9.5 && at.x < 11.0 && at.y > 1.0 && at.y < 2.5;
    if (floor && !box) map.cells[i] = 0;
  }
  return map;
}

sensor_models::RangeSweep sweep_from(const sensor_models::RayCaster& caster, const Pose2& pose) {
  sensor_models::RangeSweep sweep;
  for (int i = 0; i < 180; ++i) {
    sensor_models::SweepBeam beam;
    beam.bearing = (2.0 * i - 180.0) * std::numbers::pi / 180.0;
    beam.range =
        caster.cast(pose.position(), unit(pose.theta + Angle::radians(beam.bearing)), kRange, kRange).value_or(kRange);
    sweep.beams.push_back(beam);
  }
  return sweep;
}

const Pose2 kHere{4.0, 3.5, Angle::degrees(20)};
const Pose2 kTwin{8.0, 2.5, Angle::degrees(200)};

BeliefSummary summary_of(double best, double twin) {
  BeliefSummary summary;
  summary.modes.push_back({kHere, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.001}, best});
  if (twin > 0.0) summary.modes.push_back({kTwin, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.001}, twin});
  return summary;
}

TEST(Rivals, ATwinThatNothingSpeaksAgainstKeepsItsShare) {
  const sensor_models::RayCaster caster{room(false)};
  Rivals rivals;
  const auto sweep = sweep_from(caster, kHere);
  EXPECT_FALSE(rivals.update(summary_of(0.6, 0.4), sweep, {}, caster, kRange).has_value());
  // Two centimetres of the survey have spoken for the one: the twin is nearly out of the belief.
  std::optional<std::vector<BeliefMode>> restored;
  for (int i = 0; i < 20; ++i) restored = rivals.update(summary_of(0.999, 0.0), sweep, {}, caster, kRange);
  ASSERT_TRUE(restored.has_value());
  ASSERT_EQ(restored->size(), 2U);
  EXPECT_GT((*restored)[1].mass, 0.15);
  EXPECT_NEAR((*restored)[0].mass + (*restored)[1].mass, 1.0, 1e-9);
  EXPECT_LT(distance((*restored)[1].map_from_robot.position(), kTwin.position()), 1e-6);
}

TEST(Rivals, WhatTheReadingsSpeakAgainstIsDroppedAfterTwoSweeps) {
  const sensor_models::RayCaster caster{room(true)};
  Rivals rivals;
  const auto sweep = sweep_from(caster, kHere);
  EXPECT_TRUE(rivals.update(summary_of(0.99, 0.01), sweep, {}, caster, kRange).has_value());
  EXPECT_FALSE(rivals.update(summary_of(0.999, 0.0), sweep, {}, caster, kRange).has_value());
}

TEST(Rivals, PlacesAreCarriedOnByOdometry) {
  const sensor_models::RayCaster caster{room(false)};
  Rivals rivals;
  ASSERT_FALSE(rivals.update(summary_of(0.6, 0.4), sweep_from(caster, kHere), {}, caster, kRange).has_value());
  const Pose2 step{0.5, 0.0, {}};
  auto moved = summary_of(0.999, 0.0);
  moved.modes.front().map_from_robot = kHere * step;
  const auto restored = rivals.update(moved, sweep_from(caster, kHere * step), step, caster, kRange);
  ASSERT_TRUE(restored.has_value());
  EXPECT_LT(distance((*restored)[1].map_from_robot.position(), (kTwin * step).position()), 1e-6);
}

TEST(Rivals, EvidenceOfSeveralSpotsRulesAPlaceOut) {
  const sensor_models::RayCaster caster{room(false)};
  Rivals rivals;
  ASSERT_FALSE(rivals.update(summary_of(0.6, 0.4), sweep_from(caster, kHere), {}, caster, kRange).has_value());
  const Pose2 there{0.8, 0.0, {}};
  const Pose2 back = inverse(there);
  int restored = 0;
  auto summary = summary_of(0.999, 0.0);
  for (int i = 0; i < 20; ++i) {
    const Pose2 step = i % 2 == 0 ? there : back;
    summary.modes.front().map_from_robot = summary.modes.front().map_from_robot * step;
    const auto sweep = sweep_from(caster, summary.modes.front().map_from_robot);
    restored += rivals.update(summary, sweep, step, caster, kRange).has_value() ? 1 : 0;
  }
  EXPECT_GT(restored, 3);
  EXPECT_LT(restored, 10);
}

TEST(Rivals, ABeliefThatIsSpreadOutIsLeftAlone) {
  const sensor_models::RayCaster caster{room(false)};
  Rivals rivals;
  const auto sweep = sweep_from(caster, kHere);
  EXPECT_FALSE(rivals.update(summary_of(0.1, 0.08), sweep, {}, caster, kRange).has_value());
  EXPECT_FALSE(rivals.update(summary_of(0.1, 0.0), sweep, {}, caster, kRange).has_value());
}

TEST(GrossDifference, CountsBeamsThatFitOnePlaceOnly) {
  const sensor_models::RayCaster caster{room(true)};
  const auto sweep = sweep_from(caster, kHere);
  const auto same = gross_difference(caster, sweep, kHere, kHere, kRange);
  EXPECT_EQ(same.first_only, 0);
  EXPECT_EQ(same.second_only, 0);
  const auto twin = gross_difference(caster, sweep, kHere, kTwin, kRange);
  EXPECT_GT(twin.first_only, 5);
  EXPECT_EQ(twin.second_only, 0);
}

}  // namespace
}  // namespace docent::localization
