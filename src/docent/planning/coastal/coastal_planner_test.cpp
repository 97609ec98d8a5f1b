#include "docent/planning/coastal/coastal_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/base/random.h"
#include "docent/planning/coastal/testing.h"
#include "docent/planning/value_iteration/value_iteration.h"

namespace docent::planning {
namespace {

using testing::floor_of;
using testing::hall;

constexpr double kKnown = 0.05 * 0.05;  // [m2]

CoastalParams near_sighted(double weight) {
  CoastalParams params;
  params.weight = weight;
  params.places.range = 2.5;
  params.places.blocked = 0.6;
  params.places.beams = 60;
  return params;
}

double length_of(const std::vector<Point2>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += distance(way[i - 1], way[i]);
  return length;
}

/// Pillars here and there, so that ways have something to go round.
OccupancyGrid hall_with_pillars(Rng& rng) {
  OccupancyGrid map = hall(15.0, 12.0);
  for (int pillar = 0; pillar < 8; ++pillar) {
    const Point2 at{rng.uniform(1.0, 14.0), rng.uniform(1.0, 11.0)};
    const double half = rng.uniform(0.2, 1.0);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const Point2 cell =
          map.frame.centre({static_cast<int>(i) % map.frame.columns, static_cast<int>(i) / map.frame.columns});
      if (std::abs(cell.x - at.x) < half && std::abs(cell.y - at.y) < half) map.cells[i] = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

TEST(CoastalPlanner, WithoutWeightTheValuesAreThoseOfTheShortestWay) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Rng rng{seed};
    const OccupancyGrid map = hall_with_pillars(rng);
    const CoastalFloor floor = floor_of(map);
    CoastalPlanner coastal{map, floor, near_sighted(0.0)};
    ValueIteration shortest{floor.frame};
    shortest.set_costs(floor.costs);
    std::size_t goal = 0;
    while (!std::isfinite(floor.costs[goal]))
      goal = static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(floor.costs.size()) - 1));
    const CellIndex cell{static_cast<int>(goal) % floor.frame.columns, static_cast<int>(goal) / floor.frame.columns};
    const ValueIteration::Goal goals[]{{cell, 0.0F}};
    shortest.set_goals(goals);
    ASSERT_TRUE(shortest.iterate(10000));
    coastal.set_goal(floor.frame.centre(cell), 0.1);
    ASSERT_TRUE(coastal.iterate(10000));
    for (std::size_t i = 0; i < floor.costs.size(); ++i) {
      const CellIndex at{static_cast<int>(i) % floor.frame.columns, static_cast<int>(i) / floor.frame.columns};
      if (!std::isfinite(floor.costs[i])) continue;
      const auto wanted = static_cast<double>(shortest.value(at));
      if (!std::isfinite(wanted)) continue;
      for (const double deviation : {0.02, 0.3, 2.0})
        EXPECT_NEAR(coastal.value(floor.frame.centre(at), deviation * deviation), wanted, 0.01) << "seed " << seed;
    }
  }
}

TEST(CoastalPlanner, HugsTheWallsOfAnEmptyHall) {
  // 24 x 16 m, from the middle of one side to the middle of the other: straight through, or along the coast.
  const OccupancyGrid map = hall(24.0, 16.0);
  const Point2 from{1.0, 8.0};
  const Point2 to{23.0, 8.0};
  const auto way_with = [&](double weight) {
    CoastalPlanner planner{map, floor_of(map), near_sighted(weight)};
    planner.set_goal(to, 0.2);
    EXPECT_TRUE(planner.iterate(10000));
    return planner.way(from, kKnown);
  };
  const auto share_at_walls = [](const std::vector<Point2>& way) {
    const auto is_near = [](Point2 p) { return std::min({p.x, p.y, 24.0 - p.x, 16.0 - p.y}) < 2.5; };
    return static_cast<double>(std::count_if(way.begin(), way.end(), is_near)) / static_cast<double>(way.size());
  };
  const auto shortest = way_with(0.0);
  const auto coastal = way_with(0.5);
  ASSERT_FALSE(shortest.empty());
  ASSERT_FALSE(coastal.empty());
  EXPECT_LT(share_at_walls(shortest), 0.3);
  EXPECT_GT(share_at_walls(coastal), 0.9);
  EXPECT_LT(length_of(coastal), 2.0 * length_of(shortest));
  const CoastalPlanner judge{map, floor_of(map), near_sighted(0.5)};
  const double open = judge.variances_along(from, shortest, kKnown).back();
  const double coast = judge.variances_along(from, coastal, kKnown).back();
  EXPECT_LT(coast, open);
}

TEST(CoastalPlanner, WhoSeesFarDrivesStraight) {
  const OccupancyGrid map = hall(24.0, 16.0);
  CoastalParams params;
  params.weight = 0.1;
  params.places.range = 30.0;
  CoastalPlanner planner{map, floor_of(map), params};
  planner.set_goal({23.0, 8.0}, 0.2);
  ASSERT_TRUE(planner.iterate(10000));
  EXPECT_LT(length_of(planner.way({1.0, 8.0}, kKnown)), 1.1 * 22.0);
}

TEST(CoastalPlanner, CostsMoreForWhoKnowsLessAndForWhoCaresMore) {
  Rng rng{11};
  const OccupancyGrid map = hall_with_pillars(rng);
  double before = 0.0;
  for (const double weight : {0.0, 0.1, 0.5}) {
    CoastalPlanner planner{map, floor_of(map), near_sighted(weight)};
    planner.set_goal({13.0, 10.0}, 0.3);
    ASSERT_TRUE(planner.iterate(10000));
    const Point2 from{1.5, 1.5};
    EXPECT_GE(planner.value(from, kKnown), before);
    before = planner.value(from, kKnown);
    double known = 0.0;
    for (const double deviation : {0.01, 0.05, 0.2, 1.0, 3.0}) {
      const double value = planner.value(from, deviation * deviation);
      EXPECT_GE(value, known - 1e-3);
      known = value;
    }
  }
}

TEST(CoastalPlanner, IsAnyTime) {
  const OccupancyGrid map = hall(15.0, 12.0);
  CoastalPlanner at_once{map, floor_of(map), near_sighted(0.3)};
  CoastalPlanner bit_by_bit{map, floor_of(map), near_sighted(0.3)};
  for (CoastalPlanner* planner : {&at_once, &bit_by_bit}) planner->set_goal({13.0, 10.0}, 0.3);
  EXPECT_TRUE(at_once.iterate(10000));
  double last = std::numeric_limits<double>::infinity();
  for (int calls = 0; !bit_by_bit.is_settled(); ++calls) {
    ASSERT_LT(calls, 1000);
    (void)bit_by_bit.iterate(1);
    EXPECT_LE(bit_by_bit.value({1.5, 1.5}, kKnown), last);
    last = bit_by_bit.value({1.5, 1.5}, kKnown);
  }
  EXPECT_NEAR(last, at_once.value({1.5, 1.5}, kKnown), 0.02);
}

TEST(CoastalPlanner, FindsNoWayWhereThereIsNone) {
  OccupancyGrid map = hall(10.0, 6.0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const double x = map.frame.centre({static_cast<int>(i) % map.frame.columns, 0}).x;
    if (std::abs(x - 5.0) < 0.5) map.cells[i] = OccupancyGrid::kOccupied;
  }
  CoastalPlanner planner{map, floor_of(map), near_sighted(0.3)};
  planner.set_goal({8.0, 3.0}, 0.2);
  ASSERT_TRUE(planner.iterate(10000));
  EXPECT_TRUE(planner.way({2.0, 3.0}, kKnown).empty());
  EXPECT_FALSE(planner.way({6.5, 3.0}, kKnown).empty());
}

TEST(CoastalFloor, OpensACoarseCellWithAnyOpenOne) {
  const float closed = std::numeric_limits<float>::infinity();
  const std::vector<float> costs{closed, 0.2F, closed,  //
                                 closed, 0.1F, closed};
  const auto floor = CoastalFloor::of({3, 2, 0.1, {}}, costs, 2);
  ASSERT_EQ(floor.costs.size(), 2U);
  EXPECT_FLOAT_EQ(floor.costs[0], 0.2F);
  EXPECT_EQ(floor.costs[1], closed);
  EXPECT_DOUBLE_EQ(floor.frame.resolution, 0.2);
}

TEST(CoastalParams, RefusesNonsense) {
  EXPECT_TRUE(CoastalParams{}.validate());
  const auto is_refused = [](auto set) {
    CoastalParams params;
    set(params);
    return !params.validate();
  };
  EXPECT_TRUE(is_refused([](CoastalParams& params) { params.weight = -1.0; }));
  EXPECT_TRUE(is_refused([](CoastalParams& params) { params.levels = 1; }));
  EXPECT_TRUE(is_refused([](CoastalParams& params) { params.largest_deviation = params.least_deviation; }));
  EXPECT_TRUE(is_refused([](CoastalParams& params) { params.places.range = 0.0; }));
  EXPECT_TRUE(is_refused([](CoastalParams& params) { params.uncertainty.heading_scale = 0.0; }));
}

}  // namespace
}  // namespace docent::planning
