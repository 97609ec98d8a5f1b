#include "docent/localization/beam_choice/moved_things.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "docent/base/random.h"
#include "docent/geometry/polygon.h"

namespace docent::localization::moved_things_test {
namespace {

/// What a laser sees in a room of 8 x 6 m with a pillar, of persons [m], and of no wall beyond its reach.
sensor_models::RangeSweep sweep_at(const Pose2& pose, const std::vector<Point2>& persons, int beams, Rng& rng) {
  std::vector<Segment> walls = sides({{0.0, 0.0}, {8.0, 0.0}, {8.0, 6.0}, {0.0, 6.0}});
  for (const Segment& side : sides({{2.0, 2.0}, {2.3, 2.0}, {2.3, 2.3}, {2.0, 2.3}})) walls.push_back(side);
  sensor_models::RangeSweep sweep;
  for (int i = 0; i < beams; ++i) {
    const double bearing = -std::numbers::pi + 2.0 * std::numbers::pi * i / beams;
    const Point2 ray = unit(pose.theta + Angle::radians(bearing));
    double range = 5.0;
    for (const Segment& wall : walls)
      if (const auto hit = ray_distance(pose.position(), ray, wall)) range = std::min(range, *hit);
    for (const Point2 person : persons)
      if (const auto hit = ray_distance(pose.position(), ray, person, 0.25)) range = std::min(range, *hit);
    sweep.beams.push_back({bearing, range < 5.0 ? range + rng.normal(0.0, 0.02) : 5.0, range >= 5.0});
  }
  return sweep;
}

TEST(MovedThings, ARobotThatMovesAmongThingsThatStandSeesNone) {
  for (const int beams : {90, 360, 1440}) {
    Rng rng{1};
    MovedThings sum;
    for (int n = 0; n < 20; ++n) {
      const Pose2 before{1.0 + 0.2 * n, 4.0, Angle::degrees(7.0 * n)};
      const Pose2 now = before * Pose2{0.4, 0.05, Angle::degrees(n % 2 == 0 ? 40.0 : -3.0)};
      const std::vector<Point2> standing{{3.0, 5.0}, {6.0, 2.0}};
      sum += moved_things(sweep_at(before, standing, beams, rng), sweep_at(now, standing, beams, rng),
                          inverse(before) * now * Pose2{0.01, 0.01, Angle::degrees(0.5)});
    }
    EXPECT_GT(sum.readings, 1000U);
    EXPECT_LT(sum.share(), 0.002) << beams;
  }
}

TEST(MovedThings, WhoWalksIsSeenWhereHeComesAndWhereHeWas) {
  for (const int beams : {90, 360, 1440}) {
    Rng rng{2};
    const Pose2 before{4.0, 3.0, {}};
    const Pose2 now = before * Pose2{0.3, 0.0, Angle::degrees(20.0)};
    const auto things = moved_things(sweep_at(before, {{5.5, 4.0}}, beams, rng),
                                     sweep_at(now, {{5.5, 5.2}}, beams, rng), inverse(before) * now);
    // He hides some 15 degrees before and 11 after.
    EXPECT_GT(things.share(), 0.02) << beams;
    EXPECT_LT(things.share(), 0.06) << beams;
  }
  EXPECT_EQ(moved_things({}, {}, {}).share(), 0.0);
}

}  // namespace
}  // namespace docent::localization::moved_things_test
