#include "docent/modules/drive/hazards_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/modules/shared/belief_cells.h"
#include "docent/modules/shared/module_bench.h"

namespace docent::modules {
namespace {

constexpr std::size_t kDirections = 180;         // of a turn
constexpr std::size_t kAhead = kDirections / 2;  // the first one looks back

/// A hall of 20 x 20 m with a plate in it, 1 x 2 m.
class HazardsModule : public ModuleBench {
 protected:
  HazardsModule() : ModuleBench{"hazards", make_hazards} {
    museum.area = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
    museum.hazards.push_back({"plate", museum::HazardKind::plate, {{10, 9}, {11, 9}, {11, 11}, {10, 11}}});
    world->subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, [this](const auto& scan) { scans.push_back(scan); });
  }
  /// Cells of equal mass, all looking to the east.
  static docent_msgs::Belief belief_at(const std::vector<Point2>& places, double stamp) {
    docent_msgs::Belief belief;
    belief.header = {to_message(time_from_seconds(stamp)), "map"};
    for (const Point2 place : places)
      belief.cells.push_back(
          {static_cast<float>(place.x), static_cast<float>(place.y), 0.0F, 1.0F / static_cast<float>(places.size())});
    belief.hypotheses.push_back({places.front().x, places.front().y, 0.0, {}, 1.0});
    return belief;
  }
  [[nodiscard]] float ahead() const { return scans.back().ranges[kAhead]; }
  transport::Publisher<nav_msgs::Odometry> odometries = world->publisher(topics::kOdometry);
  transport::Publisher<docent_msgs::Belief> beliefs = world->publisher(topics::kBelief);
  std::vector<sensor_msgs::LaserScan> scans;
};

TEST_F(HazardsModule, MeasuresFromTheWholeBeliefHazardsFirstAndThenTheBorder) {
  start();
  run(1.0);
  EXPECT_TRUE(scans.empty()) << "without a belief it knows nothing";
  EXPECT_EQ(module->health().state, "starting");
  beliefs.publish(belief_at({{6, 10}, {8, 10}}, 0.7));
  run(0.01);
  ASSERT_EQ(scans.size(), 1U);
  const auto& scan = scans[0];
  EXPECT_EQ(scan.header.frame_id, "base_link");
  EXPECT_EQ(from_message(scan.header.stamp), time_from_seconds(0.7)) << "of the belief";
  ASSERT_EQ(scan.ranges.size(), 2 * kDirections);
  EXPECT_NEAR(static_cast<double>(ahead()), 2.0, 0.11) << "as from the nearer cell";
  EXPECT_EQ(scan.ranges[0], scan.range_max) << "nothing behind it";
  EXPECT_EQ(scan.ranges[kDirections + kAhead], scan.range_max) << "the border is 12 m away";
  beliefs.publish(belief_at({{3, 10}}, 1.0));
  run(0.01);
  EXPECT_NEAR(static_cast<double>(scans.back().ranges[kDirections]), 3.0, 0.11) << "the border behind it";
  EXPECT_EQ(module->health().state, "ready");
}

TEST_F(HazardsModule, AHundredthOfMassOnTheCoarseGridCounts) {
  start();
  auto belief = belief_at({{3, 10}}, 0.0);
  belief.cells[0].mass = 0.97F;
  belief.rest = {8.0F, 9.5F, 1.0F, 1, 1, {0.03F}};  // a metre before the plate
  beliefs.publish(belief);
  run(0.01);
  EXPECT_LT(ahead(), 1.6F);
  EXPECT_NEAR(static_cast<double>(scans.back().ranges[0]), static_cast<double>(ahead()), 0.8)
      << "whatever the heading there";
  belief.cells[0].mass = 0.999F;
  belief.rest.mass = {0.001F};
  beliefs.publish(belief);
  run(0.01);
  EXPECT_EQ(ahead(), scans.back().range_max);
}

TEST_F(HazardsModule, NamesTheZoneInWhichTheRobotKnowsThatItStands) {
  start();
  auto belief = belief_at({{10.5, 10}}, 0.0);
  beliefs.publish(belief);
  run(0.01);
  EXPECT_EQ(module->health().reason.find("'plate'"), std::string::npos) << "it does not know where it is";
  belief.localized = true;
  beliefs.publish(belief);
  run(0.01);
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("inside the zone 'plate'"), std::string::npos) << module->health().reason;
  belief = belief_at({{6, 10}}, 0.0);
  belief.localized = true;
  beliefs.publish(belief);
  run(0.01);
  EXPECT_EQ(module->health().state, "ready");
}

TEST_F(HazardsModule, WhileTheMapIsMadeTheBorderCountsFromTheLikeliestPlaceAndHazardsFromAll) {
  start();
  auto belief = belief_at({{3, 10}, {2.8, 10}, {8, 10}}, 0.0);
  beliefs.publish(belief);
  run(0.01);
  const float border = scans.back().ranges[kDirections], hazard = ahead();
  belief.map_hash = kMapBeingMade;
  beliefs.publish(belief);
  run(0.01);
  EXPECT_GT(scans.back().ranges[kDirections], border + 0.1F);
  EXPECT_EQ(ahead(), hazard);
}

TEST_F(HazardsModule, RepeatsALastMeasurementWithItsStampUntilItIsTooOld) {
  start();
  beliefs.publish(belief_at({{8, 10}}, 0.0));
  run(2.9);
  EXPECT_GE(scans.size(), 11U) << "four times a second";
  for (const auto& scan : scans) EXPECT_EQ(from_message(scan.header.stamp), Time{});
  EXPECT_EQ(module->health().state, "ready");
  run(0.3);
  EXPECT_EQ(module->health().reason, "no fresh belief");
  scans.clear();
  run(5.0);
  EXPECT_TRUE(scans.empty()) << "who needs it shall stand";
  beliefs.publish(belief_at({{8, 10}}, 8.2));
  run(0.01);
  EXPECT_EQ(scans.size(), 1U);
  EXPECT_EQ(module->health().state, "ready");
}

TEST_F(HazardsModule, CarriesOnWhatItMeasuredByOdometryForAWhile) {
  const auto drive_to = [&](double x) {
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(hub.now()), "odom"};
    odometry.pose.pose = to_message(Pose2{x, 0.0, {}});
    odometries.publish(odometry);
    run(0.05);
  };
  start();
  auto belief = belief_at({{8, 10}}, 0.0);
  belief.odom_pose = to_message(Pose2{});
  beliefs.publish(belief);
  run(0.05);
  const float first = ahead();
  for (int i = 1; i <= 6; ++i) drive_to(0.05 * i);
  EXPECT_NEAR(static_cast<double>(ahead()), static_cast<double>(first) - 0.3, 0.06) << "it has come nearer";
  EXPECT_GT(from_message(scans.back().header.stamp), time_from_seconds(0.2)) << "as of now";
  EXPECT_LE(scans.size(), 5U) << "not at each message of the odometry";
  drive_to(60.0);
  EXPECT_NEAR(static_cast<double>(ahead()), static_cast<double>(first) - 0.3, 0.06) << "a jump is no way";
  for (int i = 7; i <= 20; ++i) drive_to(0.3);
  EXPECT_EQ(from_message(scans.back().header.stamp), Time{}) << "an old belief is not made younger for ever";
  EXPECT_EQ(ahead(), first);
}

TEST_F(HazardsModule, ANewProcessMeasuresAtOnceFromTheBeliefThatHolds) {
  beliefs.publish(belief_at({{8, 10}}, 0.0));
  run(1.0);
  start();
  run(0.01);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(from_message(scans[0].header.stamp), Time{}) << "and does not make it younger";
}

TEST_F(HazardsModule, SaysSoWhenTheRobotCannotBeWhereItIsBelieved) {
  start();
  beliefs.publish(belief_at({{10.5, 10}, {10.5, 10.5}, {8, 10}}, 0.0));
  run(0.01);
  EXPECT_EQ(module->health().reason, "the belief lies where the robot cannot be");
}

TEST_F(HazardsModule, KeepsOffMoreWhileMountsAndMarksAreDoubtful) {
  start();
  const auto calibrations = world->publisher(topics::kCalibration);
  const auto surveys = world->publisher(topics::kExploration);
  beliefs.publish(belief_at({{5.0, 10.0}}, 1.0));
  run(0.1);
  const float before = ahead();
  const float aside = scans.back().ranges[kAhead + 10];
  docent_msgs::Calibration calibration;
  calibration.mounts.push_back({"front", 0.0, 0.0, 0.0, 0.0, 0.1, 0.1, false});
  calibrations.publish(calibration);
  run(0.1);
  beliefs.publish(belief_at({{5.0, 10.0}}, 2.0));
  run(0.1);
  EXPECT_NEAR(ahead(), before - 0.25F, 0.01F) << "2.5 standard deviations";
  EXPECT_LT(scans.back().ranges[kAhead + 10], aside - 0.5F) << "20 degrees aside the plate may lie, too";
  calibration.mounts[0].is_known = true;
  calibrations.publish(calibration);
  docent_msgs::Exploration survey;
  survey.mark_margin = 0.4;
  surveys.publish(survey);
  run(0.1);
  beliefs.publish(belief_at({{5.0, 10.0}}, 3.0));
  run(0.1);
  EXPECT_NEAR(ahead(), before - 0.4F, 0.01F);
}

}  // namespace
}  // namespace docent::modules
