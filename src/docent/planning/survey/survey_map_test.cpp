#include "docent/planning/survey/survey_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/planning/survey/testing.h"

namespace docent::planning::survey_map_test {
namespace {

SurveyMap map_of_robot() { return {{}, {.reach = 12.0, .empty_reach = 5.0, .free = 0.25, .fewest_hits = 2}, 0.265}; }

/// What the robot sees at `pose` in the room, of which odometry knows `odom`.
Keyframe moment_at(const Pose2& pose, const Pose2& odom, double at_s) {
  collision_avoidance::BaseHistory odometry;
  odometry.add(time_from_seconds(at_s), {odom, {}});
  Keyframes keyframes{{}, {}, testing::two_lasers()};
  for (std::size_t laser : {0U, 1U}) {
    const auto ranges = testing::ranges_in_room(pose * testing::two_lasers()[laser]);
    keyframes.keep(laser, time_from_seconds(at_s), testing::reading_of(ranges));
  }
  return keyframes.take(odometry, {}).value();
}

TEST(SurveyMap, ItIsKnownAsSoonAsItIsLookedAt) {
  SurveyMap map = map_of_robot();
  map.follow();
  map.look();
  EXPECT_TRUE(map.seen().cells.empty());
  EXPECT_EQ(map.known_m2(), 0.0);
  for (int i = 0; i < 8; ++i) {
    const Pose2 pose{1.5 + 0.25 * i, 2.0, {}};
    const Pose2 found = map.add(moment_at(pose, pose, i));
    EXPECT_LT(distance(found.position(), pose.position()), 0.05);
  }
  EXPECT_TRUE(map.seen().cells.empty()) << "nobody has looked yet";
  map.follow();
  map.look();
  EXPECT_NEAR(map.known_m2(), 24.0, 2.0);
  EXPECT_EQ(map.known_m2(), free_area(map.drawn()));
  EXPECT_TRUE(map.seen().is_free(map.seen().frame.cell_at({3.0, 2.0})));
}

TEST(SurveyMap, ScansCorrectOdometry) {
  SurveyMap map = map_of_robot();
  Pose2 found;
  for (int i = 0; i < 12; ++i) {
    const Pose2 pose{1.5 + 0.25 * i, 2.0, {}};
    found = map.add(moment_at(pose, {1.5 + 0.25 * i, 2.0 + 0.02 * i, {}}, i));
  }
  EXPECT_NEAR(found.y, 2.0, 0.06) << "odometry is 22 cm off";
  map.lie({10.0, 0.0, {}});
  const std::vector<Point2> trail = map.trail();
  ASSERT_EQ(trail.size(), 12U);
  for (std::size_t i = 0; i < trail.size(); ++i)
    EXPECT_LT(distance(trail[i], {11.5 + 0.25 * static_cast<double>(i), 2.0}), 0.08);
}

TEST(SurveyMap, IsMadeOnceMoreInTheEnd) {
  SurveyMap map = map_of_robot();
  for (int i = 0; i < 12; ++i) {
    const Pose2 pose{1.5 + 0.25 * i, 2.0, {}};
    (void)map.add(moment_at(pose, pose, i));
  }
  const auto finished = map.finish({0.265, 0.5});
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_EQ(finished->map_from_base.size(), 12U);
  EXPECT_NEAR(free_area(finished->map), 24.0, 2.0);
  EXPECT_EQ(map.known_m2(), free_area(finished->map));
  EXPECT_TRUE(finished->map.is_occupied(finished->map.frame.cell_at({6.02, 2.0})));
}

TEST(SurveyMap, FloorInSmallPiecesWasSeenByStrayBeams) {
  SurveyMap map = map_of_robot();
  for (int i = 0; i < 12; ++i) (void)map.add(moment_at({1.5 + 0.25 * i, 2.0, {}}, {1.5 + 0.25 * i, 2.0, {}}, i));
  const auto finished = map.finish({0.265, 1000.0});
  ASSERT_TRUE(finished) << finished.error().message;
  EXPECT_EQ(free_area(finished->map), 0.0);
}

TEST(FreeArea, CountsFreeCellsOnly) {
  OccupancyGrid map;
  map.frame = {3, 2, 0.5, {}};
  map.cells = {0, 0, 100, -1, 0, 30};
  EXPECT_NEAR(free_area(map), 3 * 0.25, 1e-12);
}

}  // namespace
}  // namespace docent::planning::survey_map_test
