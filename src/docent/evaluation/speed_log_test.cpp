#include "docent/evaluation/speed_log.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

void drive(SpeedLog& log, double time, double speed) {
  auto state = std::make_shared<docent_msgs::TrueState>();
  state->linear = speed;
  state->nearest_solid_m = 0.5;
  state->nearest_person_m = 2.0;
  log.add(topic_info(topics::kTrueState), time_from_seconds(time), state);
}

TEST(SpeedLog, HasFiveRowsASecondWithTheReasonOfTheMoment) {
  SpeedLog log;
  drive(log, 10.0, 0.5);
  drive(log, 10.1, 0.6);
  auto avoid = std::make_shared<docent_msgs::AvoidState>();
  avoid->state = "driving";
  avoid->reason = "people are near, and more";
  avoid->speed_cap = 0.25;
  log.add(topic_info(topics::kAvoidState), time_from_seconds(10.15), avoid);
  auto goal = std::make_shared<docent_msgs::GoalState>();
  goal->id = "7";
  goal->state = "driving";
  log.add(topic_info(topics::kGoalState), time_from_seconds(10.15), goal);
  drive(log, 10.2, 0.7);
  EXPECT_EQ(log.rows(),
            "0.00,0.000,0.000,0.500,0.000,0.500,2.000,,0.00,,idle\n"
            "0.20,0.000,0.000,0.700,0.000,0.500,2.000,driving,0.25,people are near; and more,driving\n");
}

}  // namespace
}  // namespace docent
