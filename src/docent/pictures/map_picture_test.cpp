#include "docent/pictures/map_picture.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

OccupancyGrid room() {
  OccupancyGrid map;
  map.frame = {40, 20, 0.1, {-1.0, 2.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 20; ++row) map.cells[map.frame.index({30, row})] = OccupancyGrid::kOccupied;
  map.cells[map.frame.index({0, 19})] = OccupancyGrid::kUnknown;
  return map;
}

TEST(MapView, PixelAndMapUndoEachOther) {
  const MapView view = MapView::whole(room().frame, 400);
  EXPECT_EQ(view.width(), 400);
  EXPECT_EQ(view.height(), 200);
  EXPECT_EQ(view.pixel({-1.0, 4.0}), (Point2{0, 0}));
  const Point2 back = view.map(view.pixel({0.37, 2.91}));
  EXPECT_NEAR(back.x, 0.37, 1e-12);
  EXPECT_NEAR(back.y, 2.91, 1e-12);
}

TEST(DrawMap, ShowsCellsWhereTheyAre) {
  const Image image = draw_map(room(), 400);  // 10 pixels a cell
  EXPECT_EQ(image.at(5, 5), colors::kUnknown);
  EXPECT_EQ(image.at(305, 100), colors::kInk);
  EXPECT_EQ(image.at(299, 100), colors::kFloor);
  EXPECT_EQ(image.at(200, 100), colors::kFloor);
}

TEST(DrawMap, AThinWallSurvivesAReducedPicture) {
  const Image image = draw_map(room(), 13);  // three cells a pixel
  int dark = 0;
  for (int x = 0; x < image.width(); ++x) dark += image.at(x, 3) == colors::kInk ? 1 : 0;
  EXPECT_GE(dark, 1);
  EXPECT_LE(dark, 2);
}

TEST(DrawDensity, ASingleSmallCellIsSeen) {
  OccupancyGrid map = room();
  const MapView view = MapView::whole(map.frame, 13);
  Image image = draw_map(map, view);
  std::vector<float> mass(map.frame.size(), 0.0F);
  mass[map.frame.index({10, 10})] = 1.0F;
  mass[map.frame.index({20, 10})] = 1e-5F;  // under a thousandth: clear
  const Image before = image;
  draw_density(image, view, map.frame, mass);
  int changed = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) changed += image.at(x, y) == before.at(x, y) ? 0 : 1;
  EXPECT_EQ(changed, 1);
}

TEST(DrawRobot, PointsTowardsItsHeading) {
  const MapView view{{0, 0}, {4, 4}, 50.0};
  Image image{view.width(), view.height()};
  draw_robot(image, view, {2.0, 2.0, Angle::degrees(90)}, 0.5, colors::kBlue);
  EXPECT_EQ(image.at(100, 90), colors::kWhite);  // up in the map is up in the picture
  EXPECT_NE(image.at(100, 110), colors::kWhite);
}

}  // namespace
}  // namespace docent
