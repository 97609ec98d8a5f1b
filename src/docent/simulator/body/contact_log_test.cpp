#include "docent/simulator/body/contact_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "docent/messages/conversions.h"
#include "docent/simulator/body/drive_for_test.h"

namespace docent::simulator {
namespace {

/// A robot at `speed` meets a person who stands or comes; it begins to brake `reaction` after they are seen inside the
/// stopping distance, never if negative.
std::vector<docent_msgs::TrueContact> meet(double speed, double person_speed, double reaction) {
  Body body{perfect(), Pose2{}, Rng{1}};
  ContactLog log;
  Time now = drive(body, Time{}, 5.0, [&](Time t) { body.command(t, speed, 0.0); });
  double person = body.pose().x + 3.0;
  std::vector<docent_msgs::TrueContact> all;
  std::optional<Time> seen;
  for (int i = 0; i < 1000; ++i) {
    now = now + seconds(kStep);
    // The stop is sent the latency before braking shall begin.
    const bool brakes = seen && reaction >= 0.0 && now - *seen >= seconds(reaction - body.latency());
    body.command(now, brakes ? 0.0 : speed, 0.0);
    body.step(now, kStep, true);
    person -= person_speed * kStep;
    const double gap = person - body.pose().x - 0.265 - 0.25;
    if (!seen && gap < body.stopping_distance(0.3)) seen = now;
    log.watch(now, body, {{7, {person - body.pose().x, 0.0}, 0.25, true}});
    if (gap <= 0.0) {
      log.touch(now, body, {"people", "person-7", {person - 0.25, 0.0}, {1.0, 0.0}, person_speed, 7});
      person = body.pose().x + 0.515;
    }
    for (auto& contact : log.finish_step(now, kStep, body)) all.push_back(contact);
  }
  return all;
}

TEST(ContactLog, WhoBrakesInTimeBeforeOneWhoStandsDoesNotTouch) { EXPECT_TRUE(meet(0.6, 0.0, 0.25).empty()); }

TEST(ContactLog, WhoDoesNotBrakeIsAtFault) {
  const auto contacts = meet(0.6, 0.0, -1.0);
  ASSERT_EQ(contacts.size(), 1U);  // once, although it goes on
  EXPECT_FALSE(contacts[0].braked_in_time);
  EXPECT_NEAR(contacts[0].robot_speed, 0.6, 1e-6);
  EXPECT_EQ(contacts[0].other_speed, 0.0);
}

TEST(ContactLog, WhoBrakesInTimeBeforeARunnerIsNot) {
  const auto contacts = meet(0.6, 1.5, 0.2);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_TRUE(contacts[0].braked_in_time);
  EXPECT_GT(contacts[0].other_speed, contacts[0].robot_speed);
}

TEST(ContactLog, WhoBrakesTooLateIsAtFault) {
  const auto contacts = meet(0.6, 0.3, 0.5);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_FALSE(contacts[0].braked_in_time);
}

/// A robot of a given speed, and what is told of the touches of its steps.
struct Stage {
  explicit Stage(double speed) : body{perfect(), Pose2{}, Rng{1}}, wanted{speed} {
    now = drive(body, now, 5.0, [&](Time t) { body.command(t, wanted, 0.0); });
  }
  /// Steps in which the robot touches these.
  std::vector<docent_msgs::TrueContact> touch(const std::vector<ContactLog::Touching>& things, double duration,
                                              const std::vector<ContactLog::PersonSample>& people = {}) {
    std::vector<docent_msgs::TrueContact> all;
    for (int i = 0; i < static_cast<int>(std::lround(duration / kStep)); ++i) {
      now = now + seconds(kStep);
      body.command(now, wanted, 0.0);
      body.step(now, kStep, true);
      log.watch(now, body, people);
      for (const auto& thing : things) log.touch(now, body, thing);
      for (auto& contact : log.finish_step(now, kStep, body)) all.push_back(contact);
    }
    return all;
  }
  Body body;
  double wanted;
  Time now{};
  ContactLog log;
};

const ContactLog::Touching kWall{"walls", "east", {1.0, 0.0}, {1.0, 0.0}, 0.0, std::nullopt};
const ContactLog::Touching kBench{"furniture", "bench", {0.0, 1.0}, {0.0, 1.0}, 0.0, std::nullopt};

TEST(ContactLog, AContactIsToldOnceUntilItHasEndedForASecond) {
  Stage stage{0.5};
  const auto first = stage.touch({kWall}, 2.0);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].kind, "walls");
  EXPECT_EQ(first[0].what, "east");
  EXPECT_NEAR(first[0].robot_speed, 0.5, 1e-9);
  EXPECT_TRUE(stage.touch({}, 0.9).empty());
  EXPECT_TRUE(stage.touch({kWall}, 0.1).empty()) << "off for less than a second: still the same";
  EXPECT_TRUE(stage.touch({}, 1.1).empty());
  EXPECT_EQ(stage.touch({kWall}, 0.1).size(), 1U) << "another";
}

TEST(ContactLog, TwoThingsAreTwoContactsEachWithItsOwnSpeed) {
  Stage stage{0.5};
  const auto contacts = stage.touch({kWall, kBench}, 0.5);
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_NEAR(contacts[0].robot_speed, 0.5, 1e-9);
  EXPECT_NEAR(contacts[1].robot_speed, 0.0, 1e-9) << "it drives past the bench, not against it";
  EXPECT_NEAR(contacts[1].wheel_speed, 0.5, 1e-9);
}

TEST(ContactLog, CountsTheTimeInWhichSomethingIsTouchedAndTheWheelsTurn) {
  Stage stage{0.5};
  (void)stage.touch({kWall, kBench}, 1.0);
  EXPECT_NEAR(stage.log.seconds_wheels_turning(), 1.0, 1e-6) << "once, whatever it touches";
  (void)stage.touch({}, 1.0);
  EXPECT_NEAR(stage.log.seconds_wheels_turning(), 1.0, 1e-6);
  stage.wanted = 0.0;
  (void)stage.touch({}, 3.0);
  (void)stage.touch({kWall}, 1.0);
  EXPECT_NEAR(stage.log.seconds_wheels_turning(), 1.0, 1e-6) << "who stands may be touched";
}

TEST(ContactLog, WhatIsToldOfAPersonWaitsUntilTheTimeToReactIsOver) {
  Stage stage{0.5};
  const ContactLog::Touching person{"people", "person-3", {0.3, 0.0}, {1.0, 0.0}, 1.0, 3};
  EXPECT_TRUE(stage.touch({person}, 0.29).empty());
  const auto contacts = stage.touch({person}, 0.05);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(to_seconds(from_message(contacts[0].header.stamp) - Time{}), 5.01, 1e-6) << "the time of the touch";
}

TEST(ContactLog, WhoWasHiddenIsFirstSeenAtTheTouch) {
  // It begins to brake fully 0.2 s before the touch: too late for one who has long been in sight, in time for one who
  // was not.
  for (const bool in_sight : {true, false}) {
    Stage stage{0.6};
    const ContactLog::PersonSample person{3, {0.7, 0.0}, 0.25, in_sight};
    (void)stage.touch({}, 1.0, {person});
    stage.wanted = 0.0;
    (void)stage.touch({}, 0.35, {person});
    const auto contacts = stage.touch({{"people", "person-3", {0.3, 0.0}, {1.0, 0.0}, 0.5, 3}}, 0.5, {person});
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_EQ(contacts[0].braked_in_time, !in_sight);
  }
}

TEST(ContactLog, ACarriedRobotBeginsAnew) {
  Stage stage{0.5};
  ASSERT_EQ(stage.touch({kWall}, 0.2).size(), 1U);
  stage.log.forget();
  EXPECT_EQ(stage.touch({kWall}, 0.2).size(), 1U) << "the same wall at another place";
}

}  // namespace
}  // namespace docent::simulator
