#include "docent/telepresence/belief_raster.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::telepresence {
namespace {

int level_at(const BeliefRaster& raster, Point2 at) {
  const int column = static_cast<int>(std::floor((at.x - raster.origin.x) / raster.cell));
  const int row = static_cast<int>(std::floor((at.y - raster.origin.y) / raster.cell));
  if (column < 0 || row < 0 || column >= raster.columns || row >= raster.rows) return 0;
  return raster.levels[static_cast<std::size_t>(row * raster.columns + column)];
}

TEST(BeliefRaster, AnEmptyBeliefShowsNothing) { EXPECT_EQ(belief_raster({}).columns, 0); }

TEST(BeliefRaster, HeadingsAddUpAndTheBoxIsTight) {
  docent_msgs::Belief belief;
  belief.cells = {{1.0F, 2.0F, 0.0F, 0.2F}, {1.0F, 2.0F, 1.0F, 0.2F}, {4.0F, 2.0F, 0.0F, 0.1F}};
  const auto raster = belief_raster(belief, 0.5);
  EXPECT_EQ(level_at(raster, {1.1, 2.1}), 255);
  EXPECT_EQ(level_at(raster, {4.1, 2.1}), 128);  // sqrt(0.1 / 0.4) = 0.5
  EXPECT_EQ(level_at(raster, {2.6, 2.1}), 0);
  EXPECT_LE(raster.columns, 10);
  EXPECT_LE(raster.rows, 4);
}

TEST(BeliefRaster, TheCoarsePartIsSpreadEvenly) {
  docent_msgs::Belief belief;
  belief.rest = {0.0F, 0.0F, 2.0F, 2, 1, {0.5F, 0.0F}};
  const auto raster = belief_raster(belief, 0.5);
  for (const Point2 inside : {Point2{0.1, 0.1}, Point2{1.9, 0.1}, Point2{0.1, 1.9}, Point2{1.9, 1.9}}) {
    EXPECT_EQ(level_at(raster, inside), 255);
  }
  EXPECT_EQ(level_at(raster, {2.6, 1.0}), 0);
}

TEST(BeliefRaster, IsBoundedAndSurvivesNonsense) {
  docent_msgs::Belief belief;
  belief.cells = {{0, 0, 0, 0.5F}, {500, 500, 0, 0.5F}};
  const auto raster = belief_raster(belief, 0.3, 1000);
  EXPECT_LE(raster.columns * raster.rows, 1000);
  EXPECT_EQ(level_at(raster, {0.1, 0.1}), 255);
  EXPECT_EQ(level_at(raster, {500.1, 500.1}), 255);
  belief.cells = {{NAN, 0, 0, 0.5F}, {1, 1, 0, NAN}, {2, 2, 0, -1.0F}};
  EXPECT_EQ(belief_raster(belief).columns, 0);
  belief.cells = {{1e9F, 0, 0, 0.5F}, {-1e9F, 0, 0, 0.5F}};
  EXPECT_EQ(belief_raster(belief).columns, 0);
  belief.cells.clear();
  belief.rest = {0.0F, 0.0F, 2.0F, 9, 9, {0.5F}};  // sizes do not fit
  EXPECT_EQ(belief_raster(belief).columns, 0);
}

}  // namespace
}  // namespace docent::telepresence
