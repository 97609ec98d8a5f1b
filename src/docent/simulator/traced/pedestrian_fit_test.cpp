#include "docent/simulator/traced/pedestrian_fit.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

/// An L of two halls, 20 x 6 m and 6 x 14 m.
World halls() {
  World world;
  world.floor = {{0, 0}, {20, 0}, {20, 6}, {6, 6}, {6, 20}, {0, 20}};
  world.operating_area = world.floor;
  world.entrances = {{10, 3}};
  world.home = {10, 3};
  return world;
}

/// People who walk straight through a hall of the given size.
Recording walkers(double length, double width, int count, std::uint64_t seed) {
  Rng rng{seed};
  Recording recording{"walkers", 100.0, {}};
  for (int i = 0; i < count; ++i) {
    Track track{rng.uniform(0.0, 80.0), {}};
    const double y = rng.uniform(0.0, width);
    for (double x = 0.0; x <= length; x += 0.5) track.points.push_back({x, y});
    recording.tracks.push_back(std::move(track));
  }
  return recording;
}

TEST(PedestrianFit, FindsTheHallThatHoldsEveryTrackWhateverTheTurn) {
  const World world = halls();
  const WalkableFloor floor{world};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Recording recording = walkers(17.0, 4.0, 30, seed);
    Rng rng{seed};
    const Pose2 moved{rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0), Angle::degrees(rng.uniform(0.0, 360.0))};
    for (Track& track : recording.tracks) {
      for (Point2& point : track.points) point = moved * point;
    }
    const PedestrianFit fit = fit_pedestrians(recording, floor);
    EXPECT_EQ(fit.recording.tracks.size(), 30U) << seed;
    EXPECT_EQ(fit.dropped, 0U);
    for (std::size_t i = 0; i < fit.recording.tracks.size(); ++i) {
      const Track& track = fit.recording.tracks[i];
      EXPECT_DOUBLE_EQ(track.start, recording.tracks[i].start);
      for (std::size_t k = 0; k < track.points.size(); ++k) {
        EXPECT_GE(floor.clearance(track.points[k]), kRecordedRadius - 0.01);
        // Rigid: what the fit says is what it did.
        const Point2 again = fit.world_from_recording * recording.tracks[i].points[k];
        EXPECT_NEAR(distance(again, track.points[k]), 0.0, 1e-6);
      }
    }
  }
}

TEST(PedestrianFit, DropsAndCountsWhatWalksThroughWalls) {
  const World world = halls();
  Recording recording = walkers(17.0, 4.0, 20, 9);
  for (int i = 0; i < 7; ++i) {
    Track across{0.0, {}};
    for (double y = -15.0; y <= 15.0; y += 0.5) across.points.push_back({3.0 + i, y});
    recording.tracks.push_back(across);
  }
  const PedestrianFit fit = fit_pedestrians(recording, WalkableFloor{world});
  EXPECT_EQ(fit.recording.tracks.size(), 20U);
  EXPECT_EQ(fit.dropped, 7U);
}

TEST(PedestrianFit, WhatIsTooLargeIsDroppedAltogether) {
  const PedestrianFit fit = fit_pedestrians(walkers(40.0, 4.0, 5, 1), WalkableFloor{halls()});
  EXPECT_TRUE(fit.recording.tracks.empty());
  EXPECT_EQ(fit.dropped, 5U);
}

TEST(PedestrianFit, KnowsWhereItsPeopleWalk) {
  const std::vector<Recording> recordings{{"one", 10.0, {{0.0, {{0, 0}, {0.5, 0}, {1.0, 0}}}}}};
  EXPECT_TRUE(is_walked_on({{0.7, 0.1}, {0.8, 0.1}, {0.8, 0.2}}, recordings));
  EXPECT_FALSE(is_walked_on({{0.7, 0.3}, {0.8, 0.3}, {0.8, 0.4}}, recordings));
  EXPECT_FALSE(is_walked_on({{1.3, -1}, {2, -1}, {2, 1}, {1.3, 1}}, recordings));
}

}  // namespace
}  // namespace docent::simulator
