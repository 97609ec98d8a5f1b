#include "docent/grid/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace docent {
namespace {

const Polygon kArea{{0, 0}, {10, 0}, {10, 5}, {0, 5}};

TEST(Ground, TheBorderBindsTheCentreAndAHazardTheBody) {
  const Clearance clearance{.walls = 0.1, .hazards = 0.3, .border = 0.2};
  const std::vector<Polygon> plate{{{6, 2}, {7, 2}, {7, 3}, {6, 3}}};
  EXPECT_NEAR(room_on_ground(kArea, {}, {1.0, 2.0}, 0.25, clearance), 0.8, 1e-9);
  EXPECT_NEAR(room_on_ground(kArea, {}, {0.1, 2.0}, 0.25, clearance), -0.1, 1e-9);
  EXPECT_NEAR(room_on_ground(kArea, plate, {5.0, 2.5}, 0.25, clearance), 0.45, 1e-9);
  EXPECT_LT(room_on_ground(kArea, plate, {6.5, 2.5}, 0.25, clearance), 0.0);
  EXPECT_TRUE(std::isinf(room_on_ground(kArea, {}, {-0.1, 2.0}, 0.25, clearance)));
  EXPECT_NEAR(room_on_ground({}, plate, {20.0, 2.5}, 0.25, clearance), 12.45, 1e-9);
}

}  // namespace
}  // namespace docent
