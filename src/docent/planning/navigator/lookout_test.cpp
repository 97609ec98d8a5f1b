#include "docent/planning/navigator/lookout.h"

#include <gtest/gtest.h>

#include <numbers>

#include "docent/planning/exploration/clearances.h"

namespace docent::planning::lookout_test {
namespace {

constexpr double kStep = std::numbers::pi / 180.0;  // [rad] between two readings

/// All round; every reading is `range` metres.
Sweep all_round(double taken, float range) {
  return {time_from_seconds(taken), -std::numbers::pi, kStep, 10.0, std::vector<float>(360, range)};
}
/// The half before the sensor.
Sweep ahead(double taken, float range) {
  return {time_from_seconds(taken), -std::numbers::pi / 2.0, kStep, 8.0, std::vector<float>(181, range)};
}
double to(const std::vector<double>& clearances, double degrees) {
  return clearances[static_cast<std::size_t>((degrees + 180.0) / 2.0)];
}

/// A robot that stands at odometry's origin, or has been driven elsewhere at `turned_at`.
struct LookoutTest : ::testing::Test {
  [[nodiscard]] Whereabouts where(const Pose2& now = {}, double moved_at = 1e9) const {
    Whereabouts result;
    result.odom_from_base = now;
    result.odom_from_base_at = [=](Time time) -> std::optional<Pose2> {
      return time < time_from_seconds(moved_at) ? Pose2{} : now;
    };
    return result;
  }
  Lookout lookout{{Pose2{}}};
};

TEST_F(LookoutTest, SeesNothingUntilEverySweepIsThereAndFresh) {
  lookout.see(0, all_round(10.0, 3.0F));
  EXPECT_TRUE(lookout.clearances(where(), time_from_seconds(10.0)).empty()) << "hazards are not known";
  lookout.see_hazards(all_round(10.0, 5.0F));
  EXPECT_EQ(lookout.clearances(where(), time_from_seconds(10.0)).size(), Clearances::kDirections);
  EXPECT_FALSE(lookout.clearances(where(), time_from_seconds(12.0)).empty());
  lookout.see(0, all_round(12.1, 3.0F));
  EXPECT_TRUE(lookout.clearances(where(), time_from_seconds(12.1)).empty()) << "hazards of 2.1 s ago";
  lookout.see_hazards(all_round(14.3, 5.0F));
  EXPECT_TRUE(lookout.clearances(where(), time_from_seconds(14.3)).empty()) << "a sweep of 2.2 s ago";
  auto nowhere = where();
  nowhere.odom_from_base_at = [](Time) { return std::nullopt; };
  lookout.see(0, all_round(14.3, 3.0F));
  EXPECT_TRUE(lookout.clearances(nowhere, time_from_seconds(14.3)).empty()) << "nobody knows where it was taken";
  Lookout without_scanners{{}};
  without_scanners.see_hazards(all_round(10.0, 5.0F));
  EXPECT_TRUE(without_scanners.clearances(where(), time_from_seconds(10.0)).empty());
}

TEST_F(LookoutTest, TheSmallerOfBothCounts) {
  lookout.see(0, all_round(10.0, 3.0F));
  auto hazards = all_round(10.0, 5.0F);
  for (std::size_t i = 260; i < 285; ++i) hazards.ranges[i] = 1.0F;  // round 90 degrees
  lookout.see_hazards(hazards);
  const auto free = lookout.clearances(where(), time_from_seconds(10.0));
  ASSERT_FALSE(free.empty());
  EXPECT_NEAR(to(free, 0.0), 3.0, 1e-6);
  EXPECT_NEAR(to(free, 90.0), 1.0, 1e-6);
}

TEST_F(LookoutTest, ASweepIsPlacedWhereItWasTaken) {
  lookout.see(0, all_round(10.0, 3.0F));
  lookout.see_hazards(all_round(10.0, 8.0F));
  const auto free = lookout.clearances(where(Pose2{1.0, 0.0, {}}, 10.5), time_from_seconds(11.0));
  ASSERT_FALSE(free.empty());
  EXPECT_NEAR(to(free, 0.0), 2.0, 0.05);
  EXPECT_NEAR(to(free, -180.0), 4.0, 0.05);
}

TEST_F(LookoutTest, WhereNoScannerReadsNowThePastCountsForAWhile) {
  lookout.see(0, ahead(10.0, 3.0F));
  lookout.see_hazards(all_round(10.0, 9.0F));
  const auto first = lookout.clearances(where(), time_from_seconds(10.0));
  ASSERT_FALSE(first.empty());
  EXPECT_NEAR(to(first, 0.0), 3.0, 1e-6);
  EXPECT_EQ(to(first, -180.0), 0.0) << "nobody looked there";
  const auto round = where(Pose2{0.0, 0.0, Angle::degrees(180)}, 11.0);
  const auto turn_and_look = [&](double at) {
    lookout.see(0, ahead(at, 4.0F));
    lookout.see_hazards(all_round(at, 9.0F));
    return lookout.clearances(round, time_from_seconds(at));
  };
  const auto turned = turn_and_look(12.0);
  ASSERT_FALSE(turned.empty());
  EXPECT_NEAR(to(turned, 0.0), 4.0, 1e-6);
  EXPECT_NEAR(to(turned, -180.0), 3.0, 1e-6) << "it looked there two seconds ago";
  const auto later = turn_and_look(16.0);
  ASSERT_FALSE(later.empty());
  EXPECT_EQ(to(later, -180.0), 0.0) << "six seconds are too long";
}

TEST_F(LookoutTest, ReachesAsFarAsItsBestScanner) {
  Lookout two{{Pose2{}, Pose2{0.0, 0.0, Angle::degrees(180)}}};
  EXPECT_EQ(two.reach(), 0.0);
  two.see(1, ahead(1.0, 3.0F));
  EXPECT_EQ(two.reach(), 8.0);
  two.see(0, all_round(1.0, 3.0F));
  EXPECT_EQ(two.reach(), 10.0);
}

}  // namespace
}  // namespace docent::planning::lookout_test
