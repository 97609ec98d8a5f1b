#include "docent/mapping/scan_matching/correlative_matcher.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent::mapping {
namespace {

/// An L of walls and a pillar: fits one way only.
std::vector<Point2> corner_of_a_room() {
  std::vector<Point2> points;
  for (int i = 0; i < 60; ++i) points.push_back({0.05 * i, 0.0});
  for (int i = 0; i < 30; ++i) points.push_back({0.0, 0.05 * i});
  for (int i = 0; i < 8; ++i) points.push_back({1.5 + 0.02 * i, 1.0});
  return points;
}

std::vector<Point2> seen_from(const Pose2& pose, const std::vector<Point2>& points) {
  std::vector<Point2> seen;
  for (const Point2 p : points) seen.push_back(inverse(pose) * p);
  return seen;
}

TEST(BestMatch, FindsThePoseWithinACell) {
  const MatchGrid grid{corner_of_a_room(), {0.05, 0.07, 5}};
  const Pose2 truth{1.0, 0.6, Angle::degrees(25)};
  const auto match = best_match(grid, seen_from(truth, corner_of_a_room()), {1.5, 0.2, Angle::degrees(5)},
                                {.reach = 1.0, .turn = 0.6}, 0.5);
  ASSERT_TRUE(match);
  EXPECT_LT(distance(match->reference_from_sweep.position(), truth.position()), 0.05);
  EXPECT_LT(std::abs((match->reference_from_sweep.theta - truth.theta).degrees()), 2.0);
  EXPECT_GT(match->score, 0.85);
}

/// Against all poses of the window, one after the other.
TEST(BestMatch, IsThatOfAnExhaustiveSearch) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng{seed};
    std::vector<Point2> points;
    std::vector<Point2> query;
    for (int i = 0; i < 50; ++i) points.push_back({rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)});
    for (int i = 0; i < 25; ++i) query.push_back({rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)});
    const MatchGrid grid{points, {0.05, 0.10, 4}};
    const MatchWindow window{
        .reach = 0.4, .turn = 0.1, .position_sigma = 0.3, .heading_sigma = 0.1, .expectation_weight = 0.05};
    const Pose2 expected{rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), Angle::radians(rng.uniform(-1.0, 1.0))};
    const auto match = best_match(grid, query, expected, window, 0.0);
    ASSERT_TRUE(match) << "seed " << seed;

    double farthest = 1.0;
    for (const Point2 p : query) farthest = std::max(farthest, norm(p));
    const double step = 0.05 / farthest;
    const int steps = static_cast<int>(std::ceil(window.turn / step));
    double best = 0.0;
    for (int turn = -steps; turn <= steps; ++turn) {
      const Pose2 turned{expected.x, expected.y, expected.theta + Angle::radians(turn * step)};
      for (int row = -8; row <= 8; ++row) {
        for (int column = -8; column <= 8; ++column) {
          int sum = 0;
          for (const Point2 p : query) {
            const CellIndex cell = grid.frame().cell_at(turned * p);
            sum += grid.bound(0, {cell.column + column, cell.row + row});
          }
          const double x = column * 0.05 / 0.3;
          const double y = row * 0.05 / 0.3;
          const double t = turn * step / 0.1;
          best = std::max(best, sum / (255.0 * 25.0) - 0.05 * 0.5 * (x * x + y * y + t * t));
        }
      }
    }
    EXPECT_NEAR(match->score, best, 1e-9) << "seed " << seed;
  }
}

TEST(BestMatch, SaysNothingWhereNothingFitsWellEnough) {
  const MatchGrid grid{corner_of_a_room(), {0.05, 0.07, 5}};
  const std::vector<Point2> elsewhere{{0.0, 0.0}, {0.7, 0.7}, {1.4, 0.2}, {0.3, 1.9}};
  EXPECT_FALSE(best_match(grid, elsewhere, {5.0, 5.0, {}}, {.reach = 1.0, .turn = 0.3}, 0.4));
}

TEST(BestMatch, PassesOverForbiddenPlaces) {
  std::vector<Point2> two_pillars{{0.0, 0.0}, {3.0, 0.0}};
  const MatchGrid grid{two_pillars, {0.05, 0.07, 5}};
  const std::vector<Point2> pillar{{0.0, 0.0}};
  const auto first = best_match(grid, pillar, {0.2, 0.0, {}}, {.reach = 4.0, .turn = 0.0}, 0.5);
  ASSERT_TRUE(first);
  const ForbiddenPlace near_first{first->reference_from_sweep, 1.0, 1.0};
  const auto second = best_match(grid, pillar, {0.2, 0.0, {}}, {.reach = 4.0, .turn = 0.0}, 0.5, &near_first);
  ASSERT_TRUE(second);
  EXPECT_NEAR(distance(first->reference_from_sweep.position(), second->reference_from_sweep.position()), 3.0, 0.15);
}

}  // namespace
}  // namespace docent::mapping
