#include "docent/localization/judgement/glance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::localization {
namespace {

/// A hall of 8 x 8 m, 5 cm cells.
sensor_models::RayCaster hall() {
  OccupancyGrid map;
  map.frame = {160, 160, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 160; ++row)
    for (int column = 0; column < 160; ++column)
      if (row < 2 || row >= 158 || column < 2 || column >= 158)
        map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  return sensor_models::RayCaster{map};
}

sensor_models::RangeSweep seen_at(const sensor_models::RayCaster& caster, const Pose2& pose, double people) {
  sensor_models::RangeSweep sweep;
  for (int degree = -180; degree < 180; degree += 2) {
    const Angle bearing = Angle::degrees(degree);
    double range = *caster.cast(pose.position(), unit(pose.theta + bearing), 10.0, 0.3);
    if (degree < -180 + 360 * people) range = std::min(range, 0.7);
    sweep.beams.push_back({bearing.radians(), range, false});
  }
  return sweep;
}

TEST(Glance, SeesNothingStrangeWhereTheRobotIs) {
  const sensor_models::RayCaster caster = hall();
  const Pose2 here{2.0, 3.0, Angle::degrees(40.0)};
  const Glance glanced = glance(caster, seen_at(caster, here, 0.0), here, 10.0);
  EXPECT_GT(glanced.readings, 30);
  EXPECT_EQ(glanced.through, 0.0);
  EXPECT_EQ(glanced.shorter, 0.0);
}

TEST(Glance, PeopleMakeReadingsShorterAndPassThroughNoWall) {
  const sensor_models::RayCaster caster = hall();
  const Pose2 here{4.0, 4.0, Angle{}};
  const Glance glanced = glance(caster, seen_at(caster, here, 0.5), here, 10.0);
  EXPECT_EQ(glanced.through, 0.0);
  EXPECT_NEAR(glanced.shorter, 0.5, 0.06);
}

TEST(Glance, AnotherPlacePassesThroughWalls) {
  const sensor_models::RayCaster caster = hall();
  const Glance glanced = glance(caster, seen_at(caster, {4.0, 4.0, Angle{}}, 0.0), {0.8, 0.8, Angle{}}, 10.0);
  EXPECT_GT(glanced.through, 0.4);
}

TEST(Glance, WhoLooksFourMetresMissesNoWallAtFive) {
  const sensor_models::RayCaster caster = hall();
  const Pose2 here{2.0, 3.0, Angle{}};
  sensor_models::RangeSweep near_sighted = seen_at(caster, here, 0.0);
  for (sensor_models::SweepBeam& beam : near_sighted.beams)
    if (beam.range > 4.0) beam = {beam.bearing, 4.0, true};
  EXPECT_EQ(glance(caster, near_sighted, here, 10.0).through, 0.0);
  for (sensor_models::SweepBeam& beam : near_sighted.beams) beam = {beam.bearing, 4.0, true};
  EXPECT_GT(glance(caster, near_sighted, here, 10.0).through, 0.5) << "walls at 2 m are missed";
}

TEST(Glance, WallsThatTheMapLacksAreNoPeople) {
  const sensor_models::RayCaster caster = hall();
  const Pose2 here{4.0, 4.0, Angle{}};
  sensor_models::RangeSweep panel = seen_at(caster, here, 0.0);
  sensor_models::RangeSweep people = panel;
  for (sensor_models::SweepBeam& beam : panel.beams) {  // 3 m long, 1.5 m ahead
    const double ahead = 1.5 / std::cos(beam.bearing);
    if (std::abs(beam.bearing) < 0.78) beam.range = ahead;
  }
  for (std::size_t i = 0; i < people.beams.size(); ++i)  // shoulder to shoulder
    if (std::abs(people.beams[i].bearing) < 0.78) people.beams[i].range = 1.5 + 0.1 * static_cast<double>(i % 8);
  EXPECT_EQ(glance(caster, seen_at(caster, here, 0.0), here, 10.0).unmapped, 0.0);
  EXPECT_GT(glance(caster, panel, here, 10.0).unmapped, 0.2);
  EXPECT_LT(glance(caster, people, here, 10.0).unmapped, 0.05);
}

TEST(Glance, TooFewReadingsTellNothing) {
  const sensor_models::RayCaster caster = hall();
  sensor_models::RangeSweep few = seen_at(caster, {4.0, 4.0, Angle{}}, 0.0);
  few.beams.resize(5);
  const Glance glanced = glance(caster, few, {0.8, 0.8, Angle{}}, 10.0);
  EXPECT_EQ(glanced.through, 0.0);
  EXPECT_EQ(glanced.shorter, 0.0);
}

}  // namespace
}  // namespace docent::localization
