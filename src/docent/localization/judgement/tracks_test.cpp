#include "docent/localization/judgement/tracks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/localization/judgement/beam_fit.h"
#include "docent/localization/judgement/view_matcher.h"

namespace docent::localization {
namespace {

constexpr double kRange = 10.0;  // [m]

/// A room of 12 x 6 m, the same after half a turn, but for a case near its right end when `with_case`.
OccupancyGrid room(bool with_case) {
  OccupancyGrid map;
  map.frame = {140, 80, 0.1, {-1.0, -1.0}};
  map.cells.assign(map.frame.size(), 100);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Point2 at{-1.0 + 0.1 * (static_cast<double>(i % 140) + 0.5),
                    -1.0 + 0.1 * (static_cast<double>(i / 140) + 0.5)};
    const bool floor = at.x > 0.0 && at.x < 12.0 && at.y > 0.0 && at.y < 6.0;
    const bool box = with_case && at.x > 9.5 && at.x < 11.0 && at.y > 1.0 && at.y < 2.5;
    if (floor && !box) map.cells[i] = 0;
  }
  return map;
}

sensor_models::RangeSweep sweep_from(const sensor_models::RayCaster& caster, const Pose2& pose) {
  sensor_models::RangeSweep sweep;
  for (int i = 0; i < 180; ++i) {
    sensor_models::SweepBeam beam;
    beam.bearing = (2.0 * i - 180.0) * std::numbers::pi / 180.0;
    beam.range =
        caster.cast(pose.position(), unit(pose.theta + Angle::radians(beam.bearing)), kRange, kRange).value_or(kRange);
    sweep.beams.push_back(beam);
  }
  return sweep;
}

const Pose2 kHere{4.0, 3.5, Angle::degrees(20)};
const Pose2 kTwin{8.0, 2.5, Angle::degrees(200)};

/// A robot that drives from kHere in a room, as odometry sees it.
class Drive {
 public:
  explicit Drive(bool with_case)
      : map_{room(with_case)}, caster_{map_}, places_{caster_, map_}, tracks_{TracksParams{}, {}, kRange, caster_} {}

  void look(bool is_startled = false) {
    tracks_.add_view(sweep_from(caster_, pose_), odom_, is_startled, std::nullopt);
  }
  /// What it sees where the map is wrong.
  void look_in(const sensor_models::RayCaster& world) {
    tracks_.add_view(sweep_from(world, pose_), odom_, false, std::nullopt);
  }
  void drive(const Pose2& step) {
    pose_ = pose_ * step;
    odom_ = odom_ * step;
  }
  [[nodiscard]] double share_near(const Pose2& pose) const {
    double share = 0.0;
    for (const Tracks::Place& place : tracks_.places(odom_))
      if (distance(place.map_from_robot.position(), pose.position()) < 0.5 &&
          std::abs((place.map_from_robot.theta - pose.theta).degrees()) < 15.0)
        share += place.share;
    return share;
  }
  /// The pose that looks the same after half a turn of the room.
  [[nodiscard]] static Pose2 twin_of(const Pose2& pose) {
    return {12.0 - pose.x, 6.0 - pose.y, pose.theta + Angle::degrees(180.0)};
  }

  OccupancyGrid map_;
  sensor_models::RayCaster caster_;
  PlaceSearch places_;
  Tracks tracks_;
  Pose2 pose_ = kHere;
  Pose2 odom_;
};

TEST(Tracks, ATwinThatNothingSpeaksAgainstKeepsItsShareHoweverFarTheRobotDrives) {
  Drive drive{false};
  for (int i = 0; i < 30; ++i) {
    drive.look();
    if (i == 0) drive.tracks_.search(drive.places_);
    drive.drive({i % 10 < 5 ? 0.4 : -0.4, 0.0, Angle::degrees(3.0)});
  }
  EXPECT_GT(drive.share_near(drive.pose_), 0.3);
  EXPECT_GT(drive.share_near(Drive::twin_of(drive.pose_)), 0.3);
}

TEST(Tracks, TurningOnOneSpotForMinutesSaysNoMoreThanTurningOnce) {
  const sensor_models::RayCaster world{room(false)};  // the case is gone
  Drive drive{true};
  drive.pose_ = {5.0, 3.8, {}};
  const auto turn = [&](int views) {
    for (int i = 0; i < views; ++i) {
      drive.drive({0.0, 0.0, Angle::degrees(31.0)});
      drive.look_in(world);
    }
    return drive.share_near(drive.pose_);
  };
  drive.look_in(world);
  drive.tracks_.take_in(std::vector{drive.pose_, Drive::twin_of(drive.pose_)});
  const double at_first = turn(60);
  EXPECT_GT(at_first, 0.05) << "what the map has wrong tells one place of the other only so far";
  EXPECT_NEAR(turn(1000), at_first, 0.5 * at_first);
}

TEST(Tracks, WhatStandsInTheWayOfOneTellsTheTwinsApart) {
  Drive drive{true};
  for (int i = 0; i < 6; ++i) {
    drive.look();
    if (i == 0) drive.tracks_.search(drive.places_);
    drive.drive({0.4, 0.0, {}});
  }
  EXPECT_GT(drive.share_near(drive.pose_), 0.9);
  EXPECT_LT(drive.share_near(Drive::twin_of(drive.pose_)), 0.05);
}

TEST(Tracks, APlaceThatIsFoundLateIsFollowedBackThroughAllThatWasSeen) {
  Drive drive{true};
  const Pose2 twin = Drive::twin_of(drive.pose_);
  drive.look();
  drive.tracks_.take_in(std::vector{twin});
  for (int i = 0; i < 6; ++i) {
    drive.drive({0.4, 0.0, {}});
    drive.look();
  }
  EXPECT_EQ(drive.share_near(drive.pose_), 0.0);
  drive.tracks_.search(drive.places_);
  EXPECT_GT(drive.share_near(drive.pose_), 0.9);
}

TEST(Tracks, AGivenStartIsAPriorThatEvidenceOverturns) {
  Drive drive{true};
  const BeliefMode wrong{Drive::twin_of(drive.pose_), {0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.01}, 1.0};
  drive.tracks_.start_at({&wrong, 1}, drive.odom_);
  drive.look();
  drive.tracks_.search(drive.places_);
  EXPECT_GT(drive.share_near(Drive::twin_of(drive.pose_)), 0.5);  // a case that the robot does not see may be gone
  for (int i = 0; i < 20; ++i) {
    drive.drive({i % 10 < 5 ? 0.4 : -0.4, 0.0, Angle::degrees(9.0)});
    drive.look();
  }
  EXPECT_GT(drive.share_near(drive.pose_), 0.9);
}

TEST(Tracks, WhereTwoPlacesLookTheSameTheGivenOneIsKept) {
  Drive drive{false};
  const BeliefMode right{drive.pose_, {0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.01}, 1.0};
  drive.tracks_.start_at({&right, 1}, drive.odom_);
  drive.look();
  drive.tracks_.search(drive.places_);
  EXPECT_GT(drive.share_near(drive.pose_), 0.99);
}

TEST(Tracks, ARobotThatWasCarriedOffIsFoundWhereItIsNow) {
  Drive drive{true};
  for (int i = 0; i < 5; ++i) {
    drive.look();
    if (i == 0) drive.tracks_.search(drive.places_);
    drive.drive({0.4, 0.0, {}});
  }
  drive.pose_ = {2.0, 4.5, Angle::degrees(-60.0)};  // odometry tells nothing of it
  EXPECT_FALSE(drive.tracks_.is_due(drive.odom_ * Pose2{-0.2, 0.0, {}}, false));
  EXPECT_TRUE(drive.tracks_.is_due(drive.odom_, true));
  drive.look(true);
  EXPECT_TRUE(drive.tracks_.is_search_due(true, false));
  drive.tracks_.search(drive.places_);
  for (int i = 0; i < 4; ++i) {
    drive.drive({0.4, 0.0, Angle::degrees(20.0)});
    drive.look();
  }
  EXPECT_GT(drive.share_near(drive.pose_), 0.9);
}

TEST(PartSums, WhatOnePartHasWrongCountsOnce) {
  PartSums sums{10.0};
  const std::vector<PartCost> wrong(40, PartCost{part_at({0.1, 0.1}, 0.5, true), 1.0F});
  sums.add(wrong);
  const double once = sums.walls();
  EXPECT_NEAR(once, 0.8, 1e-6);  // 40 of 40 + 10
  for (int i = 0; i < 20; ++i) sums.add(wrong);
  EXPECT_LT(sums.walls(), 1.0);
  const std::vector<PartCost> elsewhere(40, PartCost{part_at({5.1, 0.1}, 0.5, true), 1.0F});
  sums.add(elsewhere);
  EXPECT_GT(sums.walls(), 1.7);
  sums.take_out(elsewhere);
  for (int i = 0; i < 20; ++i) sums.take_out(wrong);
  EXPECT_NEAR(sums.walls(), once, 1e-6);
}

TEST(PartSums, WallsAndFloorAreDifferentParts) {
  EXPECT_NE(part_at({0.1, 0.1}, 0.5, true), part_at({0.1, 0.1}, 0.5, false));
  EXPECT_NE(part_at({0.1, 0.1}, 0.5, true), part_at({-0.1, 0.1}, 0.5, true));
  EXPECT_EQ(part_at({0.1, 0.1}, 0.5, true), part_at({0.4, 0.4}, 0.5, true));
}

TEST(BeamCosts, WhatFitsCostsNothingAndWhatDoesNotCosts) {
  const sensor_models::RayCaster caster{room(true)};
  const auto sweep = sweep_from(caster, kHere);
  const auto sum = [&](const Pose2& pose) {
    double total = 0.0;
    for (const PartCost& cost : beam_costs(caster, sweep, pose, {})) total += static_cast<double>(cost.cost);
    return total;
  };
  EXPECT_LT(sum(kHere), 1.0);
  EXPECT_GT(sum(kTwin), 3.0);  // the case
  EXPECT_GT(sum(kHere * Pose2{1.5, 0.0, Angle::degrees(40)}), 60.0);
}

TEST(ViewMatcher, FindsThePoseNearAGuess) {
  const sensor_models::RayCaster caster{room(true)};
  const auto sweep = sweep_from(caster, kHere);
  const Pose2 found = matched(caster, sweep, kRange, {4.15, 3.4, Angle::degrees(23.0)}, {0.15, 0.05});
  EXPECT_LT(distance(found.position(), kHere.position()), 0.1);
  EXPECT_LT(std::abs((found.theta - kHere.theta).degrees()), 1.0);
  const Pose2 guess{4.0, 3.4, {}};
  EXPECT_EQ(matched(caster, {}, kRange, guess, {0.1, 0.05}).x, guess.x);  // nothing seen: the guess
}

TEST(TracksParams, RefuseWhatMakesNoSense) {
  EXPECT_TRUE(TracksParams{}.validate().has_value());
  TracksParams params;
  params.most_tracks = 0;
  EXPECT_FALSE(params.validate().has_value());
  params = {};
  params.nats = -1.0;
  EXPECT_FALSE(params.validate().has_value());
}

}  // namespace
}  // namespace docent::localization
