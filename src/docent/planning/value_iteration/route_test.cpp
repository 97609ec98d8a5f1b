#include "docent/planning/value_iteration/route.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/base/random.h"

namespace docent::planning {
namespace {

/// 6 x 4 m, walled in, with a wall from below in the middle that leaves a gap at the top.
OccupancyGrid two_rooms() {
  OccupancyGrid map;
  map.frame = {120, 80, 0.05, {0, 0}};
  map.cells.assign(map.frame.size(), 0);
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 120; ++column) {
      const bool border = row < 2 || row > 77 || column < 2 || column > 117;
      const bool wall = column >= 58 && column < 62 && row < 50;
      if (border || wall) map.cells[map.frame.index({column, row})] = 100;
    }
  }
  return map;
}

double least_distance(const std::vector<Point2>& way, Point2 point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& p : way) least = std::min(least, distance(p, point));
  return least;
}

TEST(RoutePlanner, GoesThroughTheGapAndKeepsClear) {
  const auto map = two_rooms();
  RoutePlanner planner{map, {}, {}, {}};
  planner.set_goal({5, 1}, 0.2);
  ASSERT_TRUE(planner.iterate(1000));
  const auto way = planner.way({1, 1});
  ASSERT_FALSE(way.empty());
  EXPECT_LT(distance(way.back(), {5, 1}), 0.25);
  EXPECT_GT(least_distance(way, {3.0, 2.5}), 0.365) << "too close to the end of the wall";
  Point2 before{1, 1};
  for (const auto& point : way) {
    EXPECT_LT(distance(before, point), 0.45);
    before = point;
  }
}

TEST(RoutePlanner, KeepsAwayFromHazardsAndStaysInTheArea) {
  const auto map = two_rooms();
  const std::vector<Polygon> hazards{{{2.7, 3.5}, {3.3, 3.5}, {3.3, 4.0}, {2.7, 4.0}}};  // leaves a metre of the gap
  RoutePlanner blocked{map, hazards, {}, {}};
  blocked.set_goal({5, 1}, 0.2);
  ASSERT_TRUE(blocked.iterate(1000));
  const auto way = blocked.way({1, 1});
  for (const auto& point : way) EXPECT_GT(distance(hazards[0], point), 0.265 + 0.1);
  const Polygon area{{0.2, 0.2}, {2.5, 0.2}, {2.5, 3.8}, {0.2, 3.8}};
  RoutePlanner fenced{map, {}, area, {}};
  fenced.set_goal({5, 1}, 0.2);
  ASSERT_TRUE(fenced.iterate(1000));
  EXPECT_TRUE(fenced.way({1, 1}).empty()) << "the goal lies outside the area";
}

TEST(RoutePlanner, GoesRoundWhatStandsInTheWayNow) {
  OccupancyGrid hall;
  hall.frame = {120, 120, 0.05, {0, 0}};
  hall.cells.assign(hall.frame.size(), 0);
  RoutePlanner planner{hall, {}, {}, {}};
  planner.set_goal({5, 3}, 0.2);
  planner.iterate(1000);
  EXPECT_LT(least_distance(planner.way({1, 3}), {3, 3}), 0.2);
  std::vector<bool> obstacles(planner.frame().size());
  obstacles[planner.frame().index(planner.frame().cell_at({3, 3}))] = true;
  planner.set_obstacles(obstacles);
  ASSERT_TRUE(planner.iterate(1000));
  EXPECT_GT(least_distance(planner.way({1, 3}), {3, 3}), 0.3);
  planner.set_obstacles(std::vector<bool>(planner.frame().size()));
  ASSERT_TRUE(planner.iterate(1000));
  EXPECT_LT(least_distance(planner.way({1, 3}), {3, 3}), 0.2);
}

TEST(RoutePlanner, WhoStandsAtTheRobotIsGoneRoundToo) {
  // The robot touches a row of three cells: where its way begins all floor is dear, and no shortcut leads through them.
  OccupancyGrid hall;
  hall.frame = {180, 120, 0.05, {0, 0}};
  hall.cells.assign(hall.frame.size(), 0);
  RoutePlanner planner{hall, {}, {}, {}};
  planner.set_goal({8, 3}, 0.2);
  const GridFrame& frame = planner.frame();
  std::vector<bool> obstacles(frame.size());
  const CellIndex body = frame.cell_at({3, 3});
  for (const int off : {-1, 0, 1}) obstacles[frame.index({body.column, body.row + off})] = true;
  for (const bool settled : {false, true}) {
    planner.set_obstacles(obstacles, settled ? obstacles : std::vector<bool>{});
    ASSERT_TRUE(planner.iterate(1000));
    const Point2 start = frame.centre(body) - Point2{0.3, 0.0};
    EXPECT_GT(least_distance(planner.way(start), frame.centre(body)), 0.25) << settled;
  }
}

TEST(RoutePlanner, PlansAsIfAllObstaclesHadBeenSetAtOnce) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng rng{seed};
    const auto map = two_rooms();
    RoutePlanner planner{map, {}, {}, {}};
    planner.set_goal({5, 1}, 0.2);
    ASSERT_TRUE(planner.iterate(100000));
    std::vector<bool> obstacles(planner.frame().size());
    std::vector<bool> settled(planner.frame().size());
    for (int step = 0; step < 12; ++step) {
      for (int k = 0; k < 6; ++k) {
        const auto cell = static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(obstacles.size()) - 1));
        obstacles[cell] = rng.chance(0.6);
        settled[cell] = obstacles[cell] && rng.chance(0.3);
      }
      planner.set_obstacles(obstacles, settled);
      ASSERT_TRUE(planner.iterate(100000));
      RoutePlanner fresh{map, {}, {}, {}};
      fresh.set_goal({5, 1}, 0.2);
      fresh.set_obstacles(obstacles, settled);
      ASSERT_TRUE(fresh.iterate(100000));
      for (const Point2 start : {Point2{1, 1}, Point2{2.2, 3}, Point2{4, 2.5}})
        ASSERT_NEAR(planner.cost_from(start), fresh.cost_from(start), 1e-4) << "seed " << seed << ", step " << step;
    }
  }
}

/// The planner's cells along a line across the hall.
std::vector<bool> barrier(const RoutePlanner& planner, double x, double from_y, double to_y) {
  std::vector<bool> cells(planner.frame().size());
  for (double y = from_y; y < to_y; y += 0.05) {
    const CellIndex cell = planner.frame().cell_at({x, y});
    if (planner.frame().holds(cell)) cells[planner.frame().index(cell)] = true;
  }
  return cells;
}

OccupancyGrid empty_hall() {
  OccupancyGrid hall;
  hall.frame = {120, 120, 0.05, {0, 0}};
  hall.cells.assign(hall.frame.size(), 0);
  return hall;
}

TEST(RoutePlanner, KeepsOffWhoStandsBesideTheWay) {
  RouteParams close;
  close.obstacle_comfort = close.obstacle_margin;
  RoutePlanner indifferent{empty_hall(), {}, {}, close};
  RoutePlanner planner{empty_hall(), {}, {}, {}};
  for (RoutePlanner* each : {&indifferent, &planner}) {
    std::vector<bool> obstacles(each->frame().size());
    obstacles[each->frame().index(each->frame().cell_at({3, 3.4}))] = true;
    each->set_obstacles(obstacles);
    each->set_goal({5, 3}, 0.1);
    ASSERT_TRUE(each->iterate(1000));
  }
  EXPECT_LT(least_distance(indifferent.way({1, 3}), {3, 3.4}), 0.55);
  EXPECT_GT(least_distance(planner.way({1, 3}), {3, 3.4}), 0.6);
}

TEST(RoutePlanner, WhatHasStoodForLongIsDearerAndMayBeClosed) {
  const auto cost = [](RouteParams params, bool is_settled) {
    RoutePlanner planner{empty_hall(), {}, {}, params};
    const auto cells = barrier(planner, 3.0, 0.0, 6.0);
    planner.set_obstacles(cells, is_settled ? cells : std::vector<bool>{});
    planner.set_goal({5, 3}, 0.1);
    EXPECT_TRUE(planner.iterate(1000));
    return planner.cost_from({1, 3});
  };
  const double passing = cost({}, false);
  const double settled = cost({}, true);
  EXPECT_GT(settled, 2.0 * passing) << "it would rather go far round";
  EXPECT_TRUE(std::isfinite(settled)) << "but with no other way it goes there and looks";
  RouteParams closed;
  closed.settled_closed = true;
  EXPECT_FALSE(std::isfinite(cost(closed, true)));
}

TEST(RoutePlanner, KeepsToAPreferredLaneAndLeavesItForObstacles) {
  OccupancyGrid hall;
  hall.frame = {200, 200, 0.05, {0, 0}};
  hall.cells.assign(hall.frame.size(), 0);
  RoutePlanner planner{hall, {}, {}, {}};
  planner.set_goal({9, 5}, 0.2);
  const std::vector<Point2> lane{{1, 5}, {1, 8}, {9, 8}, {9, 5}};
  planner.prefer(lane);
  ASSERT_TRUE(planner.iterate(1000));
  const auto along = planner.way({1, 5});
  EXPECT_GT(least_distance(along, {5, 5}), 2.5);
  EXPECT_LT(least_distance(along, {5, 8}), 0.5);
  std::vector<bool> obstacles(planner.frame().size());
  obstacles[planner.frame().index(planner.frame().cell_at({5, 8}))] = true;
  planner.set_obstacles(obstacles);
  ASSERT_TRUE(planner.iterate(1000));
  EXPECT_GT(least_distance(planner.way({1, 5}), {5, 8}), 0.3);
  EXPECT_GT(least_distance(planner.way({1, 5}), {5, 5}), 1.5) << "round the obstacle, not off the lane";
  planner.set_obstacles(std::vector<bool>(planner.frame().size()));
  planner.prefer({});
  ASSERT_TRUE(planner.iterate(1000));
  EXPECT_LT(least_distance(planner.way({1, 5}), {5, 5}), 0.2);
}

TEST(RoutePlanner, GoesToTheNearestOfSeveralGoals) {
  const auto map = two_rooms();
  RoutePlanner planner{map, {}, {}, {}};
  const std::vector<Point2> goals{{5, 1}, {1, 3}};
  planner.set_goals(goals, 0.2);
  ASSERT_TRUE(planner.settle({1, 1}, 1000));
  EXPECT_LT(distance(planner.way({1, 1}).back(), goals[1]), 0.25) << "2 m, not 5 m round the wall";
  ASSERT_TRUE(planner.settle({4, 1}, 1000));
  EXPECT_LT(distance(planner.way({4, 1}).back(), goals[0]), 0.25);
}

/// How often the way changes sides while things come and go beside a block with two ways round it that are equal.
int changes_of_side(bool hold) {
  OccupancyGrid hall;
  hall.frame = {160, 160, 0.05, {0, 0}};
  hall.cells.assign(hall.frame.size(), 0);
  for (int row = 60; row < 100; ++row)
    for (int column = 60; column < 100; ++column) hall.cells[hall.frame.index({column, row})] = 100;
  RouteParams params;
  params.obstacle_comfort = params.obstacle_margin;  // what stands beside a way is no reason to leave it
  params.obstacle_cost = 1.3;                        // noise; what really blocks the way held is a reason to leave it
  RoutePlanner planner{hall, {}, {}, params};
  planner.set_goal({7, 4}, 0.2);
  Rng rng{7};
  int changes = 0;
  int side = 0;
  for (int step = 0; step < 60; ++step) {
    std::vector<bool> obstacles(planner.frame().size());
    const double y = rng.chance(0.5) ? 1.9 : 6.1;  // at the edge of the one way or of the other
    obstacles[planner.frame().index(planner.frame().cell_at({rng.uniform(3.0, 5.0), y}))] = true;
    planner.set_obstacles(obstacles);
    EXPECT_TRUE(planner.settle({1, 4}, 10000));
    if (hold) planner.hold_way({1, 4});
    double most = 0.0;
    for (const Point2& point : planner.way({1, 4}))
      if (std::abs(point.y - 4.0) > std::abs(most)) most = point.y - 4.0;
    const int now = most > 0.0 ? 1 : -1;
    changes += side != 0 && now != side ? 1 : 0;
    side = now;
  }
  return changes;
}

TEST(RoutePlanner, DoesNotTakeTurnsBetweenEqualWays) {
  EXPECT_GE(changes_of_side(false), 10) << "the noise is too weak to show anything";
  EXPECT_EQ(changes_of_side(true), 0);
}

/// A hall with a block of 2 x 2 m in its middle, and the way from its left to its right: below the block or above it.
class TwoEqualWays {
 public:
  explicit TwoEqualWays(RouteParams params) : planner_{hall(), {}, {}, params} {
    planner_.set_goal({7, 4}, 0.2);
    EXPECT_TRUE(planner_.settle(kStart, 10000));
    planner_.hold_way(kStart);
  }
  /// Discs of a person's size, and a wall from one to another point.
  void see(std::span<const Point2> people, Point2 from = {}, Point2 to = {}) {
    const GridFrame& frame = planner_.frame();
    std::vector<bool> obstacles(frame.size());
    for (int row = 0; row < frame.rows; ++row)
      for (int column = 0; column < frame.columns; ++column)
        for (const Point2& person : people)
          if (distance(frame.centre({column, row}), person) <= 0.25) obstacles[frame.index({column, row})] = true;
    for (double along = 0.0; along < distance(from, to); along += 0.05)
      obstacles[frame.index(frame.cell_at(from + (along / distance(from, to)) * (to - from)))] = true;
    planner_.set_obstacles(obstacles);
    EXPECT_TRUE(planner_.settle(kStart, 10000));
    planner_.hold_way(kStart);
  }
  [[nodiscard]] bool is_above() const {
    double most = 0.0;
    for (const Point2& point : planner_.way(kStart))
      if (std::abs(point.y - 4.0) > std::abs(most)) most = point.y - 4.0;
    return most > 0.0;
  }
  [[nodiscard]] std::vector<Point2> way() const { return planner_.way(kStart); }

 private:
  static constexpr Point2 kStart{1, 4};
  static OccupancyGrid hall() {
    OccupancyGrid map;
    map.frame = {160, 160, 0.05, {0, 0}};
    map.cells.assign(map.frame.size(), 0);
    for (int row = 60; row < 100; ++row)
      for (int column = 60; column < 100; ++column) map.cells[map.frame.index({column, row})] = 100;
    return map;
  }
  RoutePlanner planner_;
};

/// Changes of side while somebody walks to and fro over the way that is held, as he likes.
int changes_while_somebody_walks(std::uint64_t seed, RouteParams params) {
  Rng rng{seed};
  TwoEqualWays ways{params};
  bool was_above = ways.is_above();
  int changes = 0;
  Point2 person{};
  Point2 wanted{};
  for (int step = 0; step < 40; ++step) {
    const std::vector<Point2> way = ways.way();
    if (step == 0 || distance(person, wanted) < 0.3) {
      const Point2 on_way = way[static_cast<std::size_t>(
          rng.integer(static_cast<std::int64_t>(way.size()) / 5, static_cast<std::int64_t>(way.size()) * 4 / 5))];
      wanted = on_way + rng.uniform(0.0, 1.5) * unit(Angle::radians(rng.uniform(0.0, 6.283)));
      if (step == 0) person = wanted;
    }
    const double left = distance(person, wanted);
    if (left > 0.0) person = person + (std::min(left, 0.3) / left) * (wanted - person);
    ways.see({&person, 1});
    changes += ways.is_above() != was_above ? 1 : 0;
    was_above = ways.is_above();
  }
  return changes;
}

TEST(RoutePlanner, SomebodyWhoWalksOverTheWayHeldDoesNotChangeIt) {
  RouteParams exactly;
  exactly.aside = 0.0;
  int changes = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    EXPECT_EQ(changes_while_somebody_walks(seed, {}), 0) << "seed " << seed;
    changes += changes_while_somebody_walks(seed, exactly);
  }
  EXPECT_GE(changes, 30) << "nobody was in the way";
}

TEST(RoutePlanner, AClosureChangesTheWayHeldOnceAndForAll) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng{seed};
    TwoEqualWays ways{{}};
    const bool above = ways.is_above();
    const double x = rng.uniform(3.0, 5.0);
    const Point2 from{x, above ? 4.9 : 0.0};
    const Point2 to{x, above ? 7.99 : 3.1};
    ways.see({}, from, to);
    EXPECT_NE(ways.is_above(), above) << "seed " << seed;
    ways.see({});
    EXPECT_NE(ways.is_above(), above) << "it does not turn back when the wall has gone, seed " << seed;
  }
}

TEST(RoutePlanner, GivesUpTheWayHeldForOneThatIsClearlyBetter) {
  OccupancyGrid hall;
  hall.frame = {160, 160, 0.05, {0, 0}};
  hall.cells.assign(hall.frame.size(), 0);
  RoutePlanner planner{hall, {}, {}, {}};
  planner.set_goal({7, 4}, 0.2);
  planner.settle({1, 4}, 1000);
  planner.hold_way({1, 4});
  std::vector<bool> wall(planner.frame().size());
  for (double y = 2.5; y < 8.0; y += 0.1) wall[planner.frame().index(planner.frame().cell_at({4, y}))] = true;
  planner.set_obstacles(wall);
  ASSERT_TRUE(planner.settle({1, 4}, 1000));
  planner.hold_way({1, 4});
  double lowest = 8.0;
  for (const Point2& point : planner.way({1, 4})) lowest = std::min(lowest, point.y);
  EXPECT_LT(lowest, 2.3);
}

}  // namespace
}  // namespace docent::planning
