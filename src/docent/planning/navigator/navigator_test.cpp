#include "docent/planning/navigator/navigator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "docent/planning/navigator/testing.h"

namespace docent::planning::navigator_test {
namespace {

constexpr int kSide = 80;  // planning cells along a side of the hall

NavigatorParams for_a_small_robot() {
  NavigatorParams params;
  params.route.robot_radius = 0.265;
  return params;
}

/// A robot at (3, 6) of the hall. Odometry has its origin there and turns the axes by 90 degrees.
class NavigatorTest : public ::testing::Test {
 protected:
  [[nodiscard]] Whereabouts where() const {
    Whereabouts result;
    result.is_localized = localized;
    result.believed_at = believed_at;
    if (has_odometry) result.odom_from_base = odom_from_base;
    if (has_belief) result.map_from_odom = map_from_base * inverse(odom_from_base);
    result.odom_from_base_at = [here = odom_from_base](Time) { return here; };
    return result;
  }
  /// One step of 0.2 s.
  Orders step() {
    now = now + Navigator::kStepPeriod;
    if (believes) believed_at = now;
    last = navigator.step(where(), now);
    ++steps;
    paths += last.path.has_value() ? 1 : 0;
    return last;
  }
  void run(double duration) {
    for (const Time end = now + seconds(duration); now < end;) (void)step();
  }
  std::optional<Orders> want(const std::string& id, Point2 place, double position_tolerance = 0.25) {
    return navigator.set_goal({id, {place.x, place.y, {}}, position_tolerance, 0.1}, false, where(), now);
  }
  std::optional<Orders> want_position() { return navigator.set_goal({"look", {}, 0.25, 0.1}, true, where(), now); }
  void see_all_round(float range) {
    const double begin = -std::numbers::pi;
    const Sweep sweep{now, begin, std::numbers::pi / 180.0, 10.0, std::vector<float>(360, range)};
    navigator.lookout().see(0, sweep);
    navigator.lookout().see_hazards(sweep);
  }
  /// The live map as it is said whole: free but for the middle door, if that is closed.
  void say_live_map(bool closed, std::int8_t live = OccupancyGrid::kOccupied) {
    std::vector<std::int8_t> cells(std::size_t{kSide} * kSide, 0);
    for (std::size_t row = 32; row < 48 && closed; ++row) cells[row * kSide + 40] = live;
    navigator.live_obstacles().take_map(now, cells);
  }

  Pose2 map_from_base{3.0, 6.0, {}};
  Pose2 odom_from_base{0.0, 0.0, Angle::degrees(90)};
  bool localized = true, believes = true, has_belief = true, has_odometry = true;
  Time now = time_from_seconds(100.0);
  Time believed_at = now;
  Navigator navigator{testing::hall_with_two_doors(), {}, {Pose2{}}, for_a_small_robot()};
  Orders last;
  int steps = 0, paths = 0;
};

TEST_F(NavigatorTest, WithoutAGoalItStaysAndIsSilentAboutWays) {
  run(3.0);
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
  EXPECT_EQ(last.report.state, GoalStatus::idle);
  EXPECT_EQ(last.goal_id, "");
  EXPECT_EQ(paths, 0);
  EXPECT_FALSE(navigator.value_picture().has_value());
  ASSERT_TRUE(last.look.has_value());
  EXPECT_EQ(last.look->at, GazeAt::none);
}

TEST_F(NavigatorTest, ANewGoalIsAnsweredAtOnceAndTheSameOneIsNot) {
  const auto answer = want("g1", {9.0, 6.0}, 0.3);
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->goal_id, "g1");
  EXPECT_NE(answer->report.state, GoalStatus::idle);
  EXPECT_EQ(answer->aim.position_tolerance, 0.3);
  EXPECT_FALSE(want("g1", {9.0, 6.0}, 0.4).has_value());
  EXPECT_EQ(step().aim.position_tolerance, 0.4) << "what changes of it counts";
  EXPECT_TRUE(want("g2", {3.0, 9.0}).has_value());
}

TEST_F(NavigatorTest, PutsTheWayIntoOdometrysFrame) {
  (void)want("g1", {9.0, 6.0});
  run(2.0);
  ASSERT_EQ(last.aim.mode, DriveMode::drive);
  ASSERT_FALSE(last.aim.via.empty());
  for (const Point2& via : last.aim.via) {  // the way leads east; the robot's x axis is odometry's y
    EXPECT_NEAR(via.x, 0.0, 0.5);
    EXPECT_GT(via.y, -0.1);
  }
  EXPECT_EQ(last.report.state, GoalStatus::driving);
  EXPECT_NEAR(last.report.remaining_m, 6.0, 0.6);
  ASSERT_TRUE(last.look.has_value());
  EXPECT_EQ(last.look->at, GazeAt::way);
  EXPECT_NEAR(last.look->bearing.degrees(), 0.0, 15.0);
  has_odometry = false;
  EXPECT_FALSE(step().look.has_value()) << "nobody knows where ahead is";
}

TEST_F(NavigatorTest, ArrivesTurnsAndStays) {
  navigator = {testing::hall_with_two_doors(), {}, {Pose2{}}, for_a_small_robot()};
  (void)navigator.set_goal({"g1", {9.0, 6.0, Angle::degrees(90)}, 0.25, 0.1}, false, where(), now);
  run(1.0);
  map_from_base = {8.9, 6.0, {}};
  EXPECT_EQ(step().report.state, GoalStatus::turning);
  EXPECT_EQ(last.aim.mode, DriveMode::turn);
  EXPECT_NEAR(last.aim.heading.degrees(), -180.0, 1e-6) << "90 degrees of the map are 180 of odometry";
  EXPECT_EQ(last.look->at, GazeAt::goal);
  map_from_base.theta = Angle::degrees(88);
  EXPECT_EQ(step().report.state, GoalStatus::arrived);
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
}

TEST_F(NavigatorTest, TheWayIsToldOnceASecondAndItsEndOnce) {
  (void)want("g1", {9.0, 6.0});
  run(1.0);
  paths = steps = 0;
  run(10.0);
  EXPECT_EQ(steps, 50);
  EXPECT_EQ(paths, 10);
  (void)want("", {});
  paths = 0;
  run(5.0);
  EXPECT_EQ(paths, 1) << "one empty way, so that the page clears it";
}

TEST_F(NavigatorTest, ValuesAreToldWhileItPlansAndTheirEndOnce) {
  (void)want("g1", {9.0, 6.0});
  run(2.0);
  auto picture = navigator.value_picture();
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->shares.size(), picture->frame.size());
  EXPECT_EQ(picture->frame.columns, kSide / 2);
  const auto share_at = [&](Point2 place) {
    return picture->shares[picture->frame.index(picture->frame.cell_at(place))];
  };
  EXPECT_LT(share_at({9.0, 6.0}), share_at({7.0, 6.0}));
  EXPECT_LT(share_at({7.0, 6.0}), share_at({3.0, 6.0}));
  (void)want("", {});
  picture = navigator.value_picture();
  ASSERT_TRUE(picture.has_value());
  EXPECT_TRUE(picture->shares.empty());
  EXPECT_EQ(picture->frame.columns, 0);
  EXPECT_EQ(picture->frame.rows, 0);
  EXPECT_FALSE(navigator.value_picture().has_value());
}

TEST_F(NavigatorTest, StandsWhileTheBeliefIsUnsureOrStaleOrMissing) {
  has_belief = localized = false;
  (void)want("g1", {9.0, 6.0});
  run(2.0);
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
  EXPECT_EQ(last.report.state, GoalStatus::waiting);
  has_belief = localized = true;
  run(1.0);
  EXPECT_EQ(last.aim.mode, DriveMode::drive);
  believes = false;  // odometry goes on
  run(2.8);
  EXPECT_EQ(last.aim.mode, DriveMode::drive);
  run(0.4);
  EXPECT_EQ(last.aim.mode, DriveMode::stop) << "3 s are too long to drive on";
  EXPECT_EQ(last.report.reason, "the position is not known");
  believes = true;
  run(0.2);
  EXPECT_EQ(last.aim.mode, DriveMode::drive);
  localized = false;
  run(0.2);
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
}

TEST_F(NavigatorTest, GoesRoundWhatTheLiveMapShows) {
  (void)want("g1", {9.0, 6.0});
  run(2.0);
  ASSERT_NEAR(last.report.remaining_m, 6.0, 0.6);
  say_live_map(true);
  bool was_global = false;
  for (int i = 0; i < 15; ++i) was_global |= step().report.detour == Detour::global;
  EXPECT_TRUE(was_global) << "until the other way is the one that is meant";
  EXPECT_GT(last.report.remaining_m, 8.0) << "the middle door is closed: through the other";
  EXPECT_LT(last.report.straight_m, 6.1);
  say_live_map(false);
  run(3.0);
  EXPECT_NEAR(last.report.remaining_m, 6.0, 0.6);
}

TEST_F(NavigatorTest, ANewGoalIsPlannedOverWhatStandsThereAlready) {
  say_live_map(true);
  (void)want("g1", {9.0, 6.0});
  run(2.0);
  EXPECT_GT(last.report.remaining_m, 8.0);
  EXPECT_EQ(last.report.detour, Detour::none) << "this is the way that is meant";
}

TEST_F(NavigatorTest, TellsWhenSomethingStandsOnItsGoal) {
  say_live_map(true);  // in the middle door, at (6, 6)
  (void)want("g1", {9.0, 6.0});
  run(1.0);
  EXPECT_FALSE(last.report.is_occupied);
  (void)want("g2", {6.1, 6.0});
  run(1.0);
  EXPECT_TRUE(last.report.is_occupied);
  say_live_map(false);
  run(1.0);
  EXPECT_FALSE(last.report.is_occupied);
}

TEST_F(NavigatorTest, HazardsAndTheBorderAreClosed) {
  DrivableGround ground;
  ground.hazards = {{{5.5, 4.5}, {6.5, 4.5}, {6.5, 7.5}, {5.5, 7.5}}};  // in the middle door
  navigator = {testing::hall_with_two_doors(), ground, {Pose2{}}, for_a_small_robot()};
  (void)want("g1", {9.0, 6.0});
  run(2.0);
  EXPECT_GT(last.report.remaining_m, 8.0);
  ground.area = {{0, 0}, {12, 0}, {12, 8.5}, {0, 8.5}};  // the northern door lies outside
  navigator = {testing::hall_with_two_doors(), ground, {Pose2{}}, for_a_small_robot()};
  (void)want("g1", {9.0, 6.0});
  run(5.0);
  EXPECT_EQ(last.report.state, GoalStatus::unreachable);
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
}

TEST_F(NavigatorTest, InsideAZoneItStandsWhateverTheGoal) {
  DrivableGround ground;
  ground.hazards = {{{2.5, 5.5}, {3.5, 5.5}, {3.5, 6.5}, {2.5, 6.5}}};  // drawn round the robot
  navigator = {testing::hall_with_two_doors(), ground, {Pose2{}}, for_a_small_robot()};
  (void)want("g1", {9.0, 6.0});
  run(10.0);
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
  EXPECT_EQ(last.report.state, GoalStatus::waiting) << "the wish is not lost";
  EXPECT_NE(last.report.reason, "");
  map_from_base.x = 4.2;  // an operator has led it out
  odom_from_base.y = -1.2;
  run(2.0);
  EXPECT_EQ(last.aim.mode, DriveMode::drive);
}

TEST_F(NavigatorTest, IsBlockedWhenItDoesNotGetOnUnlessAnOperatorHoldsOrLeadsIt) {
  (void)want("g1", {9.0, 6.0});
  run(6.0);
  EXPECT_EQ(last.report.state, GoalStatus::blocked);
  EXPECT_GT(last.report.blocked_s, 4.0);
  EXPECT_EQ(last.aim.mode, DriveMode::drive) << "it goes on trying";
  navigator.stop(true);
  run(10.0);
  EXPECT_EQ(last.report.state, GoalStatus::driving);
  EXPECT_LT(last.report.blocked_s, 0.1);
  navigator.stop(false);
  navigator.steer(now);
  run(2.8);
  EXPECT_LT(last.report.blocked_s, 0.1);
  run(4.0);
  EXPECT_EQ(last.report.state, GoalStatus::driving) << "counted from where the hand let go";
  run(2.0);
  EXPECT_EQ(last.report.state, GoalStatus::blocked);
}

TEST_F(NavigatorTest, TheWayEndsWhereTheGoalCountsAsReached) {
  // The goal's cells lie within its tolerance, so the way's last point does.
  (void)want("g1", {4.03, 6.02}, 0.10);
  run(2.0);
  ASSERT_EQ(last.aim.mode, DriveMode::drive);
  ASSERT_TRUE(last.aim.is_final);
  const Point2 end = map_from_base * (inverse(odom_from_base) * last.aim.via.back());
  EXPECT_LT(distance(end, {4.03, 6.02}), 0.10);
}

TEST_F(NavigatorTest, ALostRobotTurnsUntilItKnowsItsPlaceAndStandsThen) {
  localized = false;
  const auto answer = want_position();
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->aim.mode, DriveMode::turn) << "without sweeps nothing else is safe";
  EXPECT_EQ(answer->goal_id, "look");
  EXPECT_EQ(answer->report.state, GoalStatus::waiting);
  EXPECT_EQ(answer->report.reason, "looking around to find the position");
  run(1.0);
  EXPECT_EQ(last.aim.mode, DriveMode::turn);
  EXPECT_FALSE(last.look.has_value()) << "the head stays as it is";
  EXPECT_EQ(paths, 0);
  localized = true;
  step();
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
  EXPECT_EQ(last.report.state, GoalStatus::arrived);
}

TEST_F(NavigatorTest, ALostRobotWithoutOdometryStands) {
  localized = has_odometry = false;
  (void)want_position();
  run(1.0);
  EXPECT_EQ(last.aim.mode, DriveMode::stop);
  EXPECT_EQ(last.report.state, GoalStatus::waiting);
}

TEST_F(NavigatorTest, ALostRobotDrivesAfterAFullTurnAndTellsWhenItIsHeldUp) {
  localized = false;
  (void)want_position();
  int turns = 0;
  for (; turns < 200 && last.aim.mode != DriveMode::drive; ++turns) {
    odom_from_base.theta = odom_from_base.theta + Angle::degrees(20);
    see_all_round(4.0F);
    step();
    EXPECT_EQ(last.report.blocked_s, 0.0);
  }
  ASSERT_EQ(last.aim.mode, DriveMode::drive);
  EXPECT_GE(turns, 18);
  EXPECT_TRUE(last.aim.is_final);
  ASSERT_EQ(last.aim.via.size(), 1U);
  EXPECT_NEAR(distance(last.aim.via[0], odom_from_base.position()), 2.0, 0.1);
  see_all_round(4.0F);
  run(4.0);
  EXPECT_NEAR(last.report.blocked_s, 4.0, 0.1) << "it has not moved";
}

TEST_F(NavigatorTest, ALostRobotThatIsHemmedInSaysWhatHindersIt) {
  localized = false;
  (void)want_position();
  const auto turn_round = [&](float real, float virtual_range) {
    for (int i = 0; i < 25; ++i) {
      odom_from_base.theta = odom_from_base.theta + Angle::degrees(20);
      const Sweep sweep{now, -std::numbers::pi, std::numbers::pi / 180.0, 10.0, std::vector<float>(360, real)};
      Sweep hazards = sweep;
      hazards.ranges.assign(360, virtual_range);
      navigator.lookout().see(0, sweep);
      navigator.lookout().see_hazards(hazards);
      step();
      EXPECT_EQ(last.aim.mode, DriveMode::turn);
    }
  };
  turn_round(0.5F, 6.0F);
  EXPECT_NE(navigator.hindrance().find("people or things"), std::string::npos) << navigator.hindrance();
  EXPECT_EQ(last.report.reason, navigator.hindrance());
  EXPECT_GT(last.report.blocked_s, 0.0) << "so that people are asked";
  turn_round(4.0F, 0.5F);
  EXPECT_NE(navigator.hindrance().find("hazards"), std::string::npos) << navigator.hindrance();
  localized = true;
  (void)want("g2", {9.0, 6.0});
  EXPECT_EQ(navigator.hindrance(), "");
}

TEST_F(NavigatorTest, ALostRobotDrivesToWhereTheBeliefSaysThatItsHypothesesDiffer) {
  navigator = {testing::corridor_with_alcove(), {}, {Pose2{}}, for_a_small_robot()};
  localized = false;
  PoseBelief belief;
  belief.hypotheses = {{{14.0, 1.2, {}}, {}, 0.5}, {{10.0, 1.2, Angle::degrees(180)}, {}, 0.5}};
  belief.odom_from_base = odom_from_base;
  (void)want_position();
  const auto look = [&] {
    Sweep sweep{now, -std::numbers::pi, std::numbers::pi / 180.0, 10.0, std::vector<float>(360, 1.2F)};
    for (std::size_t i = 0; i < 360; ++i)
      if (i < 30 || (i > 150 && i < 210) || i > 330) sweep.ranges[i] = 8.0F;  // along the corridor
    navigator.lookout().see(0, sweep);
    navigator.lookout().see_hazards(sweep);
    return step().aim.mode;
  };
  EXPECT_EQ(look(), DriveMode::turn) << "without a belief it only looks round";
  navigator.believe(belief);
  now = now + seconds(1.0);  // it does not ask more often
  EXPECT_EQ(look(), DriveMode::drive) << "without a full turn";
}

TEST_F(NavigatorTest, AfterLookingRoundTheNextGoalIsDrivenTo) {
  localized = false;
  (void)want_position();
  run(1.0);
  localized = true;
  const auto answer = want("g2", {9.0, 6.0});
  ASSERT_TRUE(answer.has_value());
  run(1.0);
  EXPECT_EQ(last.goal_id, "g2");
  EXPECT_EQ(last.aim.mode, DriveMode::drive);
}

}  // namespace
}  // namespace docent::planning::navigator_test
