#include "docent/simulator/body/body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/simulator/body/battery.h"
#include "docent/simulator/body/drive_for_test.h"
#include "docent/simulator/body/obstacles.h"

namespace docent::simulator {
namespace {

TEST(Body, AcceleratesAndBrakesWithItsLatency) {
  Body body{perfect(), Pose2{}, Rng{1}};
  Time now = drive(body, Time{}, 0.14, [&](Time t) { body.command(t, 0.6, 0.0); });
  EXPECT_EQ(body.linear(), 0.0);  // nothing arrived yet
  now = drive(body, now, 1.0, [&](Time t) { body.command(t, 0.6, 0.0); });
  EXPECT_NEAR(body.linear(), 0.5, 0.011);  // 0.5 m/s^2 from 0.15 s on
  now = drive(body, now, 2.0, [&](Time t) { body.command(t, 0.6, 0.0); });
  EXPECT_NEAR(body.linear(), 0.6, 1e-9);
  const double start = body.pose().x;
  drive(body, now, 2.0, [&](Time t) { body.command(t, 0.0, 0.0); });
  EXPECT_EQ(body.linear(), 0.0);
  EXPECT_NEAR(body.pose().x - start, 0.6 * 0.15 + 0.6 * 0.6 / 2.0, 0.012);
}

TEST(Body, StopsByItselfWithoutCommands) {
  Body body{perfect(), Pose2{}, Rng{1}};
  Time now = drive(body, Time{}, 3.0, [&](Time t) { body.command(t, 0.5, 0.2); });
  EXPECT_NEAR(body.linear(), 0.5, 1e-9);
  // The last command came 0.05 s before: its 0.3 s end after 0.25 s more.
  now = drive(body, now, 0.24, [](Time) {});
  EXPECT_NEAR(body.linear(), 0.5, 1e-9);
  EXPECT_FALSE(body.is_braking_fully());
  now = drive(body, now, 0.06, [](Time) {});
  EXPECT_LT(body.linear(), 0.5);
  EXPECT_TRUE(body.is_braking_fully());
  drive(body, now, 0.6, [](Time) {});
  EXPECT_EQ(body.linear(), 0.0);
  EXPECT_EQ(body.angular(), 0.0);
}

TEST(Body, NonsenseCommandsCountAsZeroAndLimitsHold) {
  Body body{perfect(), Pose2{}, Rng{1}};
  drive(body, Time{}, 2.0, [&](Time t) { body.command(t, std::nan(""), INFINITY); });
  EXPECT_EQ(body.linear(), 0.0);
  EXPECT_EQ(body.angular(), 0.0);
  drive(body, Time{} + seconds(2.0), 6.0, [&](Time t) { body.command(t, 1e9, -1e9); });
  EXPECT_LE(body.linear(), body.params().max_speed);
  EXPECT_GE(body.angular(), -body.params().max_turn_rate);
}

TEST(Body, OdometryIsExactWithoutErrorsAndDriftsWithThem) {
  Body exact{perfect(), Pose2{}, Rng{1}};
  drive(exact, Time{}, 20.0, [&](Time t) { exact.command(t, 0.5, 0.3); });
  EXPECT_NEAR(exact.odometry().x, exact.pose().x, 1e-6);
  EXPECT_NEAR(exact.odometry().y, exact.pose().y, 1e-6);
  int drifted = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Body body{BodyParams{}, Pose2{}, Rng{seed}};
    drive(body, Time{}, 100.0, [&](Time t) { body.command(t, 0.5, 0.0); });
    const double travelled = body.pose().x;
    EXPECT_NEAR(travelled, 50.0, 0.6);
    const double error = norm(body.odometry().position() - body.pose().position());
    EXPECT_LT(error, 0.4 * travelled);
    if (error > 0.005 * travelled) ++drifted;
    EXPECT_NEAR(body.latency(), 0.15, 0.0301);
  }
  EXPECT_GE(drifted, 15);
}

TEST(Body, CarryingItDoesNotTurnItsWheels) {
  Body body{BodyParams{}, Pose2{}, Rng{1}};
  body.carry_to({5.0, 5.0, Angle::degrees(90.0)});
  EXPECT_EQ(body.odometry().x, 0.0);
  EXPECT_EQ(body.pose().x, 5.0);
}

TEST(Body, SetDownItStandsAndGoesOnAsItWasTold) {
  Body body{BodyParams{}, Pose2{}, Rng{1}};
  drive(body, Time{}, 5.0, [&](Time t) { body.command(t, 0.5, 0.0); });
  EXPECT_NEAR(body.linear(), 0.5, 0.01);
  body.set_down({5.0, 5.0, {}}, 0.0);
  EXPECT_EQ(body.linear(), 0.0);
  drive(body, time_from_seconds(5.0), 1.0, [&](Time t) { body.command(t, 0.5, 0.0); });
  EXPECT_NEAR(body.pose().x, 5.25, 0.1);  // 0.5 m/s^2
}

TEST(Battery, LastsAboutTwoHoursOfDriving) {
  Battery battery;
  double hours = 0.0;
  while (!battery.is_empty() && hours < 10.0) {
    battery.step(1.0, 0.5, false);
    hours += 1.0 / 3600.0;
  }
  EXPECT_NEAR(hours, 2.0, 0.2);
  for (int i = 0; i < 5400; ++i) battery.step(1.0, 0.0, true);
  EXPECT_GT(battery.charge(), 0.95);
}

World corner() {
  World world;
  world.solids.push_back(
      {"east", SolidKind::wall, {{2.0, -5.0}, {2.2, -5.0}, {2.2, 5.0}, {2.0, 5.0}}, 0.0, 3.0, false});
  world.solids.push_back(
      {"north", SolidKind::plate, {{-5.0, 2.0}, {2.0, 2.0}, {2.0, 2.1}, {-5.0, 2.1}}, 0.0, 0.1, false});
  world.solids.push_back(
      {"down", SolidKind::stairs, {{-5.0, -5.0}, {-3.0, -5.0}, {-3.0, 5.0}, {-5.0, 5.0}}, -3.0, 0.0, false});
  world.solids.push_back(
      {"sign", SolidKind::furniture, {{-1.0, -2.0}, {1.0, -2.0}, {1.0, -1.0}, {-1.0, -1.0}}, 2.2, 2.4, false});
  return world;
}

TEST(Obstacles, HoldTheDiscOutAlsoInACorner) {
  const Obstacles obstacles{corner()};
  std::vector<Touch> touches;
  Point2 centre{1.9, 1.9};
  obstacles.resolve(centre, 0.265, touches);
  EXPECT_NEAR(centre.x, 1.735, 1e-6);
  EXPECT_NEAR(centre.y, 1.735, 1e-6);
  EXPECT_EQ(touches.size(), 2U);
  Point2 under_the_sign{0.0, -1.5};
  obstacles.resolve(under_the_sign, 0.265, touches);
  EXPECT_TRUE(touches.empty());
  Point2 inside{2.05, 0.0};
  obstacles.resolve(inside, 0.265, touches);
  EXPECT_NEAR(inside.x, 1.735, 1e-6);
}

TEST(Obstacles, StairsAreTouchedButHoldNothingBack) {
  const Obstacles obstacles{corner()};
  std::vector<Touch> touches;
  Point2 centre{-2.8, 0.0};
  obstacles.resolve(centre, 0.265, touches);
  ASSERT_EQ(touches.size(), 1U);
  EXPECT_EQ(centre.x, -2.8);
  EXPECT_FALSE(obstacles.has_fallen(centre));
  EXPECT_TRUE(obstacles.has_fallen({-3.1, 0.0}));
}

}  // namespace
}  // namespace docent::simulator
