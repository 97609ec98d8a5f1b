#include "docent/mapping/topological/topological_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::mapping {
namespace {

/// A plan at 5 cm, all of it unknown until it is drawn.
class Plan {
 public:
  Plan() {
    map_.frame = {320, 200, 0.05, {-1.0, -1.0}};
    map_.cells.assign(map_.frame.size(), OccupancyGrid::kUnknown);
  }
  void fill(Point2 low, Point2 high, std::int8_t value) {
    for (int row = 0; row < map_.frame.rows; ++row) {
      for (int column = 0; column < map_.frame.columns; ++column) {
        const Point2 at = map_.frame.centre({column, row});
        if (at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y)
          map_.cells[map_.frame.index({column, row})] = value;
      }
    }
  }
  void room(Point2 low, Point2 high) {
    fill({low.x - 0.1, low.y - 0.1}, {high.x + 0.1, high.y + 0.1}, OccupancyGrid::kOccupied);
    fill(low, high, OccupancyGrid::kFree);
  }
  void door(Point2 low, Point2 high) { fill(low, high, OccupancyGrid::kFree); }
  void thing(Point2 low, Point2 high) { fill(low, high, OccupancyGrid::kOccupied); }
  [[nodiscard]] int place_at(const TopologicalMap& rooms, Point2 at) const {
    return rooms.regions.of[map_.frame.index(map_.frame.cell_at(at))];
  }
  [[nodiscard]] const OccupancyGrid& map() const { return map_; }

 private:
  OccupancyGrid map_;
};

/// A hallway along the bottom, three rooms above it, the last two joined by a second door.
Plan office() {
  Plan plan;
  plan.room({0.0, 0.0}, {14.0, 2.0});
  for (const double x : {0.0, 4.8, 9.6}) {
    plan.room({x, 2.2}, {x + 4.4, 6.6});
    plan.door({x + 1.0, 1.9}, {x + 2.0, 2.3});
  }
  plan.door({9.1, 4.0}, {9.7, 4.9});
  return plan;
}

TEST(TopologicalMap, RoomsAlongAHallway) {
  const Plan plan = office();
  const TopologicalMap rooms = topological_map(plan.map());
  ASSERT_EQ(rooms.places.size(), 4U);
  ASSERT_EQ(rooms.regions.gaps.size(), 4U);
  const int hallway = plan.place_at(rooms, {7.0, 1.0});
  EXPECT_EQ(rooms.places[static_cast<std::size_t>(hallway)].kind, PlaceKind::hallway);
  EXPECT_EQ(rooms.neighbours(hallway).size(), 3U);
  for (const double x : {0.0, 4.8, 9.6}) {
    const int room = plan.place_at(rooms, {x + 2.2, 4.4});
    const Place& place = rooms.places[static_cast<std::size_t>(room)];
    EXPECT_EQ(place.kind, PlaceKind::room);
    EXPECT_NEAR(place.shape.area, 4.4 * 4.4, 0.5);
    EXPECT_LT(distance(place.middle, {x + 2.2, 4.4}), 0.2);
    EXPECT_EQ(rooms.neighbours(room).size(), x > 4.0 ? 2U : 1U);
    EXPECT_TRUE(std::any_of(rooms.regions.gaps.begin(), rooms.regions.gaps.end(), [x](const Gap& gap) {
      return distance(gap.at, {x + 1.5, 2.1}) < 0.25 && std::abs(gap.width - 1.0) < 0.15;
    })) << "its door";
  }
}

TEST(TopologicalMap, FurnitureDividesNoRoom) {
  Plan plan = office();
  plan.thing({1.0, 4.0}, {2.6, 4.8});
  plan.thing({3.0, 3.2}, {3.5, 3.7});
  plan.thing({6.0, 3.0}, {6.8, 4.6});
  const TopologicalMap rooms = topological_map(plan.map());
  EXPECT_EQ(rooms.places.size(), 4U);
  EXPECT_EQ(plan.place_at(rooms, {1.8, 4.4}), plan.place_at(rooms, {0.4, 6.2})) << "the table is in the room";
}

TEST(TopologicalMap, AWideOpeningIsNoDoor) {
  Plan plan = office();
  plan.door({9.1, 2.6}, {9.7, 6.2});
  const TopologicalMap rooms = topological_map(plan.map());
  EXPECT_EQ(rooms.places.size(), 3U);
  EXPECT_EQ(plan.place_at(rooms, {7.0, 4.4}), plan.place_at(rooms, {11.8, 4.4}));
}

TEST(TopologicalMap, WhatIsShutInBetweenWallsIsNoPlace) {
  Plan plan = office();
  plan.door({14.4, 5.0}, {14.9, 6.0});
  EXPECT_EQ(topological_map(plan.map()).places.size(), 4U);
}

TEST(TopologicalMap, AMapThatHasJustBegunHasOnePlaceOrNone) {
  const Plan empty;
  EXPECT_TRUE(topological_map(empty.map()).places.empty());
  Plan begun;
  begun.door({0.0, 0.0}, {3.0, 2.5});
  const TopologicalMap rooms = topological_map(begun.map());
  ASSERT_EQ(rooms.places.size(), 1U);
  EXPECT_TRUE(rooms.neighbours(0).empty());
}

TEST(PlaceKind, IsThatOfTheExamplesMostLikeIt) {
  const PlaceExample examples[] = {{{20.0, 4.0, 1.5, 1}, PlaceKind::room}, {{60.0, 2.0, 15.0, 9}, PlaceKind::hallway}};
  EXPECT_EQ(kind_of({15.0, 3.0, 1.8, 2}, examples, 1), PlaceKind::room);
  EXPECT_EQ(kind_of({40.0, 2.2, 8.0, 6}, examples, 1), PlaceKind::hallway);
  EXPECT_GT(place_examples().size(), 100U);
}

TEST(RegionParams, FaultsAreNamed) {
  EXPECT_TRUE(RegionParams{}.validate());
  EXPECT_FALSE((RegionParams{.door = 0.0}.validate()));
  EXPECT_FALSE((RegionParams{.narrower = 1.5}.validate()));
}

}  // namespace
}  // namespace docent::mapping
