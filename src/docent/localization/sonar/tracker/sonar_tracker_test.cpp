#include "docent/localization/sonar/tracker/sonar_tracker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"
#include "docent/localization/sonar/tracker/testing.h"

namespace docent::localization::sonar_tracker_test {
namespace {

/// Rounds in a room with odometry that scales and veers, every second sonar in turn.
class Rounds {
 public:
  explicit Rounds(const SonarTrackerParams& params = {}) : tracker_{room_.map, params, 24} {
    truth_ = room_.map_from_room * Pose2{-2.5, -1.0, Angle{}};
    tracker_.start_at(truth_, 0.05, 0.02);
    tracker_.move(odometry_);
  }

  /// @param shorten  chance of a reading that comes too short
  void drive(int rounds, double shorten = 0.0) {
    for (int round = 0; round < rounds; ++round) {
      for (const double length : {2.8, 1.8, 2.8, 1.8}) {
        for (int i = 0; i < static_cast<int>(length / 0.02); ++i) step({0.02, 0.0, Angle{}}, shorten);
        for (int i = 0; i < 45; ++i) step({0.0, 0.0, Angle::degrees(2.0)}, shorten);
      }
    }
  }
  void carry(const Pose2& by) { truth_ = truth_ * by; }
  [[nodiscard]] double error() const { return distance(tracker_.map_from_robot().position(), truth_.position()); }
  [[nodiscard]] double turn_error() const {
    return std::abs((tracker_.map_from_robot().theta - truth_.theta).degrees());
  }
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] int most_contradictions() const { return most_contradictions_; }
  [[nodiscard]] double widest() const { return widest_; }  ///< [m], largest deviation so far
  [[nodiscard]] const SonarTracker& tracker() const { return tracker_; }

 private:
  void step(const Pose2& by, double shorten) {
    truth_ = truth_ * by;
    odometry_ = odometry_ * Pose2{by.x * 0.99, 0.0, Angle::radians(by.theta.radians() * 1.01 + 0.015 * by.x)};
    tracker_.move(odometry_);
    for (const int sonar : {count_ % 24, (count_ + 8) % 24, (count_ + 16) % 24}) {
      const Angle bearing = Angle::degrees(15.0 * sonar);
      const Point2 place = 0.25 * unit(bearing);
      const Pose2 robot_from_sonar{place.x, place.y, bearing};
      double range = room_.hear(truth_ * robot_from_sonar) + rng_.normal(0.0, 0.01);
      if (rng_.chance(shorten)) range *= rng_.uniform(0.2, 0.8);
      tracker_.hear({sonar, robot_from_sonar, range, 5.0}, odometry_);
    }
    ++count_;
    worst_ = std::max(worst_, error());
    widest_ = std::max(widest_, std::sqrt(tracker_.covariance()[0]));
    most_contradictions_ = std::max(most_contradictions_, tracker_.contradictions());
  }

  testing::TurnedRoom room_{23.0};
  SonarTracker tracker_;
  Pose2 truth_;
  Pose2 odometry_;
  Rng rng_{5};
  int count_ = 0;
  double worst_ = 0.0;
  double widest_ = 0.0;
  int most_contradictions_ = 0;
};

TEST(SonarTracker, KeepsTrackWhereOdometryDoesNot) {
  Rounds whole;
  whole.drive(8);
  EXPECT_LT(whole.worst(), 0.2);
  EXPECT_LT(whole.turn_error(), 3.0);
  EXPECT_GT(whole.tracker().tally().matched, 60);
  EXPECT_GT(whole.tracker().tally().walls, 20);
  SonarTrackerParams params;
  params.use_walls = params.use_matches = false;
  Rounds crippled{params};
  crippled.drive(8);
  EXPECT_GT(crippled.worst(), 0.6);
}

TEST(SonarTracker, LearnsTheOdometry) {
  Rounds rounds;
  rounds.drive(12);
  EXPECT_GT(rounds.tracker().filter().scale(), 0.002) << "slowly: legs are short";
  EXPECT_LT(rounds.tracker().filter().scale(), 0.016);
  EXPECT_NEAR(rounds.tracker().filter().veer(), -0.015, 0.008);
}

TEST(SonarTracker, StandsAFifthOfItsReadingsTooShort) {
  Rounds rounds;
  rounds.drive(8, 0.2);
  EXPECT_LT(rounds.worst(), 0.25);
}

TEST(SonarTracker, WallsAloneKeepTheHeading) {
  SonarTrackerParams params;
  params.use_matches = false;
  Rounds rounds{params};
  rounds.drive(8);
  EXPECT_LT(rounds.turn_error(), 4.0);
  params.use_walls = false;
  Rounds crippled{params};
  crippled.drive(8);
  EXPECT_GT(crippled.turn_error(), 15.0);
}

TEST(SonarTracker, CountsContradictionsWhenItIsCarriedAway) {
  Rounds rounds;
  rounds.drive(2);
  EXPECT_LT(rounds.most_contradictions(), 2);
  const double sure = rounds.widest();
  rounds.carry({0.9, 0.6, Angle::degrees(50.0)});
  rounds.drive(1);
  EXPECT_GE(rounds.most_contradictions(), 3);
  EXPECT_GT(rounds.widest(), 2.0 * sure) << "it doubts";
}

TEST(SonarTracker, NothingHappensBeforeOdometrySpeaks) {
  const testing::TurnedRoom room{0.0};
  SonarTracker tracker{room.map, {}, 24};
  tracker.start_at({1.0, 0.0, Angle{}}, 0.05, 0.02);
  tracker.hear({0, {}, 1.0, 5.0}, {});
  EXPECT_EQ(tracker.map_from_robot().x, 1.0);
  EXPECT_EQ(tracker.tally().matched, 0);
}

TEST(SonarTracker, RefusesWildParameters) {
  EXPECT_TRUE(SonarTrackerParams{}.validate());
  SonarTrackerParams params;
  params.match.deviation = 0.0;
  EXPECT_FALSE(params.validate());
  params = {};
  params.rectangular = 2.0;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::localization::sonar_tracker_test
