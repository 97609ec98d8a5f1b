#include "docent/evaluation/reference/reference_score.h"

#include <gtest/gtest.h>

namespace docent::evaluation {
namespace {

TEST(ReferenceScore, CountsFromTheFirstClaimAndOnlyWhereTheTruthIsKnown) {
  const ScanReference reference{Pose2{}, Pose2{}, std::nullopt, Pose2{}, Pose2{}, Pose2{}, Pose2{}};
  const std::vector<LocalizedScan> scans{{Pose2{9, 0, Angle{}}, false},
                                         {Pose2{0.1, 0, Angle{}}, true},
                                         {Pose2{50, 0, Angle{}}, true},  // nobody knows
                                         {Pose2{0.3, 0, Angle::degrees(19)}, false},
                                         {Pose2{0.51, 0, Angle{}}, true},
                                         {Pose2{0, 0, Angle::degrees(-21)}, false},
                                         {std::nullopt, false}};
  const ReferenceScore score = score_against(reference, scans, false);
  EXPECT_EQ(score.waited, 1U);
  EXPECT_EQ(score.scans, 5U);
  EXPECT_EQ(score.lost, 3U);  // too far, turned, without a pose
  EXPECT_EQ(score.sure_and_wrong, 1U);
  EXPECT_EQ(score.unsure, 3U);
  EXPECT_NEAR(score.mean_m, (0.1 + 0.3 + 0.51 + 0.0) / 4.0, 1e-12);
  EXPECT_NEAR(score.max_m, 0.51, 1e-12);
  EXPECT_NEAR(score.max_deg, 21.0, 1e-9);
  EXPECT_NEAR(score.lost_fraction(), 0.6, 1e-12);
  EXPECT_EQ(score_against(reference, scans, true).scans, 6U);
  EXPECT_NEAR(score_against(reference, scans, true).max_m, 9.0, 1e-12);
}

TEST(ReferenceScore, WhoNeverSaysWhereItIsIsLost) {
  const ReferenceScore score = score_against({Pose2{}, Pose2{}}, std::vector<LocalizedScan>(2), false);
  EXPECT_EQ(score.waited, 2U);
  EXPECT_EQ(score.scans, 0U);
  EXPECT_EQ(score.lost_fraction(), 1.0);
}

}  // namespace
}  // namespace docent::evaluation
