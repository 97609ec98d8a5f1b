#include "docent/collision_avoidance/obstacle_field/straight_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/base/random.h"
#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance::straight_pieces_test {
namespace {

constexpr double kBeam = std::numbers::pi / 180.0;

struct Seen {
  std::vector<Point2> points;
  std::vector<double> ranges;
};

Seen look_at(const std::vector<Segment>& walls, const std::vector<Point2>& people) {
  Rng rng{5};
  Seen seen;
  for (int i = 0; i < 181; ++i) {
    const Point2 way = unit(Angle::radians(-0.5 * std::numbers::pi + i * kBeam));
    double range = 10.0;
    for (const auto& wall : walls)
      if (const auto hit = ray_distance({}, way, wall)) range = std::min(range, *hit);
    for (const auto person : people)
      if (const auto hit = ray_distance({}, way, person, 0.22)) range = std::min(range, *hit);
    if (range >= 10.0) continue;
    range += rng.normal(0.0, 0.015);
    seen.points.push_back(range * way);
    seen.ranges.push_back(range);
  }
  return seen;
}

TEST(StraightPieces, TheWallsOfACornerAreStraight) {
  const Seen seen = look_at({{{2.0, -2.0}, {2.0, 1.0}}, {{2.0, 1.0}, {0.0, 1.0}}}, {});
  const auto straight = on_straight_pieces(seen.points, seen.ranges, kBeam);
  EXPECT_GT(std::count(straight.begin(), straight.end(), true), static_cast<long>(seen.points.size()) - 6);
}

TEST(StraightPieces, PeopleSideBySideAreNot) {
  const Seen seen = look_at({{{3.0, -4.0}, {3.0, 4.0}}}, {{1.3, -0.5}, {1.2, -0.05}, {1.3, 0.4}, {1.7, 0.8}});
  const auto straight = on_straight_pieces(seen.points, seen.ranges, kBeam);
  int people = 0;
  int wall = 0;
  for (std::size_t i = 0; i < straight.size(); ++i) {
    const bool is_wall = seen.points[i].x > 2.8;
    EXPECT_TRUE(is_wall || !straight[i]) << seen.points[i].x << ", " << seen.points[i].y;
    people += is_wall ? 0 : 1;
    wall += is_wall && straight[i] ? 1 : 0;
  }
  EXPECT_GT(people, 40);
  EXPECT_GT(wall, 40);
}

}  // namespace
}  // namespace docent::collision_avoidance::straight_pieces_test
