#include "docent/telepresence/counting/audience.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

/// At that second: so many who stand a metre away, and so many who walk past.
docent_msgs::People hall_at(double second, int standing, int walking) {
  docent_msgs::People people;
  people.header.stamp = to_message(time_from_seconds(second));
  for (int i = 0; i < standing; ++i) people.people.push_back({static_cast<std::uint32_t>(i), 1.0F, 0.0F, 0.1F, 0.0F});
  for (int i = 0; i < walking; ++i)
    people.people.push_back({static_cast<std::uint32_t>(100 + i), 2.0F, 0.0F, 0.0F, 1.1F});
  people.people.push_back({99, 3.5F, 0.0F, 0.0F, 0.0F});  // too far away
  return people;
}

TEST(Audience, WhoPassesByOrIsHiddenForAMomentChangesNothing) {
  Audience audience;
  EXPECT_EQ(audience.count(), 0);
  for (int second = 0; second < 12; ++second)
    audience.see(hall_at(second, second == 9 || second == 11 ? 2 : 4, second % 3), Pose2{});
  EXPECT_EQ(audience.count(), 4);
}

TEST(Audience, WhatIsOlderThanTheWindowIsForgotten) {
  Audience audience;
  for (int second = 0; second < 60; ++second) audience.see(hall_at(second, 9, 0), Pose2{});
  for (int second = 60; second < 72; ++second) audience.see(hall_at(second, 1, 0), Pose2{});
  EXPECT_EQ(audience.count(), 1);
}

TEST(Audience, TheSamePeopleOnceMoreAreOneSight) {
  Audience audience;
  audience.see(hall_at(1.0, 1, 0), Pose2{});
  for (int i = 0; i < 9; ++i) audience.see(hall_at(2.0, 5, 0), Pose2{});
  audience.see(hall_at(3.0, 1, 0), Pose2{});
  EXPECT_EQ(audience.count(), 1);
  audience.see(hall_at(0.5, 3, 0), Pose2{});
  EXPECT_EQ(audience.count(), 3) << "a clock that was set";
}

TEST(Audience, NobodyIsCountedWhereTheRobotDoesNotKnowItsPlace) {
  Audience audience;
  audience.see(hall_at(1.0, 5, 0), Pose2{});
  audience.see(hall_at(2.0, 5, 0), std::nullopt);
  EXPECT_EQ(audience.count(), 0);
}

}  // namespace
}  // namespace docent::telepresence
