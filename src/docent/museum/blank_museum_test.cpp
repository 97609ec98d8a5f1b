#include "docent/museum/blank_museum.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::museum {
namespace {

TEST(BlankMuseum, KeepsWhatPeopleMarkedAndNothingOfTheMap) {
  const Museum bonn = load_museum("museums/bonn").value();
  const Pose2 start{9.0, 3.6, Angle::degrees(90.0)};
  const Museum blank = without_map(bonn, start);
  EXPECT_EQ(blank.hazards.size(), bonn.hazards.size());
  EXPECT_EQ(blank.area.size(), bonn.area.size());
  EXPECT_EQ(blank.home.x, start.x);
  EXPECT_TRUE(blank.exhibits.empty());
  EXPECT_TRUE(blank.tours.empty());
  EXPECT_TRUE(std::all_of(blank.map.cells.begin(), blank.map.cells.end(),
                          [](std::int8_t cell) { return cell == OccupancyGrid::kUnknown; }));
  EXPECT_TRUE(blank.map.frame.holds(blank.map.frame.cell_at(start.position())));
}

}  // namespace
}  // namespace docent::museum
