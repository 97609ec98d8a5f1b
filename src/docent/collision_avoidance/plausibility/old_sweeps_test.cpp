#include "docent/collision_avoidance/plausibility/old_sweeps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::old_sweeps_test {
namespace {

/// A robot that begins at rest and turns on the spot after a second, up to half a radian a second, for four seconds.
class OldSweepsTest : public ::testing::Test {
 protected:
  OldSweepsTest() {
    room.box(-4, -3, 7, 4);
    room.discs = {{{2.0, 2.0}, 0.3}, {{3.0, -1.5}, 0.25}, {{-1.0, 2.0}, 0.25}};
  }
  /// @returns [s] when old sweeps are found; -1: never
  double go(std::size_t lag) {
    OldSweeps check;
    std::deque<SensorSweep> given;
    Pose2 at;    // the base's
    Pose2 said;  // by odometry
    for (int i = 0; i < 100; ++i) {
      const double time = 0.1 * i;
      const Pose2 step = motion(time);
      at = at * really(time, step);
      said = said * step;
      if (walks) walks(time);
      given.push_back(room.sweep(1.0 + time, at * mount));
      SensorSweep sweep = given[given.size() > lag ? given.size() - 1 - lag : 0];
      sweep.stamp = given.back().stamp;
      if (const auto age = check.add(view_of(sweep, said * mount), mount)) {
        found = *age;
        return time;
      }
    }
    return -1.0;
  }
  RoomForTest room;
  Pose2 mount{0.2, 0.0, {}};
  /// [base] of a tenth of a second, by odometry
  std::function<Pose2(double)> motion = [](double time) {
    const double rate = time < 1.0 ? 0.0 : time < 5.0 ? std::min(0.5, 1.0 * (time - 1.0)) : 0.0;
    return Pose2{0.0, 0.0, Angle::radians(0.1 * rate)};
  };
  std::function<Pose2(double, Pose2)> really = [](double, Pose2 step) { return step; };
  std::function<void(double)> walks;
  double found = 0.0;
};

TEST_F(OldSweepsTest, ThoseOfASecondAgoShowWithinASecondOfWhenTheyCan) {
  const double when = go(10);
  EXPECT_NEAR(found, 1.0, 0.15);
  EXPECT_GT(when, 2.0);  // before, they show no turn
  EXPECT_LT(when, 3.0);
}

TEST_F(OldSweepsTest, OtherAgesShow) {
  EXPECT_GT(go(5), 0.0);
  EXPECT_NEAR(found, 0.5, 0.15);
  EXPECT_GT(go(25), 0.0);
  EXPECT_NEAR(found, 2.5, 0.15);
}

TEST_F(OldSweepsTest, ScannersInOrderAndLittleDelaysAreNoOldOnes) {
  EXPECT_EQ(go(0), -1.0);
  EXPECT_EQ(go(2), -1.0);
}

TEST_F(OldSweepsTest, WheelsThatSlipAreNoOldSweeps) {
  const auto turns = motion;
  really = [](double, Pose2) { return Pose2{}; };  // all the while
  EXPECT_EQ(go(0), -1.0);
  really = [](double, Pose2 step) { return Pose2{0.0, 0.0, Angle::radians(0.4 * step.theta.radians())}; };
  EXPECT_EQ(go(0), -1.0);
  // Twenty degrees and a few decimetres within a second, at rest, in a drive and in a turn.
  for (const Pose2& usual : {Pose2{}, Pose2{0.05, 0.0, {}}, Pose2{0.0, 0.0, Angle::radians(0.04)}}) {
    for (const double sign : {1.0, -1.0}) {
      const auto slips = [&](double time) { return time > 2.0 && time < 3.0; };
      motion = [&](double time) {
        return slips(time) ? usual * Pose2{0.03, 0.0, Angle::radians(sign * 0.035)} : usual;
      };
      really = [&](double, Pose2) { return usual; };
      EXPECT_EQ(go(0), -1.0) << usual.x << " " << sign;
      // And pushed, of which the wheels do not know.
      motion = [&](double) { return usual; };
      really = [&](double time, Pose2) {
        return slips(time) ? usual * Pose2{0.03, 0.0, Angle::radians(sign * 0.035)} : usual;
      };
      EXPECT_EQ(go(0), -1.0) << usual.x << " " << sign;
    }
  }
}

TEST_F(OldSweepsTest, PeopleWhoWalkAboutAreNoOldSweeps) {
  walks = [&](double time) {
    room.discs.clear();
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.8 * k + (k % 2 == 0 ? 0.5 : -0.6) * time;
      room.discs.push_back({{1.6 * std::cos(angle), 1.6 * std::sin(angle)}, 0.25});
    }
  };
  EXPECT_EQ(go(0), -1.0);
}

}  // namespace
}  // namespace docent::collision_avoidance::old_sweeps_test
