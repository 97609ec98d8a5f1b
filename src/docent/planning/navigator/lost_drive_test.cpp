#include "docent/planning/navigator/lost_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "docent/planning/navigator/testing.h"

namespace docent::planning::lost_drive_test {
namespace {

constexpr double kReach = 10.0;  // [m]

/// The robot looks along the corridor, or, the other way, from the mirrored place.
PoseBelief two_ends(double x) {
  PoseBelief belief;
  belief.hypotheses = {{{x, 1.2, {}}, {}, 0.5}, {{24.0 - x, 1.2, Angle::degrees(180)}, {}, 0.5}};
  return belief;
}

/// Eight metres along the corridor, both ways.
std::vector<double> open_along() {
  std::vector<double> clearances(180, 1.2);
  for (std::size_t i = 0; i < clearances.size(); ++i) {
    const double off = std::abs(-180.0 + 2.0 * static_cast<double>(i));
    if (off < 30.0 || off > 150.0) clearances[i] = 8.0;
  }
  return clearances;
}

Whereabouts at(const Pose2& odom_from_base) {
  Whereabouts where;
  where.map_from_odom = Pose2{};
  where.odom_from_base = odom_from_base;
  return where;
}

LostDrive drive(bool active = true) { return {testing::corridor_with_alcove(), 0.27, {}, active}; }

TEST(LostDrive, DrivesAtOnceToWhereItsHypothesesDiffer) {
  LostDrive lost = drive();
  lost.start(Time{});
  const auto step = lost.step(at({}), two_ends(14.0), open_along(), kReach, Time{});
  ASSERT_TRUE(step.drive);
  EXPECT_GT(std::abs(step.via.x), 1.0);
  EXPECT_EQ(lost.held_up_s(Time{}), 0.0);
  (void)lost.step(at({}), two_ends(14.0), open_along(), kReach, time_from_seconds(4.0));
  EXPECT_NEAR(lost.held_up_s(time_from_seconds(4.0)), 4.0, 1e-9);
}

TEST(LostDrive, OnlyLooksRoundWhereItIsNotActiveOrHasNoBelief) {
  LostDrive passive = drive(false);
  passive.start(Time{});
  EXPECT_FALSE(passive.step(at({}), two_ends(14.0), open_along(), kReach, Time{}).drive);
  LostDrive lost = drive();
  lost.start(Time{});
  EXPECT_FALSE(lost.step(at({}), {}, open_along(), kReach, Time{}).drive);
  auto without_map = at({});
  without_map.map_from_odom.reset();
  lost.start(Time{});
  EXPECT_FALSE(lost.step(without_map, two_ends(14.0), open_along(), kReach, time_from_seconds(2.0)).drive);
}

TEST(LostDrive, OnlyTurnsWithoutClearances) {
  LostDrive lost = drive();
  lost.start(Time{});
  EXPECT_FALSE(lost.step(at({}), two_ends(14.0), {}, kReach, Time{}).drive);
}

TEST(LostDrive, OdometryCarriesTheHypothesesOn) {
  // The belief of x = 12 is old; the robot has driven on by 2 m since. It must drive as one that believes 14 now.
  LostDrive now = drive();
  now.start(Time{});
  const auto fresh = now.step(at({}), two_ends(14.0), open_along(), kReach, Time{});
  PoseBelief old = two_ends(12.0);
  old.odom_from_base = Pose2{5.0, 0.0, {}};
  LostDrive then = drive();
  then.start(Time{});
  const auto carried = then.step(at({7.0, 0.0, {}}), old, open_along(), kReach, Time{});
  ASSERT_TRUE(fresh.drive);
  ASSERT_TRUE(carried.drive);
  EXPECT_NEAR(carried.via.x - 7.0, fresh.via.x, 1e-6);
  EXPECT_NEAR(carried.via.y, fresh.via.y, 1e-6);
}

}  // namespace
}  // namespace docent::planning::lost_drive_test
