#include "docent/evaluation/deployment_evaluator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

/// A run written by hand: true states ten times a second, other messages in between.
class Story {
 public:
  template <class T>
  void say(const Topic<T>& topic, T message) {
    evaluator_.add(transport::topic_info(topic), time_, std::make_shared<const T>(std::move(message)));
  }
  /// Ten states a second for `duration` seconds; `change` is called before each.
  template <class F>
  void run(double duration, F change) {
    for (int i = 0; i < static_cast<int>(std::lround(duration * 10.0)); ++i) {
      time_ = time_ + seconds(0.1);
      change(state);
      state.distance_m += std::abs(state.linear) * 0.1;
      state.header.stamp = to_message(time_);
      say(topics::kTrueState, state);
    }
  }
  void run(double duration) {
    run(duration, [](docent_msgs::TrueState&) {});
  }
  void believe(double x, double y, double degrees, bool localized = true) {
    docent_msgs::Belief belief;
    belief.header.stamp = to_message(time_);
    belief.localized = localized;
    belief.hypotheses.push_back({x, y, Angle::degrees(degrees).radians(), {}, 0.99});
    say(topics::kBelief, belief);
  }
  void goal(const std::string& goal_state) {
    docent_msgs::GoalState message;
    message.id = "g";
    message.state = goal_state;
    say(topics::kGoalState, message);
  }
  void board(const std::vector<std::pair<std::string, std::string>>& requests) {
    docent_msgs::RequestBoard message;
    for (const auto& [id, request_state] : requests) {
      docent_msgs::RequestState entry;
      entry.request.id = id;
      entry.request.kind = "exhibit";
      entry.request.target = "vase";
      entry.request.source = "visitor";
      entry.state = request_state;
      entry.reason = request_state == "refused" ? "closed" : "";
      message.requests.push_back(entry);
    }
    say(topics::kRequestBoard, message);
  }
  void offer(const std::string& id) { say(topics::kTrueOffer, docent_msgs::TrueOffer{{}, "request", id}); }
  void event(const std::string& kind, const std::string& subject = "", double value = 0.0) {
    docent_msgs::Event message;
    message.kind = kind;
    message.subject = subject;
    message.value = value;
    say(topics::kEvent, message);
  }
  [[nodiscard]] DeploymentReport report() const { return evaluator_.report(); }

  docent_msgs::TrueState state;

 private:
  DeploymentEvaluator evaluator_;
  Time time_{1000000000};
};

TEST(DeploymentEvaluator, TheReportAlwaysSaysHowTheRobotWasCrippled) {
  Story story;
  const auto crippled = [&] { return nlohmann::json::parse(to_json(story.report(), std::nullopt)).at("crippled"); };
  EXPECT_EQ(crippled(), nlohmann::json::array());
  docent_msgs::RunInfo run;
  run.crippled = "blind_to_people, without_ladder";
  story.say(topics::kRunInfo, run);
  EXPECT_EQ(crippled(), nlohmann::json::array({"blind_to_people", "without_ladder"}));
}

TEST(DeploymentEvaluator, SpeedCountsBlockedTimeAndNothingWithoutAGoal) {
  Story story;
  story.run(0.1);
  story.state.linear = 0.5;
  story.run(10);  // pushed about without a goal
  story.goal("driving");
  story.run(20);
  story.goal("blocked");
  story.state.linear = 0.0;
  story.run(5);
  story.goal("driving");
  story.state.linear = 0.8;
  story.run(10);
  story.goal("arrived");
  story.run(3);
  const auto report = story.report();
  EXPECT_NEAR(report.virtual_seconds, 48.0, 1e-6);
  EXPECT_NEAR(report.travel_seconds, 35.0, 1e-6);
  EXPECT_NEAR(report.standing_seconds, 5.0, 0.11);
  EXPECT_NEAR(report.travel_distance_m, 18.0, 1e-6);
  EXPECT_NEAR(report.distance_m, 25.4, 1e-6);
  EXPECT_NEAR(report.max_speed_mps, 0.8, 1e-9);
  EXPECT_EQ(report.blocked.events, 1);
  EXPECT_NEAR(report.blocked.seconds, 5.0, 1e-6);
}

TEST(DeploymentEvaluator, ATripEndsWhereTheRobotHasComeToItsPlace) {
  Story story;
  story.run(0.1);
  story.goal("driving");
  story.state.linear = 0.5;
  story.run(20);
  story.goal("blocked");
  story.state.linear = 0.0;
  story.run(5);
  story.goal("turning");
  story.run(4);
  story.goal("arrived");
  story.run(3);
  const auto trips = story.report().trips;
  ASSERT_EQ(trips.size(), 1U);
  EXPECT_NEAR(trips[0].seconds, 25.0, 1e-6);
  EXPECT_NEAR(trips[0].distance_m, 10.0, 1e-6);
}

TEST(DeploymentEvaluator, TurningToFindItselfIsNoTravel) {
  Story story;
  story.run(0.1);
  docent_msgs::DriveGoal goal;
  goal.id = "g";
  goal.relocalize = true;
  story.say(topics::kDriveGoal, goal);
  story.goal("turning");
  story.run(10);
  EXPECT_EQ(story.report().travel_seconds, 0.0);
}

TEST(DeploymentEvaluator, ContactsFollowTheRule) {
  struct Case {
    const char* kind;
    double robot, other;
    bool braked;
    bool counts;
  };
  const Case cases[] = {
      {"walls", 0.0, 0.0, true, true},     {"furniture", 0.01, 0.0, false, true}, {"hazards", 0.0, 0.0, false, true},
      {"people", 0.3, 0.0, false, true},   {"people", 0.05, 1.0, false, false},  // walked into a standing robot
      {"people", 0.3, 1.0, true, false},                                         // braked, and they were faster
      {"people", 0.3, 0.2, true, true},                                          // braked, but the robot was faster
      {"people", 0.3, 1.0, false, true},                                         // did not brake
      {"people", -0.2, 1.0, false, false},                                       // driving away from them
  };
  for (const Case& c : cases) {
    Story story;
    story.run(0.1);
    docent_msgs::TrueContact contact;
    contact.kind = c.kind;
    contact.robot_speed = c.robot;
    contact.other_speed = c.other;
    contact.braked_in_time = c.braked;
    story.say(topics::kTrueContact, contact);
    const auto report = story.report();
    EXPECT_EQ(report.contacts.all(), c.counts ? 1 : 0) << c.kind << c.robot << c.other << c.braked;
    EXPECT_EQ(report.bumped_by_people, c.counts ? 0 : 1);
  }
}

TEST(DeploymentEvaluator, AreaViolationsAreEpisodes) {
  Story story;
  story.run(1);
  story.state.inside_area = false;
  story.run(3);
  story.state.inside_area = true;
  story.run(1);
  story.state.inside_area = false;
  story.run(1);
  EXPECT_EQ(story.report().area_violations, 2);
}

TEST(DeploymentEvaluator, PassesArePersonsNearAMovingRobot) {
  Story story;
  docent_msgs::TruePerson person;
  person.id = 7;
  person.radius = 0.25F;
  story.state.people = {person};
  const auto walk = [&](double from, double to, double speed) {
    story.run(2, [&, step = 0](docent_msgs::TrueState& state) mutable {
      state.linear = speed;
      const double x = from + (to - from) * step++ / 19.0;
      state.people[0].x = static_cast<float>(x);
      state.nearest_person_m = x - 0.25 - 0.265;
    });
  };
  walk(5.0, 1.0, 0.5);  // near: one pass
  walk(1.0, 1.6, 0.5);  // 1.08 m away: still the same
  walk(1.6, 1.2, 0.5);
  walk(1.2, 4.0, 0.5);
  walk(4.0, 1.0, 0.0);  // the robot stands: none
  walk(1.0, 4.0, 0.0);
  walk(4.0, 1.0, 0.5);  // another
  EXPECT_EQ(story.report().passes_within_1m, 2);
}

TEST(DeploymentEvaluator, LocalizationIsHeldAgainstTheTruthOfTheMoment) {
  Story story;
  story.run(20, [&](docent_msgs::TrueState& state) {
    story.believe(0, 0, 0, false);
    state.linear = 0.5;
    state.x += 0.05;
  });
  story.run(30, [&](docent_msgs::TrueState& state) {
    state.x += 0.05;
    story.believe(state.x + 0.03, 0.04, 2.0);  // 5 cm off the state of this very time
  });
  const auto report = story.report();
  ASSERT_TRUE(report.localization.localized_after_s);
  EXPECT_NEAR(*report.localization.localized_after_s, 20.0, 0.3);
  EXPECT_NEAR(report.localization.error_m.mean(), 0.05, 1e-9);
  EXPECT_NEAR(report.localization.p95_error_m, 0.05, 0.01 * 0.05);
  EXPECT_NEAR(report.localization.heading_error_deg.mean(), 2.0, 1e-9);
  EXPECT_EQ(report.localization.lost_events, 0);
  EXPECT_EQ(report.localization.lost_s, 0.0);
}

TEST(DeploymentEvaluator, SureAndWrongIsLost) {
  Story story;
  const auto believe_off_by = [&](double error, double duration) {
    story.run(duration, [&](docent_msgs::TrueState& state) { story.believe(state.x + error, 0, 0); });
  };
  believe_off_by(3.0, 30);  // sure, but wrong: not localized
  EXPECT_FALSE(story.report().localization.localized_after_s);
  EXPECT_NEAR(story.report().localization.wrong_but_sure_s, 30.0, 0.3);
  believe_off_by(0.1, 5);
  EXPECT_FALSE(story.report().localization.localized_after_s);  // must stay so for 10 s
  believe_off_by(0.1, 20);
  EXPECT_NEAR(story.report().localization.localized_after_s.value_or(0), 30.0, 0.3);
  believe_off_by(0.7, 0.5);  // a flicker is no event
  believe_off_by(0.1, 5);
  EXPECT_EQ(story.report().localization.lost_events, 0);
  believe_off_by(0.7, 8);
  believe_off_by(0.1, 1);  // found for too short a time: the same event
  believe_off_by(0.7, 8);
  believe_off_by(0.1, 5);
  EXPECT_EQ(story.report().localization.lost_events, 1);
  EXPECT_NEAR(story.report().localization.lost_s, 16.5, 0.5);
}

TEST(DeploymentEvaluator, SilenceWhileDrivingIsLost) {
  Story story;
  story.run(15, [&](docent_msgs::TrueState& state) { story.believe(state.x, 0, 0); });
  story.run(10);  // silent, but standing: still right
  EXPECT_EQ(story.report().localization.lost_s, 0.0);
  story.run(10, [](docent_msgs::TrueState& state) {
    state.linear = 0.5;
    state.x += 0.05;
  });
  EXPECT_EQ(story.report().localization.lost_events, 1);
  EXPECT_NEAR(story.report().localization.lost_s, 8.0, 0.5);
}

TEST(DeploymentEvaluator, RequestsAreCountedOnce) {
  Story story;
  for (const char* id : {"a", "b", "c", "d", "e", "gone"}) story.offer(id);
  story.board({{"a", "queued"}, {"b", "queued"}, {"c", "refused"}, {"d", "queued"}, {"e", "queued"}});
  story.run(100);
  story.board({{"a", "fulfilled"}, {"b", "failed"}, {"c", "refused"}, {"d", "cancelled"}, {"e", "queued"}});
  story.board({{"a", "fulfilled"}, {"b", "failed"}, {"c", "refused"}, {"d", "cancelled"}, {"e", "queued"}});
  story.run(700);
  story.offer("late");  // in the last ten minutes: not counted, whatever becomes of it
  story.offer("late and quick");
  story.board({{"late and quick", "fulfilled"}});
  story.run(100);
  const auto report = story.report();
  EXPECT_EQ(report.requests.offered, 8);
  EXPECT_EQ(report.requests.fulfilled, 2);
  EXPECT_EQ(report.requests.failed, 1);
  EXPECT_EQ(report.requests.refused, (std::map<std::string, int>{{"closed", 1}}));
  EXPECT_EQ(report.requests.cancelled, 1);
  EXPECT_EQ(report.requests.open, 3);
  EXPECT_EQ(report.requests.never_seen, 2);
  EXPECT_EQ(report.requests.counted, 5);
  EXPECT_EQ(report.requests.counted_served, 1);
  ASSERT_TRUE(report.success_rate);
  EXPECT_NEAR(*report.success_rate, 1.0 / 5.0, 1e-12);  // a of a, b, c, e, gone
}

TEST(DeploymentEvaluator, AnExplanationElsewhereDoesNotCount) {
  // The plan controller visits, a GOLOG program drives there.
  for (const auto& [x, kind] : {std::pair{5.2, "visit"}, std::pair{8.0, "visit"}, std::pair{8.0, "drive"}}) {
    Story story;
    story.offer("a");
    docent_msgs::Task task;
    task.kind = kind;
    task.exhibit_id = "vase";
    task.x = 5.0;
    story.say(topics::kTask, task);
    story.state.x = x;
    story.run(10);
    story.event("explained", "vase");
    story.board({{"a", "fulfilled"}});
    story.run(700);
    const auto report = story.report();
    const bool in_place = x < 6.0;
    EXPECT_EQ(report.exhibits_explained, in_place ? 1 : 0);
    EXPECT_EQ(report.explained_in_wrong_place, in_place ? 0 : 1);
    EXPECT_EQ(report.requests.fulfilled, in_place ? 1 : 0);
    EXPECT_EQ(report.requests.in_wrong_place, in_place ? 0 : 1);
    EXPECT_NEAR(report.success_rate.value_or(-1), in_place ? 1.0 : 0.0, 1e-12);
  }
}

TEST(DeploymentEvaluator, ToursAreTimedByTheClock) {
  Story story;
  story.run(1);
  for (const double duration : {300.0, 400.0}) {
    story.event("tour_started", "short", 360.0);
    story.run(duration);
    story.event("tour_completed", "short", 1.0);
  }
  story.event("tour_started", "long");
  story.run(10);
  story.event("tour_cancelled", "long");
  const auto report = story.report();
  EXPECT_EQ(report.tours.given, 3);
  EXPECT_EQ(report.tours.completed, 2);
  EXPECT_NEAR(report.tours.target_s.mean(), 360.0, 1e-9);
  EXPECT_NEAR(report.tours.seconds.mean(), 350.0, 1e-6);
  EXPECT_NEAR(report.tours.seconds.deviation(), 70.7107, 1e-3);
}

TEST(DeploymentEvaluator, PeopleAreMatchedOneToOneWithinFiveMetres) {
  Story story;
  const auto person = [](std::uint32_t id, float x, bool visible) {
    docent_msgs::TruePerson p;
    p.id = id;
    p.x = x;
    p.visible = visible;
    return p;
  };
  story.state.people = {person(1, 1, true), person(2, 3, true), person(3, 4, false), person(4, 8, true)};
  story.state.nearest_person_m = 0.7;
  story.run(15, [&](docent_msgs::TrueState&) { story.believe(0, 0, 0); });
  const auto track = [](float x) {
    docent_msgs::Person p;
    p.x = x;
    return p;
  };
  docent_msgs::People people;
  people.localized = true;
  people.header.stamp = story.state.header.stamp;
  people.people = {track(1.1F), track(1.3F), track(4.2F), track(7.9F)};
  story.say(topics::kPeople, people);
  story.run(1);
  const auto report = story.report();
  EXPECT_EQ(report.people.present, 2U);  // the hidden and the far one do not count
  EXPECT_EQ(report.people.found, 1U);
  EXPECT_EQ(report.people.claimed, 3U);
  EXPECT_EQ(report.people.right, 2U);  // one person is not found twice; a hidden one may be known
}

TEST(DeploymentEvaluator, BatteryAndRestarts) {
  Story story;
  const auto battery = [&](double from, double to) {
    story.run(20,
              [&, i = 0](docent_msgs::TrueState& state) mutable { state.battery = from + (to - from) * i++ / 199.0; });
  };
  battery(1.0, 0.2);
  battery(0.2, 0.9);
  battery(0.9, 0.0);
  battery(0.0, 1.0);
  docent_msgs::Health health;
  health.module = "plan";
  for (const int pid : {10, 10, 11, 11, 12}) {
    health.pid = pid;
    story.say(topics::kHealth, health);
  }
  const auto report = story.report();
  EXPECT_EQ(report.battery.charges, 2);
  EXPECT_EQ(report.battery.depleted, 1);
  EXPECT_EQ(report.module_restarts, 2);
}

}  // namespace
}  // namespace docent::evaluation
