#include "docent/geometry/convex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace docent {
namespace {

const Polygon kUnitSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Convex, KnownByHand) {
  EXPECT_TRUE(is_convex(kUnitSquare));
  EXPECT_TRUE(is_convex({{0, 1}, {1, 1}, {1, 0}, {0, 0}})) << "clockwise";
  EXPECT_FALSE(is_convex({{0, 0}, {1, 0}}));
  EXPECT_FALSE(is_convex({{0, 0}, {1, 0}, {2, 0}, {1, 1}})) << "a corner on a straight line";
  EXPECT_FALSE(is_convex({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}}));
  EXPECT_FALSE(is_convex({{0, 0}, {1, 0}, {1, 1}, {std::numeric_limits<double>::quiet_NaN(), 1}}));
}

TEST(Convex, AStarIsNot) {
  Polygon star;
  for (int i = 0; i < 5; ++i) star.push_back(unit(Angle::radians(i * 0.8 * std::numbers::pi)));
  EXPECT_FALSE(is_convex(star));
}

TEST(Convex, HoldsWhatLiesInsideButNotOnASide) {
  EXPECT_TRUE(holds_inside(kUnitSquare, {0.5, 0.1}));
  EXPECT_FALSE(holds_inside(kUnitSquare, {0.5, 0.0}));
  EXPECT_FALSE(holds_inside(kUnitSquare, {0.5, -0.1}));
}

}  // namespace
}  // namespace docent
