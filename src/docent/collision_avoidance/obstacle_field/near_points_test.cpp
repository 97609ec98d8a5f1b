#include "docent/collision_avoidance/obstacle_field/near_points.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/base/random.h"

namespace docent::collision_avoidance::near_points_test {
namespace {

TEST(NearPoints, IsWhatLookingAtEveryPointSays) {
  Rng rng{11};
  constexpr double kNear = 0.4;
  int yes = 0;
  int no = 0;
  for (int round = 0; round < 50; ++round) {
    const Point2 middle{rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0)};
    const auto anywhere = [&] { return middle + Point2{rng.uniform(-3.5, 3.5), rng.uniform(-3.5, 3.5)}; };
    std::vector<Point2> points;
    for (int i = 0; i < 40; ++i) points.push_back(anywhere());
    const NearPoints near{points, middle, kNear};
    for (int i = 0; i < 200; ++i) {
      const Point2 place = anywhere();
      const bool expected =
          std::any_of(points.begin(), points.end(), [&](Point2 point) { return distance(point, place) < kNear; });
      EXPECT_EQ(near.is_near(place), expected);
      ++(expected ? yes : no);
    }
  }
  EXPECT_GT(yes, 500);
  EXPECT_GT(no, 500);
}

TEST(NearPoints, FarAwayNothingIsNear) {
  const std::vector<Point2> points{{0.0, 0.0}, {100.0, 0.0}};
  const NearPoints near{points, {}, 0.4};
  EXPECT_TRUE(near.is_near({0.1, -0.1}));
  EXPECT_FALSE(near.is_near({100.0, 0.1}));
  EXPECT_FALSE(near.is_near({-1e9, 0.0}));
}

}  // namespace
}  // namespace docent::collision_avoidance::near_points_test
