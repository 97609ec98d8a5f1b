#include "docent/collision_avoidance/watches/position_doubt.h"

#include <gtest/gtest.h>

#include <vector>

#include "docent/base/random.h"

namespace docent::collision_avoidance::position_doubt_test {
namespace {

/// Cells as a tracking belief has them: a few cells wide, a few degrees.
std::vector<BelievedPose> cells_round(const Pose2& pose, double mass) {
  Rng rng{5};
  std::vector<BelievedPose> cells;
  constexpr int kCount = 400;
  for (int i = 0; i < kCount; ++i) {
    const Angle turn = Angle::degrees(rng.normal(0.0, 3.0));
    cells.push_back({{pose.x + rng.normal(0.0, 0.1), pose.y + rng.normal(0.0, 0.1), pose.theta + turn}, mass / kCount});
  }
  return cells;
}

std::string reason_after(int beliefs, const std::vector<BelievedPose>& cells, const std::vector<BelievedPose>& modes,
                         double p_lost = 0.01, bool localized = true) {
  PositionDoubt doubt;
  for (int i = 0; i < beliefs; ++i) doubt.believe({cells, modes, p_lost, localized});
  return doubt.complaint() ? doubt.complaint()->reason : "";
}

const Pose2 kHere{4.0, 7.0, Angle::degrees(170)};

TEST(PositionDoubt, ATrackingBeliefIsWell) {
  EXPECT_EQ(reason_after(5, cells_round(kHere, 1.0), {{kHere, 0.97}}), "");
  const Pose2 beside{4.3, 7.0, Angle::degrees(172)};
  EXPECT_EQ(reason_after(5, cells_round(kHere, 1.0), {{kHere, 0.5}, {beside, 0.4}}), "") << "one place, two peaks";
}

TEST(PositionDoubt, ABestPoseBesideTheCells) {
  const auto cells = cells_round(kHere, 1.0);
  const Pose2 off{4.3, 7.0, kHere.theta};
  EXPECT_EQ(reason_after(1, cells, {{off, 0.97}}), "") << "once is chance";
  EXPECT_EQ(reason_after(2, cells, {{off, 0.97}}), "the best pose is not where the belief is");
  const Pose2 turned{4.0, 7.0, Angle::degrees(-180)};  // 10 degrees, over the seam
  EXPECT_EQ(reason_after(2, cells, {{turned, 0.97}}), "the best pose is not where the belief is");
}

TEST(PositionDoubt, ASecondModeOfWeight) {
  const Pose2 there{14.0, 3.0, {}};
  auto cells = cells_round(kHere, 0.5);
  const auto others = cells_round(there, 0.5);
  cells.insert(cells.end(), others.begin(), others.end());
  EXPECT_EQ(reason_after(2, cells, {{kHere, 0.5}, {there, 0.5}}), "it may be in two places");
  EXPECT_EQ(reason_after(2, cells, {{kHere, 0.9}, {there, 0.1}}), "");
}

TEST(PositionDoubt, DoubtOfLocalizationItselfCountsAtOnce) {
  const auto cells = cells_round(kHere, 1.0);
  EXPECT_EQ(reason_after(1, cells, {{kHere, 0.97}}, 0.8), "the position is doubtful");
  EXPECT_EQ(reason_after(1, cells, {{kHere, 0.97}}, 0.1, false), "the position is not known");
  EXPECT_EQ(reason_after(1, {}, {}, 1.0, false), "the position is not known");
}

TEST(PositionDoubt, IsOverWhenTheBeliefIsWellAgain) {
  const auto cells = cells_round(kHere, 1.0);
  const std::vector<BelievedPose> off{{{4.4, 7.0, kHere.theta}, 0.97}};
  const std::vector<BelievedPose> well{{kHere, 0.97}};
  PositionDoubt doubt;
  for (int i = 0; i < 3; ++i) doubt.believe({cells, off, 0.01, true});
  ASSERT_TRUE(doubt.complaint());
  EXPECT_EQ(doubt.complaint()->max_speed, ComplaintParams{}.crippled_speed);
  doubt.believe({cells, well, 0.01, true});
  EXPECT_FALSE(doubt.complaint());
}

}  // namespace
}  // namespace docent::collision_avoidance::position_doubt_test
