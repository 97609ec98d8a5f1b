#include "docent/pictures/map_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace docent::pictures {
namespace {

OccupancyGrid room() {
  OccupancyGrid map;
  map.frame = {40, 20, 0.1, {-1.0, 2.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 20; ++row) map.cells[map.frame.index({30, row})] = OccupancyGrid::kOccupied;
  map.cells[map.frame.index({0, 19})] = OccupancyGrid::kUnknown;
  return map;
}

TEST(DrawMap, ShowsCellsWhereTheyAre) {
  Axes axes = Axes::metres(room().frame, 200.0);  // 10 pixels a cell
  draw_map(axes, room());
  const Image image = raster_inside(axes);
  EXPECT_EQ(image.width(), 400);
  EXPECT_EQ(image.height(), 200);
  EXPECT_EQ(image.at(5, 5), colors::kUnknown);
  EXPECT_EQ(image.at(305, 100), colors::kInk);
  EXPECT_EQ(image.at(300, 100), colors::kInk);
  EXPECT_EQ(image.at(309, 100), colors::kInk);
  EXPECT_EQ(image.at(299, 100), colors::kFloor);
  EXPECT_EQ(image.at(310, 100), colors::kFloor);
  EXPECT_EQ(image.at(200, 100), colors::kFloor);
}

TEST(DrawMap, AThinWallSurvivesAReducedPicture) {
  Axes axes = Axes::metres(room().frame, 6.5);  // three cells a pixel
  draw_map(axes, room());
  const Image image = raster_inside(axes);
  int dark = 0;
  for (int x = 0; x < image.width(); ++x) dark += image.at(x, 3) == colors::kInk ? 1 : 0;
  EXPECT_GE(dark, 1);
  EXPECT_LE(dark, 2);
}

TEST(DrawMap, APartOfItIsCutOutWhereItIs) {
  Axes axes = Axes::metres({1.5, 2.0}, {3.5, 4.0}, 100.0);  // 10 pixels a cell; the map ends at x = 3
  draw_map(axes, room());
  const Image image = raster_inside(axes);
  EXPECT_EQ(image.at(55, 100), colors::kInk);
  EXPECT_EQ(image.at(45, 100), colors::kFloor);
  EXPECT_EQ(image.at(145, 100), colors::kFloor);
  EXPECT_EQ(image.at(155, 100), colors::kUnknown);
}

TEST(DrawDensity, ASingleSmallCellIsSeen) {
  const OccupancyGrid map = room();
  Axes axes = Axes::metres(map.frame, 6.5);
  draw_map(axes, map);
  const Image before = raster_inside(axes);
  std::vector<float> mass(map.frame.size(), 0.0F);
  mass[map.frame.index({10, 10})] = 1.0F;
  mass[map.frame.index({20, 10})] = 1e-8F;  // less than the scale shows: clear
  draw_density(axes, map.frame, mass);
  const Image image = raster_inside(axes);
  int changed = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) changed += image.at(x, y) == before.at(x, y) ? 0 : 1;
  EXPECT_EQ(changed, 1);
}

TEST(DrawDensity, AColourMeansTheSameInAllPictures) {
  const OccupancyGrid map = room();
  const ColorBar bar = density_bar();
  for (const double share : {1.0, 0.5, 1e-3}) {
    Axes axes = Axes::metres(map.frame, 300.0);
    const double density = share / 8.0;  // uniform over 8 m2, and what is left of it
    std::vector<float> mass(map.frame.size(), static_cast<float>(share / static_cast<double>(map.frame.size())));
    draw_density(axes, map.frame, mass);
    Image floor{1, 1};
    floor.blend(0, 0, bar.color(density));
    EXPECT_EQ(raster_inside(axes).at(300, 150), floor.at(0, 0)) << share;
    axes.set_color_bar(bar);
    EXPECT_EQ(axes.description(), "x [m], y [m], probability density [1/m²]");
  }
}

TEST(DrawCells, NothingIsDrawnWhereNoValueIs) {
  const GridFrame frame{2, 1, 1.0, {0.0, 0.0}};
  Axes axes = Axes::metres(frame, 10.0);
  const std::vector<float> values{std::numeric_limits<float>::quiet_NaN(), 0.5F};
  draw_cells(axes, frame, values, [](float) { return colors::kRed; });
  const Image image = raster_inside(axes);
  EXPECT_EQ(image.at(2, 2), colors::kWhite);
  EXPECT_EQ(image.at(15, 2), colors::kRed);
}

TEST(DrawRobot, PointsTowardsItsHeading) {
  Axes axes = Axes::metres({0, 0}, {4, 4}, 100.0);  // 50 pixels a metre
  draw_robot(axes, {2.0, 2.0, Angle::degrees(90)}, 0.5, colors::kBlue);
  const Image image = raster_inside(axes);
  EXPECT_EQ(image.at(100, 90), colors::kWhite);  // up in the map is up in the picture
  EXPECT_NE(image.at(100, 110), colors::kWhite);
}

TEST(DrawTimedPath, IsColouredFromItsBeginningToItsEnd) {
  Axes axes = Axes::metres({0, 0}, {10, 2}, 200.0);  // 40 pixels a metre
  std::vector<TimedPoint> way;
  for (int i = 0; i <= 100; ++i) way.push_back({30.0 + i, {0.1 * i, 1.0}});
  draw_timed_path(axes, way, 2.0);
  const Image image = raster_inside(axes);
  EXPECT_EQ(image.at(1, 40), rainbow(0.0));
  EXPECT_EQ(image.at(201, 40), rainbow(0.5));
  EXPECT_NE(axes.description().find("time [s]"), std::string::npos);
}

}  // namespace
}  // namespace docent::pictures
