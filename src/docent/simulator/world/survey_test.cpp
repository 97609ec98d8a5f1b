#include "docent/simulator/world/survey.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::simulator {
namespace {

World small_world() {
  World world;
  world.floor = {{0.0, 0.0}, {6.0, 0.0}, {6.0, 4.0}, {0.0, 4.0}};
  world.operating_area = {{0.5, 0.5}, {5.5, 0.5}, {5.5, 3.5}, {0.5, 3.5}};
  const auto box = [](double x, double y, double half) -> Polygon {
    return {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
  };
  world.solids = {{"wall", SolidKind::wall, {{0.0, 3.9}, {6.0, 3.9}, {6.0, 4.1}, {0.0, 4.1}}, 0.0, 3.0, false},
                  {"case", SolidKind::glass, box(2.0, 2.0, 0.4), 0.0, 2.0, false},
                  {"podium-in-case", SolidKind::furniture, box(2.0, 2.0, 0.3), 0.0, 0.3, false},
                  {"podium", SolidKind::furniture, box(4.0, 2.0, 0.4), 0.0, 0.3, false},
                  {"bench-1", SolidKind::furniture, box(1.0, 1.0, 0.2), 0.0, 0.5, true},
                  {"bench-2", SolidKind::furniture, box(3.0, 1.0, 0.2), 0.0, 0.5, true},
                  {"bench-3", SolidKind::furniture, box(5.0, 1.0, 0.2), 0.0, 0.5, true}};
  return world;
}

TEST(Survey, DrawsWhatLasersSeeAndListsWhatTheyDoNot) {
  const auto result = survey(small_world(), {}, Rng{4});
  const auto& frame = result.map.frame;
  EXPECT_TRUE(result.map.is_occupied(frame.cell_at({3.0, 4.0})));
  EXPECT_TRUE(result.map.is_free(frame.cell_at({2.0, 2.0}))) << "lasers look through glass";
  EXPECT_TRUE(result.map.is_free(frame.cell_at({4.0, 2.0}))) << "lasers look over the podium";
  EXPECT_EQ(result.map.at(frame.cell_at({-0.3, 2.0})), OccupancyGrid::kUnknown);
  ASSERT_EQ(result.hazards.size(), 2U) << "the podium under glass needs no entry of its own";
  EXPECT_EQ(result.hazards[0].id, "case");
  EXPECT_EQ(result.hazards[0].kind, "glass");
  EXPECT_EQ(result.hazards[1].id, "podium");
  EXPECT_EQ(result.hazards[1].kind, "other");
}

TEST(Survey, IsWrongByOneToThreeCentimetres) {
  const World world = small_world();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto result = survey(world, {}, Rng{seed});
    const double error = distance(result.hazards[0].polygon[0], world.solids[1].polygon[0]);
    EXPECT_GT(error, 0.01 - 0.008) << seed;  // corners are written in whole centimetres
    EXPECT_LT(error, 0.03 + 0.008) << seed;
  }
}

TEST(Survey, MovesOnePieceAndForgetsOne) {
  const World world = small_world();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto result = survey(world, {}, Rng{seed});
    ASSERT_EQ(result.moved.size(), 1U);
    ASSERT_EQ(result.missing.size(), 1U);
    EXPECT_NE(result.moved[0], result.missing[0]);
    const auto missing = std::find_if(world.solids.begin(), world.solids.end(),
                                      [&](const Solid& solid) { return solid.id == result.missing[0]; });
    const Point2 middle = 0.5 * (missing->polygon[0] + missing->polygon[2]);
    EXPECT_TRUE(result.map.is_free(result.map.frame.cell_at(middle)));
  }
}

TEST(Survey, IsTheSameForASeed) {
  const auto first = survey(small_world(), {}, Rng{9});
  const auto second = survey(small_world(), {}, Rng{9});
  const auto other = survey(small_world(), {}, Rng{10});
  EXPECT_EQ(first.map.cells, second.map.cells);
  EXPECT_EQ(to_yaml(first.hazards), to_yaml(second.hazards));
  EXPECT_NE(to_yaml(first.hazards), to_yaml(other.hazards));
}

}  // namespace
}  // namespace docent::simulator
