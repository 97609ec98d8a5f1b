#include "docent/planning/coastal/place_information.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"
#include "docent/planning/coastal/testing.h"

namespace docent::planning {
namespace {

using testing::hall;

PoseInformation information_at(const sensor_models::RayCaster& caster, Point2 place,
                               const PlaceInformationParams& params, double rate = 0.0) {
  return scan_information(ranges_around(caster, place, params), rate, params);
}

TEST(PlaceInformation, OfACorridorIsAcrossItAndOfTheHeading) {
  // 40 m long, so that its ends are out of reach.
  const auto corridor = information_at(sensor_models::RayCaster{hall(40.0, 3.0)}, {20.0, 1.2}, {});
  EXPECT_GT(corridor.yy, 1000.0);
  EXPECT_GT(corridor.tt, 100.0);
  EXPECT_LT(corridor.xx, 1e-3 * corridor.yy);
  const auto eigenvalues = corridor.eigenvalues(0.25);
  EXPECT_LT(eigenvalues[2], 1e-3 * eigenvalues[1]);
}

TEST(PlaceInformation, OfASquareRoomIsTheSameBothWays) {
  const auto room = information_at(sensor_models::RayCaster{hall(6.0, 6.0)}, {3.0, 3.0}, {});
  EXPECT_NEAR(room.xx, room.yy, 0.02 * room.xx);
  EXPECT_NEAR(room.xy, 0.0, 0.02 * room.xx);
}

TEST(PlaceInformation, IsNoneWhereNothingIsInReach) {
  PlaceInformationParams params;
  params.range = 2.5;
  const sensor_models::RayCaster caster{hall(20.0, 20.0)};
  const auto middle = information_at(caster, {10.0, 10.0}, params);
  EXPECT_EQ(middle.xx + middle.yy + middle.tt, 0.0);
  const auto beside = information_at(caster, {10.0, 1.0}, params);
  EXPECT_GT(beside.yy, 100.0);
}

/// g of a beam against what the ray caster says of a robot that stands a little elsewhere, in a room whose walls are
/// neither parallel to the axes nor to each other.
TEST(PlaceInformation, IsTheSquareOfTheRangesSlopes) {
  OccupancyGrid map = hall(8.0, 8.0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Point2 at =
        map.frame.centre({static_cast<int>(i) % map.frame.columns, static_cast<int>(i) / map.frame.columns});
    if (at.x + 0.5 * at.y > 9.0 || at.y - 0.3 * at.x > 6.0) map.cells[i] = OccupancyGrid::kOccupied;
  }
  PlaceInformationParams params;
  params.map_deviation = 0.0;
  params.beams = 360;
  const sensor_models::RayCaster caster{map};
  const Point2 place{3.2, 2.9};
  const auto found = information_at(caster, place, params);
  PoseInformation wanted;
  constexpr double kAside = 0.15;  // [m], some cells of the map
  const auto at = [&](Point2 offset) { return ranges_around(caster, place + offset, params); };
  const auto east = at({kAside, 0}), west = at({-kAside, 0}), north = at({0, kAside}), south = at({0, -kAside});
  for (std::size_t i = 0; i < east.size(); ++i) {
    const double gx = static_cast<double>(east[i] - west[i]) / (2.0 * kAside);
    const double gy = static_cast<double>(north[i] - south[i]) / (2.0 * kAside);
    if (std::hypot(gx, gy) > 3.0) continue;  // an edge
    const double weight = params.independent_beams / 360.0 / (params.hit_deviation * params.hit_deviation);
    wanted.xx += weight * gx * gx;
    wanted.xy += weight * gx * gy;
    wanted.yy += weight * gy * gy;
  }
  EXPECT_NEAR(found.xx, wanted.xx, 0.15 * wanted.xx);
  EXPECT_NEAR(found.yy, wanted.yy, 0.15 * wanted.yy);
  EXPECT_NEAR(found.xy, wanted.xy, 0.15 * wanted.xx);
}

TEST(PlaceInformation, FallsWithTheCrowdAndGrowsWithTheReach) {
  const sensor_models::RayCaster caster{hall(12.0, 9.0)};
  Rng rng{7};
  for (int trial = 0; trial < 50; ++trial) {
    const Point2 place{rng.uniform(0.5, 11.5), rng.uniform(0.5, 8.5)};
    double before = std::numeric_limits<double>::infinity();
    for (const double rate : {0.0, 0.1, 0.5, 2.0}) {
      const auto place_in_crowd = information_at(caster, place, {}, rate);
      EXPECT_LT(place_in_crowd.xx + place_in_crowd.yy, before);
      before = place_in_crowd.xx + place_in_crowd.yy;
    }
    double nearer = -1.0;
    for (const double range : {1.0, 2.5, 4.0, 10.0}) {
      PlaceInformationParams params;
      params.range = range;
      const auto seen = information_at(caster, place, params);
      // A beam beside the last one that ends in reach is taken for an edge: a few may be lost.
      EXPECT_GE(seen.xx + seen.yy, 0.98 * nearer);
      nearer = seen.xx + seen.yy;
    }
  }
}

TEST(PlaceInformation, HidesTheShareOfBeamsThatIsAskedFor) {
  const auto map = hall(12.0, 9.0);
  for (const double blocked : {0.2, 0.6, 0.9}) {
    PlaceInformationParams params;
    params.blocked = blocked;
    const auto ranges = ranges_around(sensor_models::RayCaster{map}, {4.0, 3.0}, params);
    const double rate = hiding_rate(ranges, params);
    double hidden = 0.0;
    for (const float range : ranges) hidden += 1.0 - std::exp(-rate * static_cast<double>(range));
    EXPECT_NEAR(hidden / static_cast<double>(ranges.size()), blocked, 1e-6);
  }
  EXPECT_EQ(hiding_rate(std::vector<float>{1.0F, 2.0F}, {}), 0.0);
}

TEST(PoseInformation, EigenvaluesAreThoseOfTheMatrix) {
  Rng rng{3};
  for (int trial = 0; trial < 100; ++trial) {
    // A sum of squares: semidefinite.
    PoseInformation m;
    for (int i = 0; i < 4; ++i) {
      const double x = rng.normal();
      const double y = rng.normal();
      const double t = rng.normal();
      m.xx += x * x, m.xy += x * y, m.yy += y * y, m.xt += x * t, m.yt += y * t, m.tt += t * t;
    }
    const auto [first, second, third] = m.eigenvalues(1.0);
    EXPECT_GE(first, second);
    EXPECT_GE(second, third);
    EXPECT_NEAR(first + second + third, m.xx + m.yy + m.tt, 1e-9);
    const double determinant =
        m.xx * (m.yy * m.tt - m.yt * m.yt) - m.xy * (m.xy * m.tt - m.yt * m.xt) + m.xt * (m.xy * m.yt - m.yy * m.xt);
    EXPECT_NEAR(first * second * third, determinant, 1e-6 * (1.0 + std::abs(determinant)));
  }
}

TEST(PlaceInformationParams, RefusesNonsense) {
  EXPECT_TRUE(PlaceInformationParams{}.validate());
  EXPECT_FALSE((PlaceInformationParams{.range = 0.0}.validate()));
  EXPECT_FALSE((PlaceInformationParams{.blocked = 1.0}.validate()));
  EXPECT_FALSE((PlaceInformationParams{.hit_deviation = 0.0}.validate()));
}

}  // namespace
}  // namespace docent::planning
