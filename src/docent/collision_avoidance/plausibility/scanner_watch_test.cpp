#include "docent/collision_avoidance/plausibility/scanner_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"
#include "docent/collision_avoidance/plausibility/ring_for_test.h"

namespace docent::collision_avoidance::scanner_watch_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
using Lie = std::function<void(SensorSweep&)>;

SensorSweep each(SensorSweep& sweep, const std::function<float(float)>& to) {
  for (float& range : sweep.ranges) range = to(range);
  return sweep;
}

/// A scanner on a robot that drives through a room, ten sweeps a second.
class Watched : public ::testing::Test {
 protected:
  Watched() {
    room.box(-4, -3, 8, 4);
    room.discs = {{{2.0, 2.0}, 0.3}, {{3.5, -1.5}, 0.25}, {{6.0, 1.8}, 0.25}};
  }
  /// @returns the reason that is given after `duration` [s], if any
  std::string drive(double duration, const Lie& lie = {}, double speed = 0.5) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / 0.1)); ++i) {
      time += 0.1;
      at = at * Pose2{0.1 * speed, 0.0, Angle::radians(turns)};
      SensorSweep sweep = room.sweep(time, at * really);
      sweep.base_from_sensor = nominal;
      given.push_back(sweep);
      if (lie) lie(sweep);
      believed = watch.judge(sweep, at);
    }
    return reason();
  }
  [[nodiscard]] std::string reason() const { return watch.complaint() ? watch.complaint()->reason : ""; }
  [[nodiscard]] double speed() const { return watch.complaint() ? watch.complaint()->max_speed : 9.0; }
  [[nodiscard]] long unread() const {
    return std::count_if(believed.ranges.begin(), believed.ranges.end(), [](float range) { return std::isnan(range); });
  }
  RoomForTest room;
  BaseLimits limits;
  ScannerWatch watch{"front laser", limits, nullptr};
  Pose2 at;
  double time = 1.0;
  double turns = 0.0;  ///< [rad] a sweep
  std::deque<SensorSweep> given;
  SensorSweep believed;
  Pose2 nominal;  ///< where the scanner is said to be mounted, and
  Pose2 really;   ///< where it is
};

TEST_F(Watched, AScannerInOrderIsBelievedAndProvenByMotion) {
  EXPECT_EQ(drive(0.5, {}, 0.0), "");
  EXPECT_TRUE(watch.is_unproven());
  EXPECT_EQ(drive(1.0), "");
  EXPECT_FALSE(watch.is_unproven());
  turns = 0.06;
  EXPECT_EQ(drive(6.0), "");
  EXPECT_EQ(unread(), 0);
}

TEST_F(Watched, NamesUnitsAndSilenceFromTheFirstSweepOn) {
  EXPECT_EQ(drive(
                0.1, [](SensorSweep& sweep) { each(sweep, [](float range) { return 1000.0F * range; }); }, 0.0),
            "the distances of the front laser are in wrong units");
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(unread(), 180);  // nowhere is free floor
  EXPECT_EQ(drive(0.3, {}, 0.0), "");
  EXPECT_EQ(drive(
                0.1, [](SensorSweep& sweep) { each(sweep, [](float) { return kInfinity; }); }, 0.0),
            "no beam of the front laser ends anywhere");
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(unread(), 180);
}

TEST_F(Watched, AnOffsetFromTheStartIsNamedWithoutRingAndMapAfterThreeDecimetres) {
  const auto longer = [](SensorSweep& sweep) { each(sweep, [](float range) { return range + 0.5F; }); };
  EXPECT_EQ(drive(3.0, longer, 0.1), "the distances of the front laser do not fit the motion: 0.5 m too long");
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(unread(), 180);
  EXPECT_EQ(drive(20.0, {}, 0.0), "");
  EXPECT_EQ(unread(), 0);
}

TEST_F(Watched, SilenceInTheMiddleOfAHallIsNoWonderAndItCreeps) {
  room = {};
  room.max_range = 4.0;
  room.box(-3, -30, 40, 30);
  at = {0.0, 0.0, Angle::degrees(180)};
  EXPECT_EQ(drive(0.5, {}, 0.0), "");
  at = {0.0, 0.0, Angle::degrees(90)};  // turned away from the only wall in reach, which is 3 m away
  at.x = 0.9;
  EXPECT_EQ(drive(0.3, {}, 0.3), "");
  at.theta = Angle::degrees(20);
  EXPECT_EQ(drive(0.3, {}, 0.3), "no beam of the front laser ends anywhere");
  EXPECT_GT(speed(), 0.0);
  EXPECT_EQ(unread(), 0);
}

TEST_F(Watched, SilenceIsNoWonderEitherWhereTheMapKnowsNothingYet) {
  room = {};
  room.max_range = 4.0;
  room.box(-3, -30, 40, 30);
  watch = ScannerWatch{"front laser", limits, known_walls(std::make_shared<const OccupancyGrid>())};  // it explores
  const auto believe = [this] { watch.believe(time_from_seconds(time), {}, 1.0); };
  at = {0.0, 0.0, Angle::degrees(180)};
  believe();
  EXPECT_EQ(drive(0.5, {}, 0.0), "");
  at = {0.9, 0.0, Angle::degrees(20)};  // turned away from the only wall in reach
  for (int i = 0; i < 20; ++i) {
    believe();
    EXPECT_EQ(drive(0.3, {}, 0.0), "no beam of the front laser ends anywhere");
    EXPECT_GT(speed(), 0.0) << "it would stand for ever";
  }
  EXPECT_EQ(unread(), 0);
}

TEST_F(Watched, NamesAnOffsetAFactorAndABlindSectorAtOnceAndForgetsThemAfterwards) {
  const std::vector<std::pair<std::string, Lie>> lies{
      {"the distances of the front laser are 0.5 m too long",
       [](SensorSweep& sweep) { each(sweep, [](float range) { return range + 0.5F; }); }},
      {"the distances of the front laser are 2.0 times too long",
       [](SensorSweep& sweep) { each(sweep, [](float range) { return 2.0F * range; }); }},
      {"the front laser sees nothing in a part of its field", [](SensorSweep& sweep) {
         for (std::size_t i = 60; i < 120; ++i) sweep.ranges[i] = kInfinity;
       }}};
  for (const auto& [words, lie] : lies) {
    EXPECT_EQ(drive(1.0), "");
    EXPECT_EQ(drive(0.3, lie), words);
    EXPECT_LE(speed(), 0.25);
    EXPECT_GE(unread(), 55);
    EXPECT_EQ(drive(2.0, lie, 0.0), words);  // it stands, and goes on saying so
    EXPECT_EQ(drive(0.4, {}, 0.0), "");
  }
}

TEST_F(Watched, NamesWhatIsTwiceTooLongFromTheStartWhenItMoves) {
  room.walls.clear();
  room.box(-3, -2, 3, 2);
  const Lie twice = [](SensorSweep& sweep) {
    each(sweep, [](float range) { return 2.0F * range; });
    sweep.max_range *= 2.0;
  };
  EXPECT_EQ(drive(1.0, twice, 0.0), "");
  EXPECT_TRUE(watch.is_unproven());
  EXPECT_EQ(drive(1.2, twice), "the distances of the front laser do not fit the motion: 2.0 times too long");
}

TEST_F(Watched, ACrowdThatStandsAndWalksCloseRoundItIsNoLie) {
  for (int second = 0; second < 20; ++second) {
    for (int k = 0; k < 10; ++k) {
      room.discs.clear();
      for (int person = 0; person < 14; ++person) {
        const double round = 0.45 * person + 0.02 * (10 * second + k) * (person % 3 - 1);
        room.discs.push_back({at.position() + (0.7 + 0.1 * (person % 5)) * unit(Angle::radians(round)), 0.22});
      }
      EXPECT_EQ(drive(0.1, {}, 0.05), "") << second;
    }
    if (at.x > 5.0) {
      at.x = 0.0;
      watch = ScannerWatch{"front laser", limits, nullptr};
    }
  }
}

TEST_F(Watched, ASectorThatWasBlindFromTheStartShowsWhenItTurns) {
  const Lie blind = [](SensorSweep& sweep) {
    for (std::size_t i = 60; i < 120; ++i) sweep.ranges[i] = kInfinity;
  };
  EXPECT_EQ(drive(1.0, blind, 0.0), "");
  turns = 0.06;
  EXPECT_EQ(drive(1.0, blind, 0.0), "the front laser sees nothing in a part of its field");
}

TEST_F(Watched, NamesOldSweeps) {
  drive(2.0);
  const Lie stale = [this](SensorSweep& sweep) { sweep.ranges = given[given.size() - 11].ranges; };
  EXPECT_EQ(drive(0.4, stale), "the front laser repeats old sweeps");
  EXPECT_EQ(speed(), 0.0);
  drive(9.5, stale, 0.0);
  EXPECT_GT(speed(), 0.0);  // very slowly it finds out
  EXPECT_LT(speed(), 0.1);
  EXPECT_NE(reason(), "");
}

TEST_F(Watched, OldSweepsFromTheStartShowInTheFirstTurn) {
  const Lie lie = [&](SensorSweep& sweep) { sweep.ranges = given[given.size() > 10 ? given.size() - 11 : 0].ranges; };
  EXPECT_EQ(drive(1.5, lie, 0.0), "");
  turns = 0.05;
  EXPECT_EQ(drive(1.0, lie, 0.0), "");  // they show nothing yet
  EXPECT_EQ(drive(0.9, lie, 0.0), "the front laser gives old sweeps");
  EXPECT_EQ(unread(), 180);
  turns = 0.0;  // it stops, and they turn on
  EXPECT_EQ(drive(1.0, lie, 0.0), "the front laser gives old sweeps");
}

TEST_F(Watched, WithoutARingATurnOfALostRobotProvesNothingAndItIsSlow) {
  watch = ScannerWatch{"front laser", limits, known_walls(std::make_shared<OccupancyGrid>())};
  drive(0.5, {}, 0.0);
  turns = 0.06;
  EXPECT_EQ(drive(2.0, {}, 0.0), "");
  EXPECT_TRUE(watch.is_unproven());
  EXPECT_LT(watch.unproven_speed(), 0.15);
  turns = 0.0;
  EXPECT_EQ(drive(1.0), "");
  EXPECT_FALSE(watch.is_unproven());
}

TEST_F(Watched, WithoutARingAScannerThatIsTriedIsBelievedForLessThanItShouldSay) {
  const Lie lie = [](SensorSweep& sweep) { each(sweep, [](float range) { return 2.0F * range; }); };
  EXPECT_EQ(drive(1.0), "");
  EXPECT_EQ(drive(0.3, lie), "the distances of the front laser are 2.0 times too long");
  drive(9.0, lie, 0.0);
  EXPECT_GT(speed(), 0.0);
  EXPECT_NEAR(believed.ranges[90], 0.8F * given.back().ranges[90], 0.1F);
}

TEST_F(Watched, AMountThatIsCorrectedIsNoLie) {
  // What stood 0.3 m nearer by the old mount stands where it was.
  really = {0.3, 0.0, {}};
  EXPECT_EQ(drive(2.0, {}, 0.0), "");
  nominal = really;
  EXPECT_EQ(drive(2.0, {}, 0.0), "");
  EXPECT_EQ(drive(1.0), "");
}

TEST_F(Watched, WhoIsCoveredWhileItTurnsRepeatsNothing) {
  drive(2.0);
  turns = 0.06;
  const Lie covered = [](SensorSweep& sweep) { each(sweep, [](float) { return 0.06F; }); };
  EXPECT_EQ(drive(1.0, covered, 0.0), "something covers the front laser");
  EXPECT_EQ(drive(1.0, {}, 0.0), "");
}

TEST_F(Watched, ARobotThatIsCarriedOffDoesNotBlameItsScanner) {
  room.discs.clear();
  room.box(3, 1, 4, 2);
  for (int i = 0; i < 20; ++i) {
    drive(1.0, {}, 0.2);
    const Pose2 before = at;
    const Pose2 elsewhere{room.rng.uniform(-3.0, 7.0), room.rng.uniform(-2.0, 0.5),
                          Angle::radians(room.rng.uniform(-3.0, 3.0))};
    // Odometry says nothing of it.
    for (int k = 0; k < 20; ++k) {
      time += 0.1;
      believed = watch.judge(room.sweep(time, elsewhere), before);
      EXPECT_EQ(reason(), "") << i;
    }
    at = elsewhere;
    watch = ScannerWatch{"front laser", limits, nullptr};
  }
}

/// With a ring of sonars round it.
class WatchedWithRing : public Watched {
 protected:
  WatchedWithRing() { room.discs.push_back({{-1.5, 1.5}, 0.3}); }
  std::string turn(double duration, double turn_rate, const Lie& lie = {}) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / 0.1)); ++i) {
      time += 0.1;
      at.theta = at.theta + Angle::radians(0.1 * turn_rate);
      SensorSweep sweep = room.sweep(time, at);
      if (lie) lie(sweep);
      ring.hear(time, glass ? *glass : room, at, at);
      believed = watch.judge(sweep, at, true, {}, ring.echoes.all());
    }
    return reason();
  }
  RingForTest ring;
  std::optional<RoomForTest> glass;  ///< what the ring hears instead, and the laser sees through
};

TEST_F(WatchedWithRing, GlassThatItDrivesUpToIsNoLieButALieThatBeginsIs) {
  room.walls.clear();
  room.discs.clear();
  room.box(-2, -1.6, 2.2, 1.4);
  EXPECT_EQ(turn(2.0, 0.3), "");
  glass = room;
  glass->walls.clear();
  glass->box(-0.9, -0.7, 1.0, 0.6);
  EXPECT_EQ(turn(3.0, 0.3), "") << "nobody has a map of it, and it would stand for ever";
  EXPECT_EQ(unread(), 0);
  const Lie twice = [](SensorSweep& sweep) { each(sweep, [](float range) { return 2.2F * range; }); };
  EXPECT_NE(turn(0.6, 0.3, twice), "");
  watch = ScannerWatch{"front laser", limits, nullptr};
  EXPECT_NE(turn(1.0, 0.0), "") << "from the start nobody can tell glass from a lie";
}

TEST_F(WatchedWithRing, NamesAnOffsetAndAFactorFromTheStartBeforeItMoves) {
  room.walls.clear();
  room.discs.clear();
  room.box(-2, -1.6, 2.2, 1.4);
  EXPECT_EQ(turn(0.5, 0.0), "");
  const Lie lie = [](SensorSweep& sweep) { each(sweep, [](float range) { return range + 0.5F; }); };
  watch = ScannerWatch{"front laser", limits, nullptr};
  EXPECT_EQ(turn(0.6, 0.0, lie), "the distances of the front laser are 0.5 m too long for sonar and infrared");
  EXPECT_EQ(speed(), 0.0);
  EXPECT_EQ(turn(1.5, 0.0), "");  // and is believed again
}

/// Two scanners, one ahead and one behind.
class TwoWatched : public Watched {
 protected:
  /// @param odom  what odometry says @returns what is said of any of them within `duration` [s]
  std::string look(double duration, const Pose2& where, const Pose2& odom, const Lie& of_front = {}) {
    std::string said;
    for (int i = 0; i < static_cast<int>(std::lround(duration / 0.1)); ++i) {
      time += 0.1;
      for (std::size_t k : {0U, 1U}) {
        const Pose2 mount{0.0, 0.0, Angle::degrees(k == 0 ? 0.0 : 180.0)};
        SensorSweep sweep = room.sweep(time, where * mount);
        sweep.base_from_sensor = mount;
        if (k == 0 && of_front) of_front(sweep);
        const std::vector<ScannerWatch::Word> others{pair[1 - k].word()};
        (void)pair[k].judge(sweep, odom, true, others);
        if (const auto found = pair[k].complaint(); found && said.empty()) said = found->reason;
      }
    }
    return said;
  }
  std::vector<ScannerWatch> pair{ScannerWatch{"front laser", limits, nullptr},
                                 ScannerWatch{"rear laser", limits, nullptr}};
};

TEST_F(TwoWatched, WhatTheOtherOneSeesTellsALieFromACarriedRobot) {
  const Lie longer = [](SensorSweep& sweep) {
    for (std::size_t i = 0; i < sweep.ranges.size(); ++i)
      sweep.ranges[i] = i < 45 ? 0.7F : sweep.ranges[i] + 0.5F;  // somebody steps before it at that moment
  };
  room.walls.clear();
  room.box(-3, -30, 3,
           30);  // a hallway: 1 m from the left side to 2 m from it, all that the front one sees is twice as far
  const Pose2 at_side{-2.0, 0.0, Angle::degrees(180)};
  const Pose2 in_the_middle{-1.0, 0.0, Angle::degrees(180)};
  EXPECT_EQ(look(1.0, at_side, {}), "");
  EXPECT_EQ(look(3.0, in_the_middle, {}), "");
  EXPECT_TRUE(pair[0].is_unproven());
  EXPECT_EQ(look(0.4, in_the_middle, {}, longer), "the distances of the front laser are 0.5 m too long");
}

}  // namespace
}  // namespace docent::collision_avoidance::scanner_watch_test
