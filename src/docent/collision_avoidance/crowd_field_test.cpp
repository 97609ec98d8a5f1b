#include "docent/collision_avoidance/crowd_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent {
namespace {

constexpr double kRadius = 0.265;
const std::vector<Point2> kPath{{0.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}};

Obstacle standing(double x, double y) { return {{x, y}, {}, 0.08, true, false}; }

TEST(CrowdField, TimeToGoIsTheWayInTheOpen) {
  CrowdField field{{}, kRadius};
  field.build({0.0, 0.0}, {}, {kPath, false});
  EXPECT_NEAR(field.value(field.layers(), {0.0, 0.0}), 3.0 / CrowdField::kSpeed, 0.2);
  EXPECT_NEAR(field.value(field.layers(), {3.0, 0.0}), 0.0, 0.2);
  EXPECT_NEAR(field.value(field.layers(), {3.0, 1.5}), 1.5 / CrowdField::kSpeed, 0.2);
  EXPECT_DOUBLE_EQ(field.cost(0, {1.0, 1.0}), 0.0);
}

TEST(CrowdField, WhoIsAtTheEndHasArrivedAtAnyTime) {
  CrowdField field{{}, kRadius};
  field.build({0.0, 0.0}, {}, {kPath, false});
  for (int layer = 0; layer <= field.layers(); ++layer) EXPECT_NEAR(field.value(layer, {3.0, 0.0}), 0.0, 1e-6);
}

TEST(CrowdField, APathThatLeavesTheFieldEndsAtItsRim) {
  CrowdField field{{}, kRadius};
  const std::vector<Point2> path{{0.0, 0.0}, {1.0, 0.0}, {9.0, 0.0}};
  field.build({0.0, 0.0}, {}, {path, false});
  EXPECT_GT(field.value(0, {2.0, 0.0}), field.value(0, {3.0, 0.0})) << "it goes on beyond the last point inside";
}

TEST(CrowdField, AStraightPathThatGoesOnIsMadeForOnABroadFront) {
  CrowdField field{{}, kRadius};
  // People round the path's last point: who goes on need not join them.
  std::vector<Obstacle> people;
  for (int i = 0; i < 12; ++i) people.push_back(standing(3.0 + 0.9 * std::cos(0.52 * i), 0.9 * std::sin(0.52 * i)));
  field.build({0.0, 0.0}, people, {kPath, true});
  EXPECT_LT(field.value(field.layers(), {2.8, 1.9}), field.value(field.layers(), {2.0, 0.0}));
  field.build({0.0, 0.0}, people, {kPath, false});
  EXPECT_GT(field.value(field.layers(), {2.8, 1.9}), field.value(field.layers(), {3.0, 0.0}));
}

TEST(CrowdField, NoPlaceOfTheWayIsAGoalButItsEnd) {
  CrowdField field{{}, kRadius};
  // A row of people across the way, open at one side: where the way meets it there is nothing to be had.
  std::vector<Obstacle> row;
  for (double y = -4.5; y < 1.6; y += 0.3) row.push_back(standing(1.2, y));
  field.build({0.0, 0.0}, row, {kPath, true});
  EXPECT_LT(field.value(field.layers(), {0.6, 1.8}), field.value(field.layers(), {0.6, 0.0}) - 2.0);
}

TEST(CrowdField, SomebodyNewMayBeSomebodyWhoWalks) {
  CrowdField field{{}, kRadius};
  std::vector<Obstacle> people{standing(1.5, 0.0)};
  field.build({0.0, 0.0}, people, {kPath, false});
  const double of_known = field.cost(0, {1.5, 0.0});
  people[0].stood = 0.25;
  field.build({0.0, 0.0}, people, {kPath, false});
  EXPECT_LT(field.cost(0, {1.5, 0.0}), 0.5 * of_known);
}

TEST(CrowdField, SpaceRoundPeopleCostsMoreTheNearer) {
  const CrowdFitParams params;
  CrowdField field{params, kRadius};
  const std::vector<Obstacle> people{standing(1.5, 0.0)};
  field.build({0.0, 0.0}, people, {kPath, false});
  const auto at_gap = [&](double gap) { return field.cost(0, {1.5, kRadius + gap}); };
  EXPECT_NEAR(at_gap(-0.15), params.blocked_weight, 1e-3);
  EXPECT_NEAR(at_gap(0.185), params.intimate_weight, 1e-3);
  EXPECT_LT(at_gap(0.5), params.personal_weight);
  EXPECT_GT(at_gap(0.5), at_gap(0.7));
  EXPECT_DOUBLE_EQ(at_gap(1.3), 0.0);
}

TEST(CrowdField, WhoWalksIsWhereTheyWillBe) {
  CrowdField field{{}, kRadius};
  const std::vector<Obstacle> people{{{1.5, -0.9}, {0.0, 1.0}, 0.08, true, false}};
  field.build({0.0, 0.0}, people, {kPath, false});
  EXPECT_GT(field.cost(3, {1.5, 0.0}), 4.0) << "0.9 s from now they are there";
  EXPECT_LT(field.cost(0, {1.5, 0.3}), 1.0);
  EXPECT_LT(field.cost(8, {1.5, 0.0}), 1.0) << "and then gone";
  EXPECT_DOUBLE_EQ(field.cost(field.layers(), {1.5, 0.0}), 0.0);
}

TEST(CrowdField, AWayLeadsRoundWhoStands) {
  CrowdField field{{}, kRadius};
  const std::vector<Obstacle> people{standing(1.2, 0.1), standing(1.2, 0.4)};
  field.build({0.0, 0.0}, people, {kPath, false});
  const auto on = field.way_on({0.0, 0.0}, 0.9);
  ASSERT_TRUE(on);
  EXPECT_LT(on->y, -0.1) << "on the side that is open";
}

}  // namespace
}  // namespace docent
