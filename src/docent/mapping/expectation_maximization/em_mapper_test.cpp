#include "docent/mapping/expectation_maximization/em_mapper.h"

#include <gtest/gtest.h>

#include "docent/mapping/expectation_maximization/odometry_calibration.h"
#include "docent/mapping/graph_mapping/scan_chain.h"
#include "docent/mapping/graph_mapping/testing.h"

namespace docent::mapping {
namespace {

std::vector<Pose2> at(const std::vector<Pose2>& poses, const std::vector<std::size_t>& indices) {
  std::vector<Pose2> chosen;
  for (const std::size_t i : indices) chosen.push_back(poses[i]);
  return chosen;
}

TEST(ExpectationMaximization, ClosesARingFromABlindStart) {
  const testing::Drive drive = testing::drive_round(2.2, 0.0, 0.06, 1);
  EmMapperParams params;
  params.way_per_metre = 0.004;
  params.turn_per_metre = 0.0006;
  std::vector<double> likelihoods[3];
  double blind = 0.0;
  const EmMap map = map_by_em(drive.scans, params, [&](const EmProgress& progress) {
    likelihoods[progress.level].push_back(progress.log_likelihood);
    if (progress.level == 0 && progress.iteration == 0) {
      std::vector<std::size_t> scans;
      for (const SeenPlace& place : progress.places) scans.push_back(place.scan);
      blind = testing::relation_error(at(drive.truth, scans), {progress.poses.begin(), progress.poses.end()}, 24);
    }
    return true;
  });
  const double found = testing::relation_error(at(drive.truth, map.scans), map.map_from_base, 24);
  EXPECT_GT(blind, 1.0);
  EXPECT_LT(found, 0.35);
  for (const auto& level : likelihoods) {
    ASSERT_GE(level.size(), 2U);
    // The first iteration of a level is blind, or has a map of a coarser one; from then on it rises.
    for (std::size_t i = 2; i < level.size(); ++i) EXPECT_GE(level[i], level[i - 1] - 1.0) << i;
  }
}

TEST(ExpectationMaximization, EndsWhereItIsTold) {
  const testing::Drive drive = testing::drive_round(0.5, 0.0, 0.05, 2);
  int told = 0;
  const EmMap map = map_by_em(drive.scans, {}, [&](const EmProgress&) { return ++told < 2; });
  EXPECT_EQ(told, 2);
  EXPECT_EQ(map.scans.size(), map.map_from_base.size());
  EXPECT_TRUE(map_by_em({}, {}).scans.empty());
}

TEST(OdometryCalibration, FindsTheVeerAndTakesItOut) {
  const testing::Drive drive = testing::drive_round(1.2, 0.05, 0.03, 3);
  const ScanChain chain{{}, {0.05, 0.07, 4}, {}};
  const OdometryCalibration found = calibrate_odometry(drive.scans, chain_of(drive.scans, chain), {});
  EXPECT_NEAR(found.veer, -0.05, 0.01);
  EXPECT_NEAR(found.way_scale, 1.0, 0.03);
  EXPECT_LT(std::sqrt(found.turn_per_metre), 0.05);
  const auto corrected = with_odometry_corrected(drive.scans, found);
  std::vector<Pose2> before;
  std::vector<Pose2> after;
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    before.push_back(drive.scans[i].odom_from_base);
    after.push_back(corrected[i].odom_from_base);
  }
  EXPECT_LT(testing::relation_error(drive.truth, after, 100), 0.3 * testing::relation_error(drive.truth, before, 100));
}

TEST(OdometryCalibration, ChangesNothingWhereTheDriveIsTooShort) {
  const testing::Drive drive = testing::drive_round(0.1, 0.05, 0.03, 4);
  const ScanChain chain{{}, {0.05, 0.07, 4}, {}};
  const OdometryCalibration found = calibrate_odometry(drive.scans, chain_of(drive.scans, chain), {});
  EXPECT_EQ(found.veer, 0.0);
  EXPECT_EQ(found.turn_scale, 1.0);
}

}  // namespace
}  // namespace docent::mapping
