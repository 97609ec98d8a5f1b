#include "docent/evaluation/run_logs/event_log.h"

#include <gtest/gtest.h>

namespace docent::evaluation {
namespace {

template <class T>
void tell(EventLog& log, const Topic<T>& topic, double time, T message) {
  log.add(transport::topic_info(topic), time_from_seconds(time), std::make_shared<const T>(std::move(message)));
}

TEST(EventLog, HasARowForEveryEventWithPlaceAndGaze) {
  EventLog log;
  docent_msgs::TrueState state;
  state.x = 1.5;
  state.y = -2.0;
  tell(log, topics::kTrueState, 100.0, state);
  tell(log, topics::kReaction, 102.5, {{}, "t1/drive", "horn", "somebody, in the way", 1.5, 1});
  docent_msgs::Gaze gaze;
  gaze.at = "way";
  gaze.bearing = 0.5;
  tell(log, topics::kGaze, 103.0, gaze);
  tell(log, topics::kEvent, 104.0, {{}, "arrived", "sputnik", "t1", 12.0});
  docent_msgs::TrueContact touch;
  touch.kind = "people";
  touch.what = "person-3";
  touch.robot_speed = 0.2;
  tell(log, topics::kTrueContact, 105.0, touch);
  tell(log, topics::kHealth, 106.0, {});
  EXPECT_EQ(log.rows(),
            "2.50,reaction,horn,t1/drive,somebody; in the way,1.500,1.500,-2.000,none,0.0\n"
            "4.00,event,arrived,sputnik,t1,12.000,1.500,-2.000,way,28.6\n"
            "5.00,contact,people,person-3,counts,0.200,1.500,-2.000,way,28.6\n");
}

TEST(EventLog, TellsOnceOfEveryDetourAndHowMuchLongerItIs) {
  EventLog log;
  tell(log, topics::kTrueState, 0.0, {});
  docent_msgs::GoalState goal;
  goal.id = "t1/drive";
  double time = 0.0;
  for (const char* detour : {"", "none", "local", "local", "global", "none"}) {
    goal.detour = detour;
    goal.detour_extra = std::string{detour} == "global" ? 12.5 : 1.0;
    tell(log, topics::kGoalState, time += 1.0, goal);
  }
  EXPECT_EQ(log.rows(),
            "3.00,way,local,t1/drive,,1.000,0.000,0.000,none,0.0\n"
            "5.00,way,global,t1/drive,,12.500,0.000,0.000,none,0.0\n"
            "6.00,way,none,t1/drive,,1.000,0.000,0.000,none,0.0\n");
}

}  // namespace
}  // namespace docent::evaluation
