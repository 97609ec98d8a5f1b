#include "docent/collision_avoidance/watches/odometry_watch.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance::odometry_watch_test {
namespace {

/// A base that follows its commands, and an odometry that tells of it every 50 ms.
struct Base {
  BaseLimits limits;
  OdometryWatch watch{limits};
  CommandHistory commands;
  BaseState state;
  BaseState told;
  double now = 0.0;  // [s]
  double late = 0.0;
  bool frozen = false;
  bool skips = false;

  void run(double duration, Velocity command) {
    for (const double end = now + duration; now < end; now += 0.05, ++count_) {
      const Time time = time_from_seconds(now);
      commands.add(time, command);
      state = advance(state, commands.at(time - seconds(limits.latency)), limits, 0.05);
      if (!frozen) told = state;
      if (skips && count_ % 2 == 0) continue;
      watch.receive(time, time - seconds(late), told, false, commands);
    }
    now -= 0.05;
  }
  [[nodiscard]] std::string reason() const {
    const auto found = watch.complaint(time_from_seconds(now));
    return found ? found->reason : "";
  }
  [[nodiscard]] double max_speed() const { return watch.complaint(time_from_seconds(now))->max_speed; }

 private:
  int count_ = 0;
};

TEST(OdometryWatch, StandingAndDrivingAreWell) {
  Base base;
  for (int i = 0; i < 40; ++i) {
    base.run(2.0, {0.1 * (i % 8), 0.2 * (i % 5 - 2)});
    EXPECT_EQ(base.reason(), "") << i;
    base.run(3.0, {});
    EXPECT_EQ(base.reason(), "") << i;
  }
}

TEST(OdometryWatch, FrozenIsWhatDoesNotMoveAlthoughItMust) {
  Base base;
  base.run(3.0, {0.5, 0.0});
  base.frozen = true;
  base.run(0.4, {0.5, 0.0});
  EXPECT_EQ(base.reason(), "the odometry is frozen");
  EXPECT_EQ(base.max_speed(), 0.0);
  base.run(9.0, {});
  EXPECT_EQ(base.reason(), "the odometry is frozen");
  EXPECT_GT(base.max_speed(), 0.0);  // tries again
  EXPECT_LT(base.max_speed(), 0.1);
  base.frozen = false;
  base.run(1.0, {0.06, 0.0});
  EXPECT_EQ(base.reason(), "");
}

TEST(OdometryWatch, FrozenInATurnOnTheSpot) {
  Base base;
  base.run(3.0, {0.0, 0.8});
  base.frozen = true;
  base.run(0.7, {0.0, 0.8});
  EXPECT_EQ(base.reason(), "the odometry is frozen");
}

TEST(OdometryWatch, MissingMessages) {
  Base base;
  base.run(3.0, {0.5, 0.0});
  base.skips = true;
  base.run(1.0, {0.5, 0.0});
  EXPECT_EQ(base.reason(), "odometry messages are missing");
  base.run(60.0, {0.5, 0.0});
  EXPECT_EQ(base.reason(), "odometry messages are missing") << "it must not get used to it";
  base.skips = false;
  base.run(3.0, {0.5, 0.0});
  EXPECT_EQ(base.reason(), "");
}

TEST(OdometryWatch, SilentLateAndJumped) {
  Base base;
  base.run(3.0, {0.5, 0.0});
  base.late = 0.3;
  base.run(1.0, {0.5, 0.0});
  EXPECT_EQ(base.reason(), "the odometry comes late");
  base.late = 0.0;
  base.run(1.0, {0.5, 0.0});
  base.now += 0.6;
  EXPECT_EQ(base.reason(), "no fresh odometry");
  EXPECT_EQ(base.max_speed(), 0.0);
  base.run(1.0, {0.5, 0.0});
  base.now += 0.05;
  base.watch.receive(time_from_seconds(base.now), time_from_seconds(base.now), base.state, true, base.commands);
  EXPECT_EQ(base.reason(), "the odometry jumped");
  base.run(4.0, {0.5, 0.0});
  EXPECT_EQ(base.reason(), "");
}

TEST(OdometryWatch, AJumpOfAStandingBaseDoesNotMakeItSeemFrozen) {
  Base base;
  base.run(2.0, {});
  base.now += 0.05;
  BaseState jumped = base.state;
  jumped.odom_from_base.x += 1.0;
  jumped.velocity.linear = 20.0;  // the step over 50 ms
  base.watch.receive(time_from_seconds(base.now), time_from_seconds(base.now), jumped, true, base.commands);
  base.state.odom_from_base = jumped.odom_from_base;
  base.now += 0.05;
  base.run(5.0, {});
  EXPECT_EQ(base.reason(), "");
}

}  // namespace
}  // namespace docent::collision_avoidance::odometry_watch_test
