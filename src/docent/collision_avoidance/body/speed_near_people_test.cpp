#include "docent/collision_avoidance/body/speed_near_people.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::collision_avoidance::speed_near_people_test {
namespace {

constexpr double kReach = 0.35;  // [m]
const BaseLimits kLimits;

/// The highest speed [m/s] straight ahead, in steps of 0.05, that is forgivable to this person; at least harmless.
double speed_near_person(const PersonPoint& person, const PeopleCautionParams& params) {
  double speed = kLimits.max_speed;
  while (speed > params.harmless && !BrakingWay{speed, 0.0, kLimits, params}.is_forgivable(person)) speed -= 0.05;
  return std::max(speed, params.harmless);
}
double speed_for(Point2 at, Point2 velocity = {}) { return speed_near_person({at, velocity, kReach}, {}); }

TEST(BrakingWay, FarAwayAndBehindNothingIsLost) {
  EXPECT_EQ(speed_for({2.5, 0.0}), 0.8);
  EXPECT_EQ(speed_for({-0.5, 0.2}), 0.8);
  EXPECT_EQ(speed_for({0.0, 0.45}), 0.8);
}

TEST(BrakingWay, StoppingDistanceOfBothByHand) {
  // Straight ahead: speed * reaction + speed^2 / 2a + surprise * (reaction + speed / a - surprise / 2 spurt) = gap,
  // here 0.5 m, with 0.4 m/s and 2.5 m/s2: 0.45 m/s; but the last decimetre a second is harmless.
  PeopleCautionParams params;
  params.surprise = 0.4;
  params.spurt = 2.5;
  EXPECT_NEAR(speed_near_person({{kReach + 0.5, 0.0}, {}, kReach}, params), 0.45, 0.051);
  EXPECT_NEAR(speed_for({kReach + 0.05, 0.0}), PeopleCautionParams{}.harmless, 1e-9);
}

TEST(BrakingWay, WhoStandsBesideTheWaySlowsLessThanWhoStandsInIt) {
  double last = 0.0;
  for (const double degrees : {0.0, 45.0, 60.0, 75.0, 90.0}) {
    const double speed = speed_for(0.75 * unit(Angle::radians(degrees * std::numbers::pi / 180.0)));
    EXPECT_GE(speed, last);
    last = speed;
  }
  EXPECT_EQ(last, 0.8);
}

TEST(BrakingWay, WhoComesSlowsMoreThanWhoGoes) {
  const double stands = speed_for({1.0, 0.0});
  EXPECT_LT(speed_for({1.0, 0.0}, {-0.6, 0.0}), stands - 0.1);
  EXPECT_GT(speed_for({1.0, 0.0}, {0.6, 0.0}), stands + 0.1);
  // A person who crosses is met where they will be.
  EXPECT_LT(speed_for({0.8, 0.8}, {0.0, -1.0}), speed_for({0.8, 0.8}, {0.0, 1.0}));
}

TEST(BrakingWay, WhoDartsAtTheRobotIsMetAtHarmlessSpeed) {
  // A person anywhere around starts at any moment, up to the surprise, in the worst direction, which is towards the
  // robot; the robot brakes one reaction later. Property: its speed towards them at the touch is harmless.
  Rng rng{7};
  const PeopleCautionParams params;
  int met = 0;
  for (int round = 0; round < 3000; ++round) {
    const double bearing = rng.uniform(-std::numbers::pi, std::numbers::pi);
    Point2 person = rng.uniform(kReach + 0.02, 1.6) * unit(Angle::radians(bearing));
    const double speed = speed_near_person({person, {}, kReach}, params);
    const double surprise = rng.uniform(0.0, params.surprise);
    constexpr double kStep = 0.01;
    double way = 0.0;
    for (double time = 0.0; time < 2.0; time += kStep) {
      const double now = std::max(0.0, speed - kLimits.deceleration * std::max(0.0, time - params.reaction));
      way += kStep * now;
      const Point2 offset = person - Point2{way, 0.0};
      const double apart = norm(offset);
      const double gathered = std::min(surprise, params.spurt * time);
      if (apart < kReach) {
        EXPECT_LE(now * offset.x / apart, params.harmless + 0.06) << round << " at " << bearing << ", " << speed;
        ++met;
        break;
      }
      person = person - (kStep * gathered / apart) * offset;
    }
  }
  EXPECT_GT(met, 200);
}

TEST(BrakingWay, ATurnLeadsTowardsWhoStandsOnItsInside) {
  const PersonPoint inside{{0.45, 0.4}, {}, kReach};
  const PeopleCautionParams params;
  EXPECT_TRUE((BrakingWay{0.6, -1.0, kLimits, params}.is_forgivable(inside)));
  EXPECT_FALSE((BrakingWay{0.6, 1.0, kLimits, params}.is_forgivable(inside)));
}

TEST(PeopleCautionParams, RefusesNonsense) {
  EXPECT_TRUE(PeopleCautionParams{}.validate());
  EXPECT_FALSE((PeopleCautionParams{-0.1, 2.5, 0.3, 0.1}.validate()));
  EXPECT_FALSE((PeopleCautionParams{0.6, 0.0, 0.3, 0.1}.validate()));
  EXPECT_FALSE((PeopleCautionParams{0.6, 2.5, -1.0, 0.1}.validate()));
  EXPECT_FALSE((PeopleCautionParams{0.6, 2.5, 0.3, 0.0}.validate()));
}

}  // namespace
}  // namespace docent::collision_avoidance::speed_near_people_test
