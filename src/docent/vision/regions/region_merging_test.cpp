#include "docent/vision/regions/region_merging.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "docent/base/random.h"

namespace docent::vision {
namespace {

namespace region_merging_test {

/// A grey floor, a red box on it, a dark thing, a speck; noise of some grey levels.
pictures::Image scene(double noise, std::uint64_t seed) {
  pictures::Image picture{160, 120, {200, 200, 200, 255}};
  Rng rng{seed};
  const auto fill = [&](int left, int top, int width, int height, pictures::Color color) {
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x) picture.set(x, y, color);
  };
  fill(20, 20, 40, 60, {190, 60, 50, 255});
  fill(100, 40, 28, 28, {60, 60, 65, 255});
  fill(72, 8, 4, 4, {0, 0, 0, 255});
  for (std::uint8_t& byte : picture.writable_bytes())
    byte = static_cast<std::uint8_t>(std::clamp(static_cast<double>(byte) + noise * rng.normal(), 0.0, 255.0));
  return picture;
}

TEST(RegionMerging, FindsFloorBoxAndThingAndTakesNoNoticeOfASpeck) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Segmentation found = merge_regions(sites_of(scene(12.0, seed), 4));
    ASSERT_EQ(found.regions.size(), 3U) << "seed " << seed;
    EXPECT_EQ(found.regions[1].sites, 10U * 15U);
    EXPECT_GT(found.regions[1].mean.red_green, 100.0F);
    EXPECT_EQ(found.regions[1].first_column, 5);
    EXPECT_EQ(found.regions[1].last_row, 19);
    EXPECT_LT(found.regions[2].mean.luminance, 90.0F);
    EXPECT_EQ(found.regions[0].at_border, 2U * (40U + 30U) - 4U);
    EXPECT_EQ(found.of[0], 0);
  }
}

TEST(RegionMerging, DividesMoreTheLessARegionCosts) {
  const Sites sites = sites_of(scene(12.0, 3), 2);
  std::size_t before = 0;
  for (const double cost : {1e8, 40000.0, 500.0, 60.0}) {
    RegionMergingParams params;
    params.a_region = cost;
    const std::size_t count = merge_regions(sites, params).regions.size();
    EXPECT_GE(count, before);
    before = count;
  }
  EXPECT_GT(before, 100U) << "noise";
  RegionMergingParams one;
  one.a_region = 1e8;
  EXPECT_EQ(merge_regions(sites, one).regions.size(), 1U);
}

TEST(RegionMerging, EveryRegionIsOfOnePiece) {
  RegionMergingParams params;
  params.a_region = 800.0;
  const Sites sites = sites_of(scene(30.0, 8), 3);
  const Segmentation found = merge_regions(sites, params);
  std::vector<bool> seen(found.of.size());
  std::set<int> begun;
  for (std::size_t start = 0; start < found.of.size(); ++start) {
    if (seen[start]) continue;
    EXPECT_TRUE(begun.insert(found.of[start]).second) << "region " << found.of[start] << " has two pieces";
    std::vector<std::size_t> open{start};
    seen[start] = true;
    std::size_t size = 0;
    while (!open.empty()) {
      const std::size_t here = open.back();
      open.pop_back();
      ++size;
      const int column = static_cast<int>(here) % found.columns, row = static_cast<int>(here) / found.columns;
      const auto visit = [&](int c, int r) {
        if (c < 0 || r < 0 || c >= found.columns || r >= found.rows) return;
        const std::size_t next = sites.index(c, r);
        if (seen[next] || found.of[next] != found.of[here]) return;
        seen[next] = true;
        open.push_back(next);
      };
      visit(column - 1, row);
      visit(column + 1, row);
      visit(column, row - 1);
      visit(column, row + 1);
    }
    EXPECT_EQ(size, found.regions[static_cast<std::size_t>(found.of[start])].sites);
  }
  EXPECT_EQ(begun.size(), found.regions.size());
}

TEST(RegionMerging, TheSamePictureGivesTheSameRegions) {
  const Sites sites = sites_of(scene(20.0, 4), 2);
  EXPECT_EQ(merge_regions(sites).of, merge_regions(sites).of);
}

TEST(RegionMerging, RefusesWhatMeansNothing) {
  RegionMergingParams params;
  params.a_region = 0.0;
  EXPECT_FALSE(params.validate());
  params = {};
  params.luminance = params.colour = 0.0;
  EXPECT_FALSE(params.validate());
  EXPECT_TRUE(RegionMergingParams{}.validate());
}

}  // namespace region_merging_test
}  // namespace
}  // namespace docent::vision
