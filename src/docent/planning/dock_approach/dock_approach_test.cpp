#include "docent/planning/dock_approach/dock_approach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::planning {
namespace {

/// Drives a base that does what it is told until it is done, at most a minute and a half. The tag stands at the origin.
DockApproach drive(Pose2& base, bool sees, double line_off = 0.0) {
  DockApproach approach{{}, Time{}};
  for (int i = 0; i < 1800; ++i) {
    DockApproachView view{base, {}, {}, std::abs(base.y) < 0.01 && base.x < 0.35};
    if (sees) view.odom_from_tag = Pose2{0.0, line_off, {}};
    const auto command = approach.step(view, time_from_seconds(0.05 * i));
    base = base * Pose2{0.05 * command.speed, 0.0, Angle::radians(0.05 * command.turn)};
    if (approach.state() == DockApproach::State::docked || approach.state() == DockApproach::State::failed) break;
  }
  return approach;
}

TEST(DockApproach, ComesToTheContactsFromAllSides) {
  for (const double y : {-0.5, 0.0, 0.5}) {
    for (const double degrees : {-30.0, 0.0, 30.0}) {
      Pose2 base{1.85, y, Angle::degrees(180.0 + degrees)};
      const DockApproach approach = drive(base, true);
      EXPECT_EQ(approach.state(), DockApproach::State::docked) << y << " " << degrees;
      EXPECT_NEAR(base.y, 0.0, 0.01);
      EXPECT_NEAR((base.theta - Angle::degrees(180.0)).radians(), 0.0, 0.05);
      EXPECT_EQ(approach.attempts(), 1) << y << " " << degrees;
    }
  }
}

TEST(DockApproach, GivesUpWhereNoTagIsSeenAndWhereTheContactsDoNotAnswer) {
  Pose2 base{1.85, 0.2, Angle::degrees(170.0)};
  EXPECT_EQ(drive(base, false).state(), DockApproach::State::failed);
  EXPECT_NEAR(base.x, 1.85, 1e-6) << "without a line it only turns";
  base = {1.85, 0.2, Angle::degrees(170.0)};
  DockApproachParams params;
  params.attempts = 2;
  DockApproach approach{params, Time{}};
  for (int i = 0; i < 2400 && approach.state() != DockApproach::State::failed; ++i) {
    const auto command = approach.step({base, {}, Pose2{}, false}, time_from_seconds(0.05 * i));
    base = base * Pose2{0.05 * command.speed, 0.0, Angle::radians(0.05 * command.turn)};
    ASSERT_GT(base.x, 0.3) << "it does not push";
  }
  EXPECT_EQ(approach.state(), DockApproach::State::failed);
}

TEST(DockApproach, BacksOffFromALineThatJumpsShortlyBeforeTheContacts) {
  DockApproach approach{{}, Time{}};
  Pose2 base{0.45, 0.0, Angle::degrees(180.0)};
  (void)approach.step({base, {}, Pose2{}, false}, Time{});
  ASSERT_EQ(approach.state(), DockApproach::State::goes_straight);
  (void)approach.step({base, {}, Pose2{0.0, 0.05, {}}, false}, Time{});
  EXPECT_EQ(approach.state(), DockApproach::State::backs_off);
  EXPECT_LT(approach.step({base, {}, Pose2{0.0, 0.05, {}}, false}, Time{}).speed, 0.0);
}

}  // namespace
}  // namespace docent::planning
