#include "docent/planning/exploration/explorer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "docent/base/random.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::planning::explorer_test {
namespace {

constexpr double kRange = 4.0;  // [m]

/// A floor of rooms with doors of 1.2 m, some of them shut, and furniture; unknown to the robot.
OccupancyGrid any_floor(Rng& rng) {
  OccupancyGrid map;
  map.frame = {240, 200, 0.05, {-2.0, 1.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  const auto fill = [&](int left, int bottom, int right, int top, std::int8_t as) {
    for (int row = std::max(0, bottom); row < std::min(map.frame.rows, top); ++row)
      for (int column = std::max(0, left); column < std::min(map.frame.columns, right); ++column)
        map.cells[map.frame.index({column, row})] = as;
  };
  for (const int column : {0, 80, 160, 236}) fill(column, 0, column + 4, 200, OccupancyGrid::kOccupied);
  for (const int row : {0, 100, 196}) fill(0, row, 240, row + 4, OccupancyGrid::kOccupied);
  for (const int column : {80, 160}) {
    for (const int row : {0, 100}) {
      if (rng.chance(0.2)) continue;
      const int at = row + static_cast<int>(rng.integer(20, 60));
      fill(column, at, column + 4, at + 24, OccupancyGrid::kFree);
    }
  }
  for (const int column : {0, 80, 160}) {
    if (rng.chance(0.2)) continue;
    const int at = column + static_cast<int>(rng.integer(15, 45));
    fill(at, 100, at + 24, 104, OccupancyGrid::kFree);
  }
  for (int i = 0; i < 8; ++i) {
    const int left = static_cast<int>(rng.integer(10, 220));
    const int bottom = static_cast<int>(rng.integer(10, 180));
    fill(left, bottom, left + static_cast<int>(rng.integer(4, 14)), bottom + static_cast<int>(rng.integer(4, 14)),
         OccupancyGrid::kOccupied);
  }
  fill(30, 30, 50, 50, OccupancyGrid::kFree);  // the robot starts here
  return map;
}

/// What 720 beams from here show.
void see(const sensor_models::RayCaster& caster, Point2 from, OccupancyGrid& known) {
  const double step = 0.3 * known.frame.resolution;
  for (int beam = 0; beam < 720; ++beam) {
    const double bearing = beam * std::numbers::pi / 360.0;
    const Point2 ahead{std::cos(bearing), std::sin(bearing)};
    const double range = caster.cast(from, ahead, kRange, 0.0).value_or(0.0);
    const auto mark = [&](double at, std::int8_t as) {
      const CellIndex cell = known.frame.cell_at(from + at * ahead);
      if (!known.frame.holds(cell)) return;
      auto& now = known.cells[known.frame.index(cell)];
      now = std::max(now, as);
    };
    for (double at = 0.0; at < range - 1e-6; at += step) mark(at, OccupancyGrid::kFree);
    if (range < kRange) mark(range + 1e-3, OccupancyGrid::kOccupied);
  }
}

/// Free cells that a disc of this radius can get to from here.
std::vector<bool> reachable(const OccupancyGrid& map, Point2 from, double radius) {
  std::vector<bool> solid(map.frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = map.cells[i] != OccupancyGrid::kFree;
  const auto clearances = distance_transform(map.frame, solid);
  std::vector<bool> seen(map.frame.size());
  std::queue<CellIndex> queue;
  queue.push(map.frame.cell_at(from));
  seen[map.frame.index(queue.front())] = true;
  while (!queue.empty()) {
    const CellIndex cell = queue.front();
    queue.pop();
    for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const CellIndex next{cell.column + dc, cell.row + dr};
      if (!map.frame.holds(next) || seen[map.frame.index(next)]) continue;
      if (static_cast<double>(clearances[map.frame.index(next)]) < radius) continue;
      seen[map.frame.index(next)] = true;
      queue.push(next);
    }
  }
  return seen;
}

TEST(Explorer, ExploresUntilNothingReachableIsUnknown) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Rng rng{seed};
    const OccupancyGrid truth = any_floor(rng);
    const sensor_models::RayCaster caster{truth};
    OccupancyGrid known = truth;
    std::fill(known.cells.begin(), known.cells.end(), OccupancyGrid::kUnknown);
    Point2 robot = truth.frame.centre({40, 40});
    Explorer explorer{{}};
    double driven = 0.0;
    int looks = 0;
    for (;; ++looks) {
      ASSERT_LT(looks, 400) << "seed " << seed << ": it goes on for ever";
      see(caster, robot, known);
      const auto next = explorer.next(known, robot);
      if (!next) break;
      for (double gone = 0.0; const Point2& point : next->way) {
        const CellIndex cell = known.frame.cell_at(point);
        if (gone > 1.0 || !known.is_free(cell)) break;  // half a metre or so, then it looks again
        gone += distance(robot, point);
        driven += distance(robot, point);
        robot = point;
        ASSERT_GE(caster.clearance(robot), 0.265F) << "seed " << seed << ": against a wall";
      }
    }
    // What a slightly stouter robot could reach is known, with what borders on it.
    const auto could = reachable(truth, truth.frame.centre({40, 40}), 0.265 + 0.10 + 0.15);
    std::size_t reached = 0;
    std::size_t missed = 0;
    for (std::size_t i = 0; i < could.size(); ++i) {
      if (!could[i]) continue;
      ++reached;
      missed += known.cells[i] != OccupancyGrid::kFree ? 1U : 0U;
    }
    EXPECT_GT(reached, 2000U) << "seed " << seed;
    EXPECT_EQ(missed, 0U) << "seed " << seed << ", " << driven << " m";
    EXPECT_LT(driven, 250.0) << "seed " << seed << ": 12 x 10 m";
  }
}

TEST(Explorer, ShutRoomsAndCracksAreNoGoals) {
  OccupancyGrid map;
  map.frame = {100, 60, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 5; row < 55; ++row) {
    for (int column = 5; column < 50; ++column) {
      const bool border = row == 5 || row == 54 || column == 5 || column == 49;
      map.cells[map.frame.index({column, row})] = border ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
    }
  }
  EXPECT_FALSE((Explorer{{}}.next(map, {1.0, 1.0})));
  for (int row = 30; row < 36; ++row) map.cells[map.frame.index({49, row})] = OccupancyGrid::kUnknown;
  EXPECT_FALSE((Explorer{{}}.next(map, {1.0, 1.0}))) << "30 cm";
  for (int row = 29; row < 43; ++row) map.cells[map.frame.index({49, row})] = OccupancyGrid::kUnknown;
  const auto gap = Explorer{{}}.next(map, {1.0, 1.0});
  ASSERT_TRUE(gap) << "70 cm, which may be more from nearby";
  EXPECT_LT(gap->way.back().x, 49 * 0.05 - 0.3) << "it does not go in";
  Explorer looks{{}};
  for (int look = 0; look < ExplorerParams{}.close_looks; ++look) (void)looks.next(map, gap->way.back());
  EXPECT_FALSE(looks.next(map, gap->way.back())) << "it is no more";
  for (int row = 20; row < 40; ++row) map.cells[map.frame.index({49, row})] = OccupancyGrid::kUnknown;
  const auto door = Explorer{{}}.next(map, {1.0, 1.0});
  ASSERT_TRUE(door);
  EXPECT_NEAR(door->way.back().x, 49.5 * 0.05, 0.1);
}

TEST(Explorer, WhatCannotBeSeenIsGivenUp) {
  OccupancyGrid map;
  map.frame = {80, 40, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 10; row < 30; ++row)
    for (int column = 50; column < 54; ++column) map.cells[map.frame.index({column, row})] = OccupancyGrid::kUnknown;
  Explorer explorer{{}};
  Point2 robot{1.0, 1.0};
  int calls = 0;
  for (auto next = explorer.next(map, robot); next; next = explorer.next(map, robot)) {
    ASSERT_LT(++calls, 60);
    robot = next->way.back();
  }
  EXPECT_GT(calls, 0);
}

/// Free floor of 10 x 4 m whose far end is unknown.
OccupancyGrid half_known_hall() {
  OccupancyGrid map;
  map.frame = {240, 80, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 0; row < 80; ++row)
    for (int column = 0; column < 200; ++column) {
      const bool is_wall = row == 0 || row == 79 || column == 0;
      map.cells[map.frame.index({column, row})] = is_wall ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
    }
  return map;
}

double nearest_to(const std::vector<Point2>& way, Point2 place) {
  double nearest = 1e9;
  for (const Point2 point : way) nearest = std::min(nearest, distance(point, place));
  return nearest;
}

TEST(Explorer, KeepsOffWhatPeopleHaveMarkedAndInsideTheArea) {
  const OccupancyGrid map = half_known_hall();
  const Point2 robot{1.0, 2.0};
  const Polygon glass{{4.0, 1.2}, {5.0, 1.2}, {5.0, 2.8}, {4.0, 2.8}};
  const ExplorerParams params;
  const double keep = params.robot_radius + params.hazard_margin;
  Explorer straight{params};
  const auto through = straight.next(map, robot);
  ASSERT_TRUE(through);
  EXPECT_LT(nearest_to(through->way, {4.5, 2.0}), 0.3);
  Explorer marked{params, {glass}};
  const auto around = marked.next(map, robot);
  ASSERT_TRUE(around);
  for (const Point2 point : around->way) EXPECT_GE(distance(glass, point), keep) << point.x << ", " << point.y;
  Explorer fenced{params, {}, Polygon{{0.0, 0.0}, {6.0, 0.0}, {6.0, 4.0}, {0.0, 4.0}}};
  EXPECT_FALSE(fenced.next(map, robot)) << "what is unknown lies outside of the area";
}

TEST(Explorer, KeepsWithinSightOfWalls) {
  OccupancyGrid map;
  map.frame = {600, 400, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int column = 0; column < 600; ++column) {
    for (const int row : {0, 399}) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  }
  const auto cells_in_the_open = [&](double open_cost) {
    ExplorerParams params;
    params.open_cost = open_cost;
    const auto way = Explorer{params}.way_to(map, {1.0, 2.0}, {29.0, 10.0});
    EXPECT_GT(way.back().y, 9.8) << "it gets there";
    return std::count_if(way.begin(), way.end(), [](Point2 point) { return point.y > 6.0; });
  };
  EXPECT_LT(2 * cells_in_the_open(ExplorerParams{}.open_cost), cells_in_the_open(0.0));
}

TEST(Explorer, DoubtKeepsItFartherOffWhatPeopleHaveMarked) {
  const OccupancyGrid map = half_known_hall();
  const Point2 robot{1.0, 2.0};
  const Polygon glass{{4.0, 1.2}, {5.0, 1.2}, {5.0, 2.6}, {4.0, 2.6}};
  const ExplorerParams params;
  Explorer explorer{params, {glass}};
  explorer.set_doubt(0.25);
  const auto around = explorer.next(map, robot);
  ASSERT_TRUE(around);
  const double keep = params.robot_radius + params.hazard_margin + params.doubt_sigmas * 0.25 - params.doubt_free;
  for (const Point2 point : around->way) EXPECT_GE(distance(glass, point), keep - 1e-6) << point.x << ", " << point.y;
  explorer.set_doubt(2.0);
  EXPECT_FALSE(explorer.next(map, robot)) << "it comes back when it is surer";
  EXPECT_FALSE(explorer.way_to(map, robot, {6.0, 2.0}, true).empty()) << "but it finds its way home";
}

TEST(Explorer, WhatIsNearHomeComesFirst) {
  OccupancyGrid map = half_known_hall();
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < 20; ++column) map.cells[map.frame.index({column, row})] = OccupancyGrid::kUnknown;
  }
  double known = 0.0;  // [m], where the floor ends that is known
  for (int column = 0; column < map.frame.columns; ++column)
    if (map.is_free({column, 40})) known = map.frame.centre({column, 40}).x;
  const Point2 robot{known - 3.0, 2.0};
  Explorer nearest{{}};
  ASSERT_TRUE(nearest.next(map, robot));
  EXPECT_GT(nearest.next(map, robot)->way.back().x, robot.x);
  Explorer from_home{{}};
  from_home.set_home({known - 3.0, 2.0});
  EXPECT_GT(from_home.next(map, robot)->way.back().x, robot.x) << "not for every little difference";
  Explorer far_from_home{{}};
  far_from_home.set_home({1.0, 2.0});
  EXPECT_LT(far_from_home.next(map, robot)->way.back().x, robot.x);
}

TEST(Explorer, GoesRoundWhatHeldItUpUntilThatIsForgotten) {
  const OccupancyGrid map = half_known_hall();
  const Point2 robot{1.0, 2.0};
  Explorer explorer{{}};
  explorer.block({4.0, 2.0}, 0.8);
  const auto round = explorer.next(map, robot);
  ASSERT_TRUE(round);
  EXPECT_GE(nearest_to(round->way, {4.0, 2.0}), 0.8);
  explorer.block({4.0, 2.0}, 5.0);
  EXPECT_FALSE(explorer.next(map, robot));
  explorer.unblock();
  EXPECT_TRUE(explorer.next(map, robot));
}

TEST(Explorer, FindsTheWayBackAndNamesWhatItCouldNotReach) {
  const OccupancyGrid map = half_known_hall();
  Explorer explorer{{}, {}, Polygon{{0.0, 0.0}, {8.0, 0.0}, {8.0, 4.0}, {0.0, 4.0}}};
  const auto way = explorer.way_to(map, {7.0, 2.0}, {1.0, 2.0});
  ASSERT_FALSE(way.empty());
  EXPECT_LT(distance(way.back(), {1.0, 2.0}), 0.15);
  EXPECT_TRUE(explorer.way_to(map, {7.0, 2.0}, {11.0, 2.0}).empty()) << "nobody has seen that place";
  EXPECT_TRUE(explorer.unreached(map).empty()) << "outside of the area nothing is missed";
  Explorer free{{}};
  const auto unreached = free.unreached(map);
  ASSERT_EQ(unreached.size(), 1U);
  EXPECT_NEAR(unreached.front().place.x, 10.0, 0.2);
}

/// The area of a hall of 12 x 4 m, which narrows to so much [m] either side of its middle between x = 4 and 5 m.
Polygon area_with_door(double half) {
  return {{0.3, 0.3},  {4, 0.3}, {4, 2 - half}, {5, 2 - half}, {5, 0.3}, {11.7, 0.3},
          {11.7, 3.7}, {5, 3.7}, {5, 2 + half}, {4, 2 + half}, {4, 3.7}, {0.3, 3.7}};
}

OccupancyGrid empty_hall() {
  OccupancyGrid map;
  map.frame = {240, 80, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  return map;
}

TEST(Explorer, WaysLeadWhereAvoidanceLetsTheCentreBe) {
  const Point2 robot{2.0, 2.0}, goal{9.0, 2.0};
  const auto has_way = [&](double half, Point2 from) {
    const Explorer explorer{{}, {}, area_with_door(half)};
    return !explorer.way_to(empty_hall(), from, goal).empty();
  };
  EXPECT_FALSE(has_way(0.1, robot)) << "the floor is wide, the area is not";
  EXPECT_FALSE(has_way(0.1, {3.5, 2.0})) << "and it stays narrow from nearby";
  EXPECT_TRUE(has_way(0.2, robot)) << "as docent museum draws its doors at least";
}

TEST(Explorer, FromTooNearToTheBorderTheWayLeadsAway) {
  const Explorer explorer{{}, {}, area_with_door(0.4)};
  const auto way = explorer.way_to(empty_hall(), {2.0, 0.36}, {9.0, 2.0});
  ASSERT_FALSE(way.empty());
  for (const Point2 at : way) {
    if (distance(at, {2.0, 0.36}) < 0.9) continue;
    EXPECT_GE(outline_distance(area_with_door(0.4), at), 0.13);
  }
}

/// The hall of 12 x 4 m with a wall at 4.5 m, whose door of so many cells begins at a row.
OccupancyGrid hall_with_door(int first, int cells) {
  OccupancyGrid map = empty_hall();
  for (int row = 0; row < 80; ++row) {
    if (row >= first && row < first + cells) continue;
    for (int column = 88; column < 92; ++column) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  }
  return map;
}

TEST(Explorer, ADoorIsOpenOrShutWhereverTheGridLies) {
  for (const int first : {30, 31}) {
    EXPECT_FALSE(Explorer{{}}.way_to(hall_with_door(first, 15), {2.0, 2.0}, {9.0, 2.0}).empty()) << "0.75 m";
    EXPECT_TRUE(Explorer{{}}.way_to(hall_with_door(first, 12), {2.0, 2.0}, {9.0, 2.0}).empty()) << "0.6 m";
  }
}

TEST(Explorer, GoesIntoNoPlaceFromWhichItFindsNoWayBack) {
  // From right before the door, and from within it, nothing is passable that is not from far away.
  const OccupancyGrid map = hall_with_door(34, 13);
  for (const double x : {2.0, 3.7, 4.0}) EXPECT_TRUE(Explorer{{}}.way_to(map, {x, 2.0}, {9.0, 2.0}).empty()) << x;
  const Explorer explorer{{}};
  EXPECT_FALSE(explorer.way_to(map, {0.5, 0.5}, {2.0, 2.0}).empty());
  OccupancyGrid wall = empty_hall();
  for (int row = 0; row < 80; ++row) wall.cells[wall.frame.index({60, row})] = OccupancyGrid::kOccupied;
  EXPECT_FALSE(explorer.way_to(wall, {2.7, 2.0}, {0.5, 2.0}).empty()) << "who stands too near gets away";
}

TEST(Explorer, WhereItHasDrivenItCanAgain) {
  const OccupancyGrid map = hall_with_door(34, 11);  // the map has drawn it narrow since
  const Point2 robot{9.0, 2.0}, home{2.0, 2.0};
  Explorer explorer{{}};
  EXPECT_TRUE(explorer.way_to(map, robot, home).empty());
  std::vector<Point2> trail;
  for (double x = 2.0; x <= 9.0; x += 0.2) trail.push_back({x, 1.97});
  explorer.set_trail(trail);
  const auto way = explorer.way_to(map, robot, home);
  ASSERT_FALSE(way.empty());
  for (const Point2 at : way) {
    if (std::abs(at.x - 4.5) < 0.2) {
      EXPECT_NEAR(at.y, 1.97, 0.01) << "as it drove";
    }
  }
  explorer.block({4.5, 2.0}, 0.5);
  EXPECT_TRUE(explorer.way_to(map, robot, home).empty()) << "something stands there now";
  explorer.unblock();
  explorer.set_trail({{2.0, 2.0}, {9.0, 2.0}});
  EXPECT_TRUE(explorer.way_to(map, robot, home).empty()) << "it was carried";
}

TEST(Explorer, KeepsOffMarksAsFarAsTheyMayLieOff) {
  OccupancyGrid map;
  map.frame = {200, 100, 0.05, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  const std::vector<Polygon> hazards{{{4.5, 0.0}, {5.5, 0.0}, {5.5, 3.0}, {4.5, 3.0}}};  // 2 m are left beside it
  Explorer explorer{{}, hazards};
  EXPECT_FALSE(explorer.way_to(map, {2.0, 2.5}, {8.0, 2.5}).empty());
  explorer.set_mark_margin([](Point2) { return 1.6; });
  EXPECT_TRUE(explorer.way_to(map, {2.0, 2.5}, {8.0, 2.5}).empty());
  explorer.set_mark_margin([](Point2 place) { return place.x > 9.0 ? 1.6 : 0.0; });
  EXPECT_FALSE(explorer.way_to(map, {2.0, 2.5}, {8.0, 2.5}).empty()) << "elsewhere it knows them better";
}

}  // namespace
}  // namespace docent::planning::explorer_test
