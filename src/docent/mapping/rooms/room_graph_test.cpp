#include "docent/mapping/rooms/room_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace docent::mapping {
namespace {

/// A hallway along the bottom, three rooms above it, and one that no door leads to. Home is in the hallway.
museum::Museum office() {
  museum::Museum museum;
  OccupancyGrid& map = museum.map;
  map.frame = {400, 200, 0.05, {-1.0, -1.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  const auto fill = [&](Point2 low, Point2 high, std::int8_t value) {
    for (int row = 0; row < map.frame.rows; ++row) {
      for (int column = 0; column < map.frame.columns; ++column) {
        const Point2 at = map.frame.centre({column, row});
        if (at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y)
          map.cells[map.frame.index({column, row})] = value;
      }
    }
  };
  const auto room = [&](Point2 low, Point2 high) {
    fill({low.x - 0.1, low.y - 0.1}, {high.x + 0.1, high.y + 0.1}, OccupancyGrid::kOccupied);
    fill(low, high, OccupancyGrid::kFree);
  };
  room({0.0, 0.0}, {14.0, 2.0});
  for (const double x : {0.0, 4.8, 9.6}) {
    room({x, 2.2}, {x + 4.4, 6.6});
    fill({x + 1.0, 1.9}, {x + 2.0, 2.3}, OccupancyGrid::kFree);
  }
  room({14.4, 2.2}, {18.0, 6.6});
  museum.area = {{-0.5, -0.5}, {18.5, -0.5}, {18.5, 7.0}, {-0.5, 7.0}};
  museum.languages = {"en", "de"};
  museum.home = {1.0, 1.0, {}};
  museum.rooms = {{"library", {{"en", "The library"}, {"de", "Die Bibliothek"}}, {7.0, 4.0}}};
  return museum;
}

TEST(RoomGraph, RoomsInTheOrderOfAWalk) {
  const RoomGraph graph = room_graph(office());
  ASSERT_EQ(graph.rooms().size(), 4U) << "nobody gets to the fifth";
  ASSERT_EQ(graph.doors().size(), 3U);
  EXPECT_EQ(graph.rooms()[0].id, "hallway-1") << "home";
  EXPECT_EQ(graph.rooms()[0].next, (std::vector<int>{1, 2, 3}));
  const Room* library = graph.find("library");
  ASSERT_NE(library, nullptr);
  EXPECT_EQ(library->name.at("de"), "Die Bibliothek");
  EXPECT_EQ(library->number, 0);
  EXPECT_EQ(graph.room_at({5.2, 6.0}), library - graph.rooms().data());
  EXPECT_EQ(graph.rooms()[0].number, 1);
  EXPECT_NE(graph.find("room-2"), nullptr);
  EXPECT_EQ(graph.room_at({16.0, 4.0}), RoomGraph::kNone);
  EXPECT_EQ(graph.room_at({100.0, 4.0}), RoomGraph::kNone);
  for (const Door& door : graph.doors()) {
    EXPECT_EQ(door.first == 0 || door.second == 0, true) << "into the hallway";
    EXPECT_NEAR(door.width, 1.0, 0.15);
  }
}

TEST(RoomGraph, TheWalkGoesIntoTheNearestRoomBeside) {
  const RoomGraph graph = room_graph(office());
  std::vector<double> x;
  for (const Room& room : graph.rooms()) x.push_back(room.at.x);
  EXPECT_TRUE(std::is_sorted(x.begin() + 1, x.end(), [&](double a, double b) {
    return std::abs(a - x.front()) < std::abs(b - x.front());
  })) << "all lie along the hallway";
}

TEST(RoomGraph, NamesDivideALargeRoom) {
  museum::Museum museum = office();
  museum.rooms.push_back({"west", {{"en", "West"}}, {2.0, 1.0}});
  museum.rooms.push_back({"east", {{"en", "East"}}, {12.0, 1.0}});
  const RoomGraph graph = room_graph(museum);
  ASSERT_EQ(graph.rooms().size(), 5U);
  const Room& west = *graph.find("west");
  const Room& east = *graph.find("east");
  const auto number = [&](const Room& room) { return static_cast<int>(&room - graph.rooms().data()); };
  EXPECT_EQ(number(west), 0) << "home is there";
  EXPECT_EQ(graph.room_at({6.5, 1.0}), number(west));
  EXPECT_EQ(graph.room_at({7.5, 1.0}), number(east));
  EXPECT_NE(std::find(west.next.begin(), west.next.end(), number(east)), west.next.end());
  EXPECT_EQ(graph.doors().size(), 3U) << "between its parts there is none";
  const int right = graph.room_at({11.0, 5.0});
  EXPECT_EQ(graph.rooms()[static_cast<std::size_t>(right)].next, std::vector<int>{number(east)});
}

TEST(RoomGraph, NothingBehindAHazardOrOutsideTheArea) {
  museum::Museum museum = office();
  museum.hazards.push_back({"step", museum::HazardKind::stairs, {{4.7, 1.8}, {9.4, 1.8}, {9.4, 2.4}, {4.7, 2.4}}});
  EXPECT_EQ(room_graph(museum).rooms().size(), 3U);
  EXPECT_EQ(room_graph(museum).find("library"), nullptr);
  museum.hazards.clear();
  museum.area = {{-0.5, -0.5}, {9.3, -0.5}, {9.3, 7.0}, {-0.5, 7.0}};
  EXPECT_EQ(room_graph(museum).rooms().size(), 3U);
}

TEST(RoomGraph, NoRoomAtAll) {
  museum::Museum museum = office();
  museum.home = {100.0, 100.0, {}};
  const RoomGraph graph = room_graph(museum);
  EXPECT_TRUE(graph.rooms().empty());
}

}  // namespace
}  // namespace docent::mapping
