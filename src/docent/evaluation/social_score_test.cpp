#include "docent/evaluation/social_score.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

constexpr double kRadius = 0.25;

/// The robot at x with `speed` along x; one person of radius 0.25 at (px, py).
docent_msgs::TrueState state_at(double time, double x, double speed, double px, double py) {
  docent_msgs::TrueState state;
  state.header.stamp = to_message(time_from_seconds(time));
  state.x = x;
  state.linear = speed;
  docent_msgs::TruePerson person;
  person.x = static_cast<float>(px);
  person.y = static_cast<float>(py);
  person.radius = 0.25F;
  state.people.push_back(person);
  return state;
}

SocialScore score(double limit = 100.0) { return {time_from_seconds(0.0), {5.0, 0.0}, 0.5, limit, kRadius}; }

TEST(SocialScore, CountsTheSpacesOfTheNearestPersonFromTheOutlineToTheMiddle) {
  SocialScore result = score();
  result.add(state_at(0.0, 0.0, 0.0, 0.69, 0.0));
  result.add(state_at(1.0, 0.0, 0.0, 0.69, 0.0));  // 0.44 m
  result.add(state_at(2.0, 0.0, 0.0, 0.71, 0.0));  // 0.46 m
  result.add(state_at(3.0, 0.0, 0.0, 1.46, 0.0));  // 1.21 m
  result.add(state_at(4.0, 0.0, 0.0, 4.0, 0.0));
  const SocialReport report = result.report();
  EXPECT_DOUBLE_EQ(report.intimate_s, 1.0);
  EXPECT_DOUBLE_EQ(report.personal_s, 1.0);
  EXPECT_DOUBLE_EQ(report.social_s, 1.0);
  EXPECT_DOUBLE_EQ(report.not_moving_s, 4.0);
  EXPECT_NEAR(report.least_m, 0.19, 1e-6);
  EXPECT_DOUBLE_EQ(report.intimate_closing_s, 0.0) << "it stands";
}

TEST(SocialScore, ClosesAGapOnlyByTheRobotsOwnVelocity) {
  SocialScore result = score();
  result.add(state_at(0.0, 0.0, 0.3, 0.6, 0.0));
  result.add(state_at(1.0, 0.0, 0.3, 0.6, 0.0));    // towards them
  result.add(state_at(2.0, 0.0, -0.3, 0.6, 0.0));   // away
  result.add(state_at(3.0, 0.0, 0.3, -0.6, 0.0));   // they are behind
  result.add(state_at(4.0, 0.0, 0.3, 0.0, 0.6));    // beside
  result.add(state_at(5.0, 0.0, 0.3, 0.9, 0.0));    // 0.4 m between the outlines, 0.65 to the middle
  result.add(state_at(6.0, 0.0, 0.015, 0.6, 0.0));  // as good as standing
  EXPECT_DOUBLE_EQ(result.report().intimate_closing_s, 1.0);
  EXPECT_DOUBLE_EQ(result.report().near_closing_s, 2.0);
}

TEST(SocialScore, EndsAtTheGoalOrWhenTheTimeIsOver) {
  SocialScore arrives = score();
  arrives.add(state_at(0.0, 0.0, 0.5, 0.0, 3.0));
  arrives.add(state_at(9.0, 4.6, 0.5, 0.0, 3.0));
  EXPECT_TRUE(arrives.is_over());
  arrives.add(state_at(12.0, 1.0, 0.5, 0.0, 3.0));
  EXPECT_TRUE(arrives.report().arrived);
  EXPECT_DOUBLE_EQ(arrives.report().seconds, 9.0);
  EXPECT_DOUBLE_EQ(arrives.report().path_m, 4.6);

  SocialScore late = score(5.0);
  late.add(state_at(0.0, 0.0, 0.5, 0.0, 3.0));
  late.add(state_at(5.0, 1.0, 0.5, 0.0, 3.0));
  EXPECT_TRUE(late.is_over());
  late.add(state_at(6.0, 5.0, 0.5, 0.0, 3.0));
  EXPECT_FALSE(late.report().arrived);
}

TEST(SocialScore, TellsAPushFromABump) {
  const auto touch = [](double time, const char* kind, double own, double other, bool braked) {
    docent_msgs::TrueContact contact;
    contact.header.stamp = to_message(time_from_seconds(time));
    contact.kind = kind;
    contact.robot_speed = own;
    contact.other_speed = other;
    contact.braked_in_time = braked;
    return contact;
  };
  SocialScore result = score();
  result.add(touch(1.0, "people", 0.2, 1.0, false));
  result.add(touch(2.0, "people", 0.2, 1.0, true));
  result.add(touch(3.0, "people", 0.2, 0.1, true));
  result.add(touch(4.0, "people", 0.05, 0.1, false));
  result.add(touch(5.0, "furniture", 0.0, 0.0, true));
  const auto json = nlohmann::json::parse(to_json(result.report()));
  EXPECT_EQ(json["contacts"]["people"], 2);
  EXPECT_EQ(json["contacts"]["furniture"], 1);
  EXPECT_EQ(json["contacts"]["walls"], 0);
  EXPECT_EQ(json["bumped_by_people"], 2);
}

}  // namespace
}  // namespace docent::evaluation
