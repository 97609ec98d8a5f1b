#include "docent/geometry/polygon.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

const Polygon kSquare{{0, 0}, {2, 0}, {2, 2}, {0, 2}};

TEST(Polygon, KnowsInsideFromOutside) {
  EXPECT_TRUE(contains(kSquare, {1, 1}));
  EXPECT_FALSE(contains(kSquare, {3, 1}));
  EXPECT_DOUBLE_EQ(distance(kSquare, {1, 1}), 0.0);
  EXPECT_DOUBLE_EQ(distance(kSquare, {3, 1}), 1.0);
  EXPECT_DOUBLE_EQ(outline_distance(kSquare, {1.5, 1}), 0.5);
  EXPECT_DOUBLE_EQ(signed_area(kSquare), 4.0);
}

TEST(Polygon, ABowTieIsNotSimple) {
  EXPECT_TRUE(is_simple(kSquare));
  EXPECT_FALSE(is_simple({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));
}

TEST(Ray, MeetsSegmentsAndCircles) {
  EXPECT_DOUBLE_EQ(ray_distance({0, 0}, {1, 0}, Segment{{3, -1}, {3, 1}}).value(), 3.0);
  EXPECT_FALSE(ray_distance({0, 0}, {-1, 0}, Segment{{3, -1}, {3, 1}}).has_value());
  EXPECT_FALSE(ray_distance({0, 0}, {1, 0}, Segment{{3, 1}, {3, 2}}).has_value());
  EXPECT_DOUBLE_EQ(ray_distance({0, 0}, {1, 0}, {5, 0}, 1.0).value(), 4.0);
  EXPECT_FALSE(ray_distance({0, 0}, {1, 0}, {5, 2}, 1.0).has_value());
  EXPECT_DOUBLE_EQ(ray_distance({5, 0.5}, {1, 0}, {5, 0}, 1.0).value(), 0.0);
}

}  // namespace
}  // namespace docent
