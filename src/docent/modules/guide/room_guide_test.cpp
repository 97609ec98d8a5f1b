#include "docent/modules/guide/room_guide.h"

#include <gtest/gtest.h>

namespace docent::modules {
namespace {

/// Two rooms beside each other with a door between them; the left one has a name.
museum::Museum two_rooms() {
  museum::Museum museum;
  OccupancyGrid& map = museum.map;
  map.frame = {200, 100, 0.05, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kOccupied);
  for (int row = 4; row < 96; ++row) {
    for (int column = 4; column < 196; ++column) {
      const bool is_wall = column > 96 && column < 102 && (row < 40 || row > 60);
      if (!is_wall) map.cells[map.frame.index({column, row})] = OccupancyGrid::kFree;
    }
  }
  museum.area = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 5.0}, {0.0, 5.0}};
  museum.languages = {"en", "de"};
  museum.home = {1.0, 1.0, {}};
  museum.rooms = {{"clocks", {{"en", "Clocks"}, {"de", "Uhren"}}, {2.0, 2.5}}};
  return museum;
}

TEST(RoomGuide, KnowsTheNextRoomAndWhatItIsCalled) {
  const museum::Museum museum = two_rooms();
  RoomGuide guide{museum};
  const task_control::Rooms& rooms = guide.rooms();
  ASSERT_EQ(rooms.rooms.size(), 2U);
  EXPECT_EQ(rooms.rooms[0].id, "clocks");
  EXPECT_EQ(rooms.after({1.0, 1.0})->id, rooms.rooms[1].id);
  EXPECT_EQ(rooms.after({8.0, 1.0})->id, "clocks");
  EXPECT_EQ(guide.name("clocks"), (museum::Translations{{"en", "Clocks"}, {"de", "Uhren"}}));
  EXPECT_EQ(guide.name(rooms.rooms[1].id), (museum::Translations{{"en", "room 1"}, {"de", "Raum 1"}}));
  EXPECT_TRUE(guide.name("attic").empty());
}

}  // namespace
}  // namespace docent::modules
