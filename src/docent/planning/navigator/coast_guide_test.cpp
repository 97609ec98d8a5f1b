#include "docent/planning/navigator/coast_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/planning/coastal/testing.h"

namespace docent::planning::coast_guide_test {
namespace {

/// An empty hall in whose middle a near-sighted robot sees no wall.
class CoastGuideTest : public ::testing::Test {
 protected:
  CoastGuideTest() {
    where_.is_localized = true;
    where_.map_from_odom = Pose2{};
    where_.odom_from_base = Pose2{2.0, 6.0, {}};
    belief_.hypotheses = {{{2.0, 6.0, {}}, {0.0025, 0, 0, 0, 0.0025, 0, 0, 0, 0.0025}, 1.0}};
  }
  static CoastalParams near_sighted(double weight) {
    CoastalParams params;
    params.weight = weight;
    params.places.range = 2.5;
    params.places.blocked = 0.6;
    params.places.beams = 60;
    return params;
  }
  void seek(CoastGuide& guide, Point2 goal) {
    guide.seek(goal, 0.2, route_);
    route_.set_goal(goal, 0.2);
  }
  void follow(CoastGuide& guide, int steps) {
    for (int i = 0; i < steps; ++i) guide.follow(where_, belief_, route_);
  }
  /// [m] that the way of the route leaves the line y = 6 m.
  double aside() {
    route_.iterate(100000);
    double most = 0.0;
    for (const Point2& point : route_.way(where_.map_from_base()->position()))
      most = std::max(most, std::abs(point.y - 6.0));
    return most;
  }

  /// The middle of the route's way lies there.
  bool goes_north() {
    route_.iterate(100000);
    const auto way = route_.way(where_.map_from_base()->position());
    return !way.empty() && way[way.size() / 2].y > 6.0;
  }

  OccupancyGrid map_ = testing::hall(16.0, 12.0);
  RoutePlanner route_{map_, {}, {}, {}};
  Whereabouts where_;
  PoseBelief belief_;
};

TEST_F(CoastGuideTest, WithoutWeightTheRouteIsTheShortest) {
  CoastGuide guide{map_, route_, near_sighted(0.0)};
  seek(guide, {14.0, 6.0});
  follow(guide, 200);
  EXPECT_LT(aside(), 0.3);
}

TEST_F(CoastGuideTest, TheRouteFollowsTheCoastOnceThatIsKnown) {
  CoastGuide guide{map_, route_, near_sighted(2.0)};
  seek(guide, {14.0, 6.0});
  EXPECT_LT(aside(), 0.3) << "until then the shortest";
  follow(guide, 200);
  EXPECT_GT(aside(), 2.0);
  seek(guide, {14.0, 6.0});
  EXPECT_LT(aside(), 0.3) << "another goal has no coast yet";
}

TEST_F(CoastGuideTest, WaitsForABeliefAndAPose) {
  CoastGuide guide{map_, route_, near_sighted(2.0)};
  seek(guide, {14.0, 6.0});
  const PoseBelief known = belief_;
  belief_ = {};
  follow(guide, 200);
  EXPECT_LT(aside(), 0.3);
  belief_ = known;
  const auto odom_from_base = where_.odom_from_base;
  where_.odom_from_base.reset();
  follow(guide, 200);
  where_.odom_from_base = odom_from_base;
  EXPECT_LT(aside(), 0.3);
}

TEST_F(CoastGuideTest, ARobotThatHasBeenDrivenOffGetsAnotherWay) {
  CoastGuide guide{map_, route_, near_sighted(2.0)};
  seek(guide, {14.0, 6.0});
  follow(guide, 200);
  const bool is_north = goes_north();
  where_.odom_from_base = Pose2{8.0, is_north ? 1.5 : 10.5, {}};
  follow(guide, 1);
  EXPECT_NE(goes_north(), is_north) << "along the coast where it is now";
}

}  // namespace
}  // namespace docent::planning::coast_guide_test
