#include "docent/planning/value_iteration/value_iteration.h"

#include <gtest/gtest.h>

#include <queue>

#include "docent/base/random.h"

namespace docent {
namespace {

using Goal = ValueIteration::Goal;
constexpr float kClosed = ValueIteration::kClosed;

/// The slow, obvious twin: Dijkstra backwards from the goals.
std::vector<float> dijkstra(const GridFrame& frame, const std::vector<float>& costs, const std::vector<Goal>& goals) {
  std::vector<float> values(frame.size(), kClosed);
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<bool> is_goal(frame.size());
  for (const auto& goal : goals) {
    values[frame.index(goal.cell)] = goal.value;
    is_goal[frame.index(goal.cell)] = true;
    queue.push({goal.value, frame.index(goal.cell)});
  }
  while (!queue.empty()) {
    const auto [value, at] = queue.top();
    queue.pop();
    if (value > values[at]) continue;
    const int column = static_cast<int>(at) % frame.columns;
    const int row = static_cast<int>(at) / frame.columns;
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        const CellIndex cell{column + dc, row + dr};
        if ((dr == 0 && dc == 0) || !frame.holds(cell) || is_goal[frame.index(cell)]) continue;
        const float length = dr != 0 && dc != 0 ? std::numbers::sqrt2_v<float> : 1.0F;
        const float through = value + costs[at] * length;
        if (through < values[frame.index(cell)]) {
          values[frame.index(cell)] = through;
          queue.push({through, frame.index(cell)});
        }
      }
    }
  }
  return values;
}

std::vector<float> any_costs(Rng& rng, const GridFrame& frame) {
  std::vector<float> costs(frame.size());
  for (auto& cost : costs) cost = rng.chance(0.25) ? kClosed : static_cast<float>(rng.uniform(0.1, 2.0));
  return costs;
}

void expect_equal(const ValueIteration& planner, const std::vector<float>& wanted, std::uint64_t seed) {
  for (int row = 0; row < planner.frame().rows; ++row) {
    for (int column = 0; column < planner.frame().columns; ++column) {
      const CellIndex cell{column, row};
      const float value = wanted[planner.frame().index(cell)];
      if (value == kClosed) {
        ASSERT_EQ(planner.value(cell), kClosed) << "seed " << seed << " at " << column << "," << row;
      } else {
        ASSERT_NEAR(planner.value(cell), value, 1e-3F * (1.0F + value)) << "seed " << seed;
      }
    }
  }
}

TEST(ValueIteration, EqualsDijkstra) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Rng rng{seed};
    const GridFrame frame{static_cast<int>(rng.integer(1, 25)), static_cast<int>(rng.integer(1, 25)), 0.15, {0, 0}};
    const auto costs = any_costs(rng, frame);
    const std::vector<Goal> goals{
        {{static_cast<int>(rng.integer(0, frame.columns - 1)), static_cast<int>(rng.integer(0, frame.rows - 1))},
         0.0F}};
    ValueIteration planner{frame};
    planner.set_costs(costs);
    planner.set_goals(goals);
    ASSERT_TRUE(planner.iterate(10000));
    expect_equal(planner, dijkstra(frame, costs, goals), seed);
  }
}

TEST(ValueIteration, ASelectiveResetEndsWhereAFreshStartWould) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Rng rng{seed};
    const GridFrame frame{20, 20, 0.15, {0, 0}};
    auto costs = any_costs(rng, frame);
    const std::vector<Goal> goals{{{3, 4}, 0.0F}, {{15, 10}, 1.0F}};
    ValueIteration planner{frame};
    planner.set_costs(costs);
    planner.set_goals(goals);
    planner.iterate(static_cast<int>(rng.integer(0, 30)));  // also from a half-done state
    for (int change = 0; change < 5; ++change) {
      for (int i = 0; i < 6; ++i) {
        costs[static_cast<std::size_t>(rng.integer(0, 399))] =
            rng.chance(0.5) ? kClosed : static_cast<float>(rng.uniform(0.1, 2.0));
      }
      planner.set_costs(costs);
      ASSERT_TRUE(planner.iterate(10000));
      expect_equal(planner, dijkstra(frame, costs, goals), seed);
    }
  }
}

TEST(ValueIteration, ASmallChangeIsCheaperThanAFreshStart) {
  const GridFrame frame{200, 200, 0.15, {0, 0}};
  std::vector<float> costs(frame.size(), 0.15F);
  ValueIteration planner{frame};
  planner.set_costs(costs);
  planner.set_goals(std::vector<Goal>{{{10, 100}, 0.0F}});
  ASSERT_TRUE(planner.iterate(1000));
  const auto full = planner.relaxations();
  for (int row = 98; row < 103; ++row) costs[frame.index({150, row})] = kClosed;
  planner.set_costs(costs);
  ASSERT_TRUE(planner.iterate(1000));
  EXPECT_LT(planner.relaxations() - full, full);
}

TEST(ValueIteration, DescendsRoundAUShape) {
  const std::vector<std::string> drawing{
      "..........",  //
      ".####.....",  //
      "....#.....",  //
      ".S..#...G.",  //
      "....#.....",  //
      ".####.....",  //
      "..........",
  };
  const GridFrame frame{10, 7, 0.15, {0, 0}};
  std::vector<float> costs;
  for (const auto& line : drawing) {
    for (const char c : line) costs.push_back(c == '#' ? kClosed : 0.15F);
  }
  ValueIteration planner{frame};
  planner.set_costs(costs);
  planner.set_goals(std::vector<Goal>{{{8, 3}, 0.0F}});
  planner.iterate(1000);
  const auto way = planner.descend({1, 3});
  ASSERT_FALSE(way.empty());
  EXPECT_EQ(way.back(), (CellIndex{8, 3}));
  for (const auto& cell : way) EXPECT_LT(planner.cost(cell), kClosed);
  EXPECT_TRUE(planner.descend({4, 3}).size() > 0U) << "a robot on a closed cell still finds its way out";
}

}  // namespace
}  // namespace docent
