#include "docent/collision_avoidance/avoider/carrot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace docent::collision_avoidance::carrot_test {
namespace {

constexpr double kRadius = 0.25;

TEST(Carrot, LiesOnThePathAtTheEndOfTheLookahead) {
  const std::vector<Point2> path{{-1.0, 0.0}, {1.0, 0.0}, {1.0, 4.0}};
  const Carrot carrot = carrot_on(path, 0.9, {}, kRadius);
  EXPECT_NEAR(carrot.in_base.x, 0.9, 1e-9);
  EXPECT_NEAR(carrot.in_base.y, 0.0, 1e-9);
  EXPECT_NEAR(carrot.remaining, 5.0, 1e-9) << "from the place beside the robot, not from the path's begin";
}

TEST(Carrot, DoesNotCutACornerThatIsInTheWay) {
  const std::vector<Point2> path{{0.0, 0.0}, {1.2, 0.0}, {1.2, 1.2}};
  const std::vector<Obstacle> corner{{.at = {0.8, 0.45}, .margin = 0.05}};
  EXPECT_GT(carrot_on(path, 1.5, {}, kRadius).in_base.y, 0.8);
  EXPECT_LT(carrot_on(path, 1.5, corner, kRadius).in_base.y, 0.3);
}

TEST(Carrot, LeadsOutOfANicheRoundItsCorner) {
  const std::vector<Point2> path{{0.0, 0.0}, {0.4, 0.0}, {0.4, 1.5}};
  const std::vector<Obstacle> corner{{.at = {0.1, 0.3}, .margin = 0.05}, {.at = {0.0, 0.3}, .margin = 0.05}};
  const Point2 at = carrot_on(path, 1.2, corner, kRadius).in_base;
  EXPECT_GT(at.x, 0.3) << "no more of the path can be reached straight, but nobody stands on it";
  EXPECT_LT(at.y, 0.2);
}

TEST(Carrot, WhereThePathIsBlockedAtOnceItIsTheEndOfTheLookahead) {
  const std::vector<Point2> path{{0.0, 0.0}, {3.0, 0.0}};
  const std::vector<Obstacle> somebody{{.at = {0.6, 0.0}, .margin = 0.08}};
  EXPECT_NEAR(carrot_on(path, 1.2, somebody, kRadius).in_base.x, 1.2, CarrotParams{}.step + 1e-9);
}

/// A wall along x at y = 0.5 with a door whose middle is at x = 0.5; the path comes along the wall and turns into it.
std::vector<Obstacle> wall_with_door(double half) {
  std::vector<Obstacle> wall;
  for (double x = -1.0; x <= 2.0; x += 0.01) {
    if (std::abs(x - 0.5) < half) continue;
    for (const double y : {0.5, 0.6, 0.7}) wall.push_back({.at = {x, y}, .margin = 0.08});
  }
  return wall;
}

TEST(Carrot, InADoorThatIsHardlyWideEnoughItIsNotBehindTheFrame) {
  const std::vector<Point2> path{{0.0, 0.0}, {0.3, 0.05}, {0.5, 0.3}, {0.5, 1.0}, {-1.0, 1.2}};
  for (const double spare : {0.02, 0.0, -0.02}) {  // beyond the margins; noise takes as much
    const Point2 at = carrot_on(path, 1.5, wall_with_door(kRadius + 0.08 + spare), kRadius).in_base;
    EXPECT_GT(at.x, 0.25) << spare;
    EXPECT_LT(at.y, 0.8) << spare << ": it steers for a place that it sees";
    EXPECT_GT(norm(at), CarrotParams{}.here) << spare;
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::carrot_test
