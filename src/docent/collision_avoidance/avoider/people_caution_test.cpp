#include "docent/collision_avoidance/avoider/people_caution.h"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <vector>

#include "docent/collision_avoidance/avoider/avoider.h"
#include "docent/collision_avoidance/avoider/rehearsal_for_test.h"

namespace docent::collision_avoidance::people_caution_test {
namespace {

TEST(PeopleCaution, DoesNotPushAPersonWhoComesTowardsIt) {
  for (const double speed : {0.5, 0.9, 1.3}) {
    Rehearsal world{3};
    world.box(-3, -4, 20, 4);
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {15, 0}});
    world.people.push_back({{9, 0.1}, {-speed, 0.0}});
    world.run(14);
    EXPECT_LE(world.worst_push, 0.1) << "a person at " << speed << " m/s";
  }
}

TEST(PeopleCaution, DoesNotPushAPersonWhoCrosses) {
  for (const double start : {1.5, 2.0, 2.5, 3.0, 3.5}) {
    Rehearsal world{5};
    world.box(-3, -6, 20, 6);
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {15, 0}});
    world.people.push_back({{4.0, start}, {0.0, -0.8}});
    world.run(12);
    EXPECT_LE(world.worst_push, 0.1) << "from y = " << start;
  }
}

/// Along two rows of people, shoulder to shoulder; one of them steps in with 0.7 m/s when the robot is `before` [m]
/// away.
double push_of_who_steps_in(std::uint64_t seed, double before, const AvoiderParams& params) {
  Rehearsal rehearsal{seed, params};
  rehearsal.box(-2.0, -3.0, 10.0, 3.0);
  for (int i = 0; i < 11; ++i) {
    for (const double side : {-1.0, 1.0}) rehearsal.people.push_back({{1.0 + 0.48 * i, side * 0.72}, {}});
  }
  constexpr std::size_t kSteps = 13;
  rehearsal.drive_to({{7.0, 0.0}});
  while (rehearsal.map_from_base.x < rehearsal.people[kSteps].place.x - before &&
         rehearsal.now < time_from_seconds(30.0))
    rehearsal.run(0.01);
  rehearsal.people[kSteps].velocity = {0.0, -0.7};
  rehearsal.run(1.0);
  rehearsal.people[kSteps].velocity = {};
  rehearsal.run(1.0);
  return rehearsal.worst_push;
}

TEST(PeopleCaution, DoesNotPushWhoStepsOutOfARow) {
  AvoiderParams blunt = Rehearsal::without_sonar();
  blunt.people.surprise = 0.0;
  blunt.body = {.ahead = 0.0, .aside = 0.0};
  double worst = 0.0;
  double worst_of_blunt = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const double before : {0.3, 0.5, 0.7, 0.9}) {
      worst = std::max(worst, push_of_who_steps_in(seed, before, Rehearsal::without_sonar()));
      worst_of_blunt = std::max(worst_of_blunt, push_of_who_steps_in(seed, before, blunt));
    }
  }
  EXPECT_LE(worst, 0.2);
  EXPECT_GT(worst_of_blunt, 0.25);
}

/// A robot that creeps with 0.15 m/s through an empty hall, where somebody then stands, in the end `gap` [m] before it.
/// @return  what the check of the last scan says, without another choice
std::optional<AvoiderDecision> reflex_to_somebody(double gap) {
  constexpr double kDriven = 0.13;  // [m] in all
  Avoider avoider{BaseLimits{}, Rehearsal::without_sonar(), {"front laser"}};
  avoider.set_max_speed(0.15);
  const Point2 person{kDriven + BaseLimits{}.radius + gap + 0.22, 0.0};
  Time now = time_from_seconds(10.0);
  Pose2 odom_from_base;
  for (int i = 0; i < 22; ++i) {
    now = now + seconds(0.05);
    const Velocity velocity = avoider.command();
    odom_from_base = odom_from_base * Pose2{0.05 * velocity.linear, 0.0, {}};
    avoider.add_odometry(now, now, {odom_from_base, velocity});
    SensorSweep sweep{now, {}, -std::numbers::pi, std::numbers::pi / 180.0, 0.02, 10.0, {}};
    for (int k = 0; k < 360; ++k) {
      const auto hit = ray_distance(odom_from_base.position(), unit(Angle::degrees(k - 180.0)), person, 0.22);
      sweep.ranges.push_back(i >= 10 && hit ? static_cast<float>(*hit)
                                            : 9.0F - 0.001F * static_cast<float>((k + 7 * i) % 11));
    }
    avoider.add_sweep(now, 0, sweep);
    avoider.add_virtual(now, {now, -std::numbers::pi, std::numbers::pi / 90.0, 6.0, std::vector<float>(180, 6.0F)});
    AvoiderTarget target;
    target.mode = AvoiderTarget::Mode::drive;
    target.via = {{9.0, 0.0}};
    avoider.set_target(now, now, target);
    if (i == 3 || i == 8) (void)avoider.decide(now);
  }
  EXPECT_NEAR(avoider.command().linear, 0.15, 0.01);
  EXPECT_NEAR(odom_from_base.x, kDriven, 0.03);
  return avoider.reflex(now);
}

/// How a point of somebody's legs, at `at` and moving with `velocity`, is taken.
Obstacle taken(Point2 at, Point2 velocity, double laser_height, bool mapped = false) {
  const PeopleCaution caution{{}, 0.08, {}, UnseenBodies{{.ahead = 0.12, .aside = 0.22}, laser_height}, true};
  UnmappedPlaces unmapped;
  const Time now = time_from_seconds(10.0);
  const std::vector<Point2> beams{mapped ? Point2{-3.0, 0.0} : at};
  unmapped.add(now, now, {}, beams, true);
  EXPECT_TRUE(unmapped.judge(now));
  ObstaclePoint point;
  point.in_odom = at;
  point.velocity = velocity;
  point.person = true;
  return caution.obstacle_of({point, at, velocity, norm(at), 2.5, &unmapped});
}

TEST(PeopleCaution, KeepsClearOfTheBodyAboveTheLegs) {
  EXPECT_NEAR(taken({1.0, 0.0}, {}, 0.3).margin, 0.20, 1e-9);
  EXPECT_NEAR(taken({1.0, 0.0}, {}, 0.3).perhaps, 0.10, 1e-9);
  EXPECT_NEAR(taken({1.0, 0.0}, {0.0, 1.0}, 0.3).margin, 0.30, 1e-9) << "their side";
  EXPECT_NEAR(taken({1.0, 0.0}, {-1.0, 0.0}, 0.3).margin, 0.20, 1e-9) << "their front";
  EXPECT_NEAR(taken({1.0, 0.0}, {}, 1.0).margin, 0.08, 1e-9) << "a laser that sees them whole";
  EXPECT_NEAR(taken({1.0, 0.0}, {}, 0.3, true).margin, 0.08, 1e-9) << "a column that the map explains";
}

TEST(PeopleCaution, TheCheckOfEveryScanSlowsACreepWhereOnlyLessIsHarmless) {
  const auto near = reflex_to_somebody(0.16);
  ASSERT_TRUE(near) << "no reflex";
  EXPECT_EQ(near->reason, "people_near");
  EXPECT_NEAR(near->command.linear, PeopleCautionParams{}.harmless, 1e-6);
  EXPECT_FALSE(reflex_to_somebody(1.5)) << "far off";
}

TEST(PeopleCaution, TheChoiceTakesPeopleAsTheyStandAndTheCheckForeseesThem) {
  for (const double speed : {0.0, 0.9}) {  // towards the robot, which stands
    AvoiderParams params = Rehearsal::without_sonar();
    params.body = {.ahead = 0.0, .aside = 0.0};  // what is seen of them is all of them
    Avoider avoider{BaseLimits{}, params, {"front laser"}};
    Time now = time_from_seconds(10.0);
    AvoiderTarget target;
    target.mode = AvoiderTarget::Mode::drive;
    target.via = {{9.0, 0.0}};
    for (int i = 15; i >= 0; --i) {
      now = now + seconds(0.05);
      avoider.add_odometry(now, now, {});
      SensorSweep sweep{now, {}, -std::numbers::pi, std::numbers::pi / 180.0, 0.02, 10.0, {}};
      for (int k = 0; k < 360; ++k) {
        const auto hit = ray_distance({}, unit(Angle::degrees(k - 180.0)), {1.04 + 0.05 * i * speed, 0.0}, 0.22);
        sweep.ranges.push_back(hit ? static_cast<float>(*hit) : 10.0F);
      }
      avoider.add_sweep(now, 0, sweep);
      avoider.add_virtual(now, {now, -std::numbers::pi, std::numbers::pi / 90.0, 6.0, std::vector<float>(180, 6.0F)});
      avoider.set_target(now, now, target);
    }
    EXPECT_GT(avoider.decide(now).command.linear, 0.1) << "at " << speed << " m/s";
    const auto check = avoider.reflex(now);
    EXPECT_EQ(check.has_value(), speed > 0.0);
    if (check) {
      EXPECT_LT(check->command.linear, 0.1 + 1e-9);
    }
  }
}

TEST(PeopleCaution, GoesRoundAPersonWhoStandsInTheWay) {
  Rehearsal world;
  world.box(-3, -3, 12, 3);
  world.people.push_back({{4, 0.05}});
  world.drive_to({{1, 0}, {2, 0}, {4, 0}, {6, 0}, {8, 0}});
  EXPECT_TRUE(world.run_until_arrived(60)) << "at " << world.map_from_base.x << "," << world.map_from_base.y;
  EXPECT_LE(world.worst_push, 0.0);
}

TEST(PeopleCaution, SlidesOutOfAMarginThatShutsTheWayAhead) {
  Rehearsal world;
  world.box(-3, -4, 8, 4);
  world.hazards = {{{-2, -0.40}, {5, -0.42}}, {{-2, 0.52}, {5, 0.50}}};  // comes nearer on the way, 0.92 m wide
  world.drive_to({{1, 0.0}, {2, 0.0}, {3, 0.0}, {6, 0.0}});
  world.run(30);
  EXPECT_GT(world.map_from_base.x, 2.0);
  EXPECT_GT(world.least_wall, 0.1);
}

TEST(PeopleCaution, LeavesWhoTouchedItAwayFromThemOnly) {
  for (const bool from_behind : {true, false}) {
    Rehearsal world{5};
    world.box(-3, -5, 15, 5);
    world.drive_to({{1, 0}, {2, 0}, {4, 0}, {8, 0}, {12, 0}});
    world.run(1.0);
    std::vector<std::uint8_t> segments(24, 0);
    segments[from_behind ? 12 : 0] = 1;
    world.avoider.add_tactile(world.now, world.now, segments, 1);
    const auto reflex = world.avoider.reflex(world.now);
    ASSERT_TRUE(reflex);
    EXPECT_EQ(reflex->command, Velocity{}) << "it stands at once, wherever it was touched";
    world.run(1.2);
    if (from_behind)
      EXPECT_GT(world.velocity.linear, 0.1);
    else
      EXPECT_LT(world.velocity.linear, 0.05);
  }
}

}  // namespace
}  // namespace docent::collision_avoidance::people_caution_test
