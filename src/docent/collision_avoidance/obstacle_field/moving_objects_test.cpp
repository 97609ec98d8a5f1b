#include "docent/collision_avoidance/obstacle_field/moving_objects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::collision_avoidance::moving_objects_test {
namespace {

constexpr double kBeam = std::numbers::pi / 180.0;

/// One sweep from the origin: ranges [m] of consecutive beams from `first` on; 0: nothing there.
std::vector<MovingObjects::Cluster> clusters_of(const std::vector<double>& sweep, int first = -10) {
  std::vector<Point2> points;
  std::vector<double> ranges;
  std::vector<int> beams;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    if (sweep[i] == 0.0) continue;
    const int beam = first + static_cast<int>(i);
    points.push_back(sweep[i] * unit(Angle::radians(beam * kBeam)));
    ranges.push_back(sweep[i]);
    beams.push_back(beam);
  }
  return MovingObjects{}.find(points, ranges, beams, kBeam);
}

TEST(MovingObjects, WhatIsSlimAndStandsFreeIsFound) {
  const auto found = clusters_of({4, 4, 4, 2, 2, 2, 4, 4, 0, 0, 0, 3, 3, 0, 0});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 3U);
  EXPECT_EQ(found[0].count, 3U);
  EXPECT_NEAR(norm(found[0].centre), 2.0, 0.01);
  EXPECT_NEAR(found[0].width, 2.0 * 2.0 * std::sin(kBeam), 1e-9);
  EXPECT_EQ(found[1].count, 2U);
  EXPECT_EQ(found[1].velocity, Point2{});
}

TEST(MovingObjects, ALoneReadingAWallAndWhatIsSeenThroughAGapAreNot) {
  EXPECT_TRUE(clusters_of({4, 4, 2, 4, 4}).empty());
  EXPECT_TRUE(clusters_of(std::vector<double>(60, 2.0)).empty()) << "2 m wide";
  for (const auto& cluster : clusters_of({2, 2, 4, 4, 4, 2, 2})) EXPECT_NE(cluster.first, 2U);
}

MovingObjects::Cluster thing_at(Point2 centre) { return {0, 4, centre, 0.3, {}}; }

TEST(MovingObjects, AVelocityIsKnownFromTheThirdSightingOn) {
  MovingObjects moving;
  const Point2 velocity{0.6, -0.8};
  for (int i = 0; i < 10; ++i) {
    const double time = 0.1 * i;
    std::vector clusters{thing_at(Point2{1.0, 2.0} + time * velocity), thing_at({-3.0, 0.0})};
    moving.follow(time_from_seconds(time), clusters);
    if (i < 2) {
      EXPECT_EQ(clusters[0].velocity, Point2{});
    } else {
      EXPECT_NEAR(distance(clusters[0].velocity, velocity), 0.0, i < 6 ? 0.3 : 0.1) << i;
    }
    EXPECT_EQ(clusters[1].velocity, Point2{}) << "it stands";
  }
}

TEST(MovingObjects, WhoWasNotSeenForLongIsForgotten) {
  MovingObjects moving;
  const auto sight = [&](double time) {
    std::vector clusters{thing_at({1.0 + time, 0.0})};
    moving.follow(time_from_seconds(time), clusters);
    return clusters[0].velocity;
  };
  for (int i = 0; i < 5; ++i) (void)sight(0.1 * i);
  EXPECT_NEAR(sight(0.9).x, 1.0, 0.15) << "carried on meanwhile";
  EXPECT_EQ(sight(1.7), Point2{}) << "begins anew";
}

TEST(MovingObjects, TheOtherLasersHalfOfItTellsNoVelocityOfItsOwn) {
  MovingObjects moving;
  for (int i = 0; i < 6; ++i) {
    const Time time = time_from_seconds(0.1 * i);
    std::vector front{thing_at({0.1 * i, 0.0})};
    moving.follow(time, front);
    std::vector rear{thing_at({0.1 * i + 0.05, 0.0})};  // its other side
    moving.follow(time, rear);
    if (i < 3) continue;
    EXPECT_NEAR(front[0].velocity.x, 1.0, 0.2);
    EXPECT_EQ(rear[0].velocity, front[0].velocity);
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::moving_objects_test
