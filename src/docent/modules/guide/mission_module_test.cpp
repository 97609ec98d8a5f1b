#include "docent/modules/guide/mission_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "docent/interaction/speech/sentences.h"
#include "docent/messages/conversions.h"
#include "docent/modules/guide/tour_rehearsal_for_test.h"
#include "docent/task_control/mission/mission.h"
#include "docent/vocabulary/reason.h"

namespace docent::modules {
namespace {

TEST(Tour, AnExhibitIsReachedExplainedAndTheRobotGoesHome) {
  Rehearsal rehearsal{1, "exhibit"};
  rehearsal.run_for(10);
  rehearsal.client.wish_for("r1", "exhibit", "breeze");
  rehearsal.run_for(2);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "active");
  EXPECT_EQ(rehearsal.mission.phase, "driving");
  EXPECT_EQ(rehearsal.mission.languages, (std::vector<std::string>{"en", "de"}));
  EXPECT_EQ(rehearsal.mission.texts, (std::vector<std::string>{"I am on my way to the breeze. Please follow me!",
                                                               "Nächstes Ziel: Das breeze. Bitte folgen Sie mir!"}));
  rehearsal.run_for(60);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "fulfilled");
  EXPECT_EQ(rehearsal.mission.phase, "idle");
  EXPECT_LT(norm(rehearsal.plan.position), 0.1);
  EXPECT_EQ(rehearsal.mission.exhibits_explained, 1U);
  EXPECT_EQ(rehearsal.mission.requests_served, 1U);
  EXPECT_EQ(rehearsal.events_of("explained"), std::vector<std::string>{"breeze"});
  for (const char* kind :
       {"request_queued", "request_active", "visit_started", "arrived", "request_fulfilled", "home"}) {
    EXPECT_FALSE(rehearsal.events_of(kind).empty()) << kind;
  }
}

TEST(Tour, MoreIsOfferedForFiveSecondsAndNextIsTheDefault) {
  Rehearsal rehearsal{2, "more"};
  rehearsal.client.wish_for("r1", "exhibit", "air");
  while (rehearsal.task_state.prompt.id.empty()) rehearsal.run_for(0.1);
  const auto prompt = rehearsal.task_state.prompt;
  EXPECT_EQ(prompt.options, (std::vector<std::string>{"more", "next"}));
  EXPECT_EQ(prompt.default_option, "next");
  EXPECT_EQ(prompt.languages, (std::vector<std::string>{"en", "de"})) << "of the museum, whatever is spoken";
  EXPECT_EQ(prompt.texts.at(1), interaction::sentence(interaction::Sentence::offer_more, "de", Mood::neutral, 0));
  EXPECT_NEAR(to_seconds(from_message(prompt.deadline) - rehearsal.hub.now()), 5.0, 0.2);
  EXPECT_EQ(rehearsal.mission.prompt.id, prompt.id);
  rehearsal.run_for(4.7);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "active");
  rehearsal.run_for(1.0);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "fulfilled");
  EXPECT_FALSE(rehearsal.task_state.took_long);
}

TEST(Tour, WhoWantsMoreHearsTheLongText) {
  Rehearsal rehearsal{3, "long"};
  const auto visitor = rehearsal.hub.connect("visitor");
  const auto choice = visitor->publisher(topics::kChoice);
  rehearsal.client.wish_for("r1", "exhibit", "air");
  while (rehearsal.task_state.prompt.id.empty()) rehearsal.run_for(0.1);
  choice.publish({"c0", "another question", "more", "kiosk"});
  choice.publish({"c1", rehearsal.task_state.prompt.id, "more", "kiosk"});
  rehearsal.run_for(30);
  const bool heard = std::any_of(rehearsal.speeches.begin(), rehearsal.speeches.end(),
                                 [](const auto& speech) { return speech.text == "There is much more to tell."; });
  EXPECT_TRUE(heard);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "fulfilled");
}

TEST(Tour, RequestsForOneExhibitAreMerged) {
  Rehearsal rehearsal{4, "merge"};
  rehearsal.run_for(5);
  rehearsal.client.wish_for("r1", "exhibit", "cloud");
  rehearsal.client.wish_for("r2", "exhibit", "cloud");
  rehearsal.run_for(5);
  rehearsal.client.wish_for("r3", "exhibit", "cloud");  // it is under way already
  rehearsal.run_for(90);
  for (const char* id : {"r1", "r2", "r3"}) EXPECT_EQ(rehearsal.client.state_of(id), "fulfilled") << id;
  EXPECT_EQ(rehearsal.mission.exhibits_explained, 1U);
}

TEST(Tour, AWholeTourInItsOrder) {
  Rehearsal rehearsal{5, "tour"};
  rehearsal.client.wish_for("t1", "tour", "all");
  rehearsal.run_for(240);
  EXPECT_EQ(rehearsal.events_of("explained"), rehearsal.museum.tours[0].exhibits);
  EXPECT_EQ(rehearsal.client.state_of("t1"), "fulfilled");
  EXPECT_EQ(rehearsal.mission.tours_completed, 1U);
}

TEST(Tour, RefusesInWords) {
  Rehearsal rehearsal{6, "refuse"};
  const auto operator_page = rehearsal.hub.connect("operator");
  rehearsal.client.wish_for("r1", "exhibit", "nowhere");
  rehearsal.client.wish_for("r2", "tour", "nowhere");
  rehearsal.client.wish_for("r3", "dance", "air");
  rehearsal.client.wish({"r4", {}, "visitor", "Bob", "exhibit", "fog", -1, "en"});
  rehearsal.client.wish_for("r5", "exhibit", "fog");
  rehearsal.run_for(3);
  operator_page->publisher(topics::kLimits).publish({0.7, 1.0, "open", false});
  rehearsal.run_for(3);
  rehearsal.client.wish_for("r6", "exhibit", "air");
  rehearsal.run_for(60);
  for (const char* id : {"r1", "r2", "r3", "r4", "r6"}) {
    EXPECT_EQ(rehearsal.client.state_of(id), "refused") << id;
    EXPECT_TRUE(Reason::from_text(rehearsal.client.states[id].reason).word()) << id;
  }
  EXPECT_EQ(rehearsal.client.state_of("r5"), "fulfilled") << "the Web may see it";
}

TEST(Tour, AGoalPoseIsAWishOfTheStaffWhereItIsAllowed) {
  Rehearsal rehearsal{8, "goal_pose"};
  const auto rviz = rehearsal.hub.connect("rviz");
  const auto goal = rviz->publisher(topics::kGoalPose);
  const auto wishes = [&] {
    std::vector<docent_msgs::RequestState> found;
    for (const auto& [id, state] : rehearsal.client.states)
      if (state.request.kind == "point") found.push_back(state);
    return found;
  };
  geometry_msgs::PoseStamped there;
  there.header.frame_id = "map";
  there.pose.position = {2.0, 1.5, 0.0};
  rehearsal.run_for(5);
  goal.publish(there);
  rehearsal.run_for(3);
  EXPECT_TRUE(wishes().empty()) << "robot.yaml does not allow it";

  rehearsal.kill("mission");
  ASSERT_TRUE(rehearsal.config.set("mission.goal_poses=true"));
  rehearsal.start("mission");
  rehearsal.run_for(5);
  there.header.frame_id = "odom";
  goal.publish(there);
  rehearsal.run_for(3);
  EXPECT_TRUE(wishes().empty()) << "of another frame";
  there.header.frame_id = "map";
  goal.publish(there);
  rehearsal.run_for(60);
  ASSERT_EQ(wishes().size(), 1U);
  EXPECT_EQ(wishes()[0].request.source, "staff");
  EXPECT_EQ(wishes()[0].request.target, "2.00,1.50,0.00") << "an unset quaternion of ROS 2 has w 1";
  EXPECT_EQ(wishes()[0].state, "fulfilled");
  there.pose.orientation = to_quaternion(Angle::degrees(-90.0));
  goal.publish(there);
  rehearsal.run_for(60);
  there.pose.orientation = {0.0, 0.0, 0.0, 0.0};
  goal.publish(there);
  rehearsal.run_for(60);
  std::map<std::string, std::string> states;
  for (const auto& wish : wishes()) states[wish.request.target] = wish.state;
  EXPECT_EQ(states["2.00,1.50,-1.57"], "fulfilled") << "which way it looks then is asked for";
  EXPECT_EQ(states.size(), 2U) << "zeros are no orientation: refused";
}

TEST(Tour, AnUnreachableExhibitIsTriedAgainThenFails) {
  Rehearsal rehearsal{7, "unreachable"};
  rehearsal.plan.unreachable.insert({10, 0});
  rehearsal.client.wish_for("r1", "exhibit", "breeze");
  rehearsal.client.wish_for("t1", "tour", "all");
  rehearsal.run_for(1800);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "failed");
  EXPECT_EQ(rehearsal.client.states["r1"].reason, "no_way");
  EXPECT_EQ(rehearsal.client.state_of("t1"), "fulfilled") << "one exhibit may be skipped";
  EXPECT_EQ(rehearsal.client.states["t1"].reason, "not_reached breeze");
}

TEST(Tour, AsksForTheWayPolitelyAndComesAgain) {
  Rehearsal rehearsal{8, "blocked"};
  rehearsal.run_for(20);
  rehearsal.client.wish_for("r1", "exhibit", "breeze");
  rehearsal.run_for(3);
  rehearsal.plan.blocked_until = rehearsal.hub.now() + seconds(130);
  rehearsal.run_for(80);
  const auto asked = rehearsal.events_of("asked_for_way").size();
  EXPECT_GE(asked, 4U);
  EXPECT_LE(asked, 6U);
  EXPECT_EQ(rehearsal.mission.texts.at(0), "I would like to go to the breeze, but someone is in my way.");
  rehearsal.run_for(250);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "fulfilled");
}

TEST(Tour, LosingThePlaceSuspendsTheVisitAndResumesIt) {
  Rehearsal rehearsal{9, "lost"};
  rehearsal.plan.is_localized = false;
  rehearsal.client.wish_for("r1", "exhibit", "cloud");
  rehearsal.run_for(10);
  EXPECT_EQ(rehearsal.mission.phase, "waking");
  EXPECT_EQ(rehearsal.client.state_of("r1"), "queued");
  EXPECT_EQ(rehearsal.task.kind, "relocalize");
  rehearsal.plan.is_localized = true;
  rehearsal.run_for(6);
  EXPECT_EQ(rehearsal.mission.phase, "driving");
  rehearsal.plan.is_localized = false;
  rehearsal.run_for(6);
  EXPECT_EQ(rehearsal.mission.phase, "relocalizing");
  EXPECT_EQ(rehearsal.client.state_of("r1"), "active");
  rehearsal.plan.is_localized = true;
  rehearsal.run_for(90);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "fulfilled");
  EXPECT_EQ(rehearsal.told["r1"].size(), 1U);
}

TEST(Tour, ADeadSoundModuleDoesNotStopIt) {
  Rehearsal rehearsal{10, "mute"};
  rehearsal.kill("sound");
  rehearsal.client.wish_for("r1", "exhibit", "air");
  rehearsal.run_for(90);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "fulfilled");
}

TEST(Tour, AWishCanBeTakenBack) {
  Rehearsal rehearsal{11, "cancel"};
  rehearsal.run_for(10);
  rehearsal.client.wish_for("r1", "exhibit", "cloud");
  rehearsal.client.wish_for("r2", "exhibit", "echo");
  rehearsal.client.wish_for("t1", "tour", "all");
  rehearsal.run_for(4);
  const std::string under_way = rehearsal.task.exhibit_id;
  rehearsal.client.wish_for("c1", "cancel", under_way == "cloud" ? "r1" : "r2");
  rehearsal.client.wish_for("c2", "cancel", "t1");
  rehearsal.client.wish_for("c3", "cancel", "unknown");
  rehearsal.run_for(120);
  EXPECT_EQ(rehearsal.client.state_of(under_way == "cloud" ? "r1" : "r2"), "cancelled");
  EXPECT_EQ(rehearsal.client.state_of(under_way == "cloud" ? "r2" : "r1"), "fulfilled");
  EXPECT_EQ(rehearsal.client.state_of("t1"), "cancelled");
  EXPECT_EQ(rehearsal.client.state_of("c1"), "fulfilled");
  EXPECT_EQ(rehearsal.client.state_of("c3"), "refused");
  EXPECT_EQ(rehearsal.mission.exhibits_explained, 1U);
}

/// Wishes come at random times, and modules die at random times and in the middle of publishing.
class TourOfDeaths {
 public:
  explicit TourOfDeaths(std::uint64_t seed) : rehearsal{seed, "deaths"}, rng_{seed} {}
  void run() {
    for (double t = 0.0; t < 1500.0; t += kStep) {
      if (t < 600.0 && rng_.chance(kStep / 60.0)) wish();
      if (t < 1100.0 && rng_.chance(kStep / 15.0)) wound(t);
      start_again(t);
      for (const std::string& module : rehearsal.run_for(kStep)) schedule_start(t, module);
    }
  }

  Rehearsal rehearsal;
  std::vector<std::string> offered;  ///< ids of the wishes
  int deaths = 0;

 private:
  static constexpr double kStep = 0.5;  // [s]

  void wish() {
    const std::string id = "r" + std::to_string(offered.size());
    const bool is_tour = rng_.chance(0.15);
    const auto& exhibits = rehearsal.museum.exhibits;
    rehearsal.client.wish_for(
        id, is_tour ? "tour" : "exhibit",
        is_tour
            ? rng_.chance(0.5) ? "all" : "short"
            : exhibits[static_cast<std::size_t>(rng_.integer(0, static_cast<std::int64_t>(exhibits.size()) - 1))].id);
    offered.push_back(id);
  }
  void wound(double t) {
    static constexpr std::array<std::pair<const char*, const char*>, 7> kWounds{{{"docent/request_board", "mission"},
                                                                                 {"docent/task", "mission"},
                                                                                 {"docent/mission_state", "mission"},
                                                                                 {"docent/task_state", "executive"},
                                                                                 {"docent/say", "executive"},
                                                                                 {"docent/drive_goal", "executive"},
                                                                                 {"docent/speech_state", "sound"}}};
    const auto& [topic, module] = kWounds[static_cast<std::size_t>(rng_.integer(0, 6))];
    if (rng_.chance(0.6)) {
      rehearsal.kill_at(topic, module);
    } else if (rehearsal.is_up(module)) {
      rehearsal.kill(module);
      schedule_start(t, module);
    }
  }
  void schedule_start(double t, const std::string& module) {
    ++deaths;
    starts_.emplace_back(t + rng_.uniform(0.0, 6.0), module);
  }
  void start_again(double t) {
    for (std::size_t i = 0; i < starts_.size();) {
      if (starts_[i].first > t) {
        ++i;
        continue;
      }
      const std::string module = starts_[i].second;
      starts_.erase(starts_.begin() + static_cast<std::ptrdiff_t>(i));
      try {
        rehearsal.start(module);
      } catch (const Killed& death) {
        schedule_start(t, module);  // it died at its birth
      }
    }
  }

  Rng rng_;
  std::vector<std::pair<double, std::string>> starts_;  ///< time, module
};

void expect_all_told(Rehearsal& rehearsal, const std::vector<std::string>& offered) {
  for (const std::string& id : offered) {
    EXPECT_EQ(rehearsal.client.state_of(id), "fulfilled") << id;
    const auto& entry = rehearsal.client.states[id];
    const std::size_t times = entry.request.target == "all" ? 5U : 1U;
    if (entry.request.kind == "exhibit" || times == 5U) {
      EXPECT_EQ(rehearsal.told[id].size(), times) << id;
    }
  }
  for (const auto& [request, tasks] : rehearsal.told) {
    for (const std::string& task : tasks) EXPECT_TRUE(rehearsal.heard.contains(task + "/short")) << task;
  }
}

void expect_nothing_twice(const Rehearsal& rehearsal) {
  std::map<std::string, int> begun;
  for (const auto& speech : rehearsal.speeches) ++begun[speech.id];
  for (const auto& [id, times] : begun) EXPECT_EQ(times, 1) << "said again: " << id;
  std::map<std::string, int> once;
  for (const auto& event : rehearsal.events) {
    if (event.kind == "arrived" || event.kind == "prompt_shown") ++once[event.kind + " " + event.detail];
  }
  for (const auto& [what, times] : once) EXPECT_EQ(times, 1) << what;
}

TEST(Tour, RequestsSurviveDeathsInAnyOrder) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    TourOfDeaths tour{seed};
    tour.run();
    EXPECT_GT(tour.deaths, 20);
    ASSERT_GT(tour.offered.size(), 2U);
    expect_all_told(tour.rehearsal, tour.offered);
    expect_nothing_twice(tour.rehearsal);
    EXPECT_EQ(tour.rehearsal.mission.phase, "idle");
  }
}

TEST(Tour, WhatIsAmendedInItsMemoryIsForgottenWhenItStarts) {
  for (const bool forgets : {false, true}) {
    Rehearsal rehearsal{21, forgets ? "forgets" : "remembers"};
    robot::Amendments amendments;
    if (forgets) amendments.add<task_control::MissionMemory>([](auto& memory) { memory.schedule = {}; });
    rehearsal.config.set_amendments(std::move(amendments));
    rehearsal.client.wish_for("r1", "exhibit", "cloud");
    rehearsal.run_for(2);
    EXPECT_EQ(rehearsal.client.state_of("r1"), "active");
    rehearsal.kill("mission");
    rehearsal.start("mission");
    rehearsal.run_for(90);
    EXPECT_EQ(rehearsal.mission.requests_served, forgets ? 0U : 1U);
  }
}

TEST(Tour, ChargesServesAfterwardsAndSaysUntilWhen) {
  Rehearsal rehearsal{20, "charge"};
  rehearsal.museum.charger = Pose2{0.0, 3.0, Angle{}};
  rehearsal.kill("mission");
  rehearsal.start("mission");
  const auto base = rehearsal.hub.connect("base");
  const auto battery = base->publisher(topics::kBattery);
  double charge = 0.5;
  base->every(seconds(1), [&] {
    const bool is_charging = distance(rehearsal.plan.position, {0.0, 3.0}) < 0.2;
    charge = std::min(1.0, charge + (is_charging ? 2e-3 : -1e-4));
    sensor_msgs::BatteryState message;
    message.percentage = static_cast<float>(charge);
    message.power_supply_status = is_charging ? 1 : 2;
    message.present = false;  // as most drivers leave it
    battery.publish(std::move(message));
  });
  rehearsal.run_for(10);
  rehearsal.client.wish_for("t1", "tour", "all");
  rehearsal.run_for(2);
  charge = 0.06;
  rehearsal.run_for(60);
  EXPECT_EQ(rehearsal.events_of("tour_broken_off"), std::vector<std::string>{"all"});
  EXPECT_EQ(rehearsal.client.state_of("t1"), "queued");
  EXPECT_EQ(rehearsal.mission.phase, "charging");
  EXPECT_FALSE(rehearsal.events_of("charger").empty()) << "by it others see that the task was done";
  EXPECT_EQ(rehearsal.mission.texts.at(0),
            "I am charging my battery, for about 10 more minutes. I keep your wishes in mind.");
  rehearsal.client.wish_for("r1", "exhibit", "echo");
  rehearsal.run_for(5);
  EXPECT_EQ(rehearsal.client.state_of("r1"), "queued");
  for (const auto& speech : rehearsal.speeches) EXPECT_EQ(speech.text.find("Who would like"), std::string::npos);
  rehearsal.run_for(700);
  EXPECT_EQ(rehearsal.client.state_of("t1"), "fulfilled");
  EXPECT_EQ(rehearsal.client.state_of("r1"), "fulfilled");
}

TEST(Tour, TheHoursSayWhoIsServedAndHowLongItStays) {
  Rehearsal rehearsal{21, "hours"};
  rehearsal.museum.modes = {{"open", {0.7, 0.0, {}}}, {"web", {0.4, 30.0, {"10:05-10:30"}}}};
  const auto visitor = [](const std::string& id) {
    return docent_msgs::Request{id, {}, "visitor", "Bob", "exhibit", "breeze", -1, "en"};
  };
  rehearsal.client.wish(visitor("early"));
  rehearsal.run_for(100);
  EXPECT_EQ(rehearsal.client.state_of("early"), "fulfilled") << "virtual time begins at ten";
  rehearsal.run_for(220);
  rehearsal.client.wish(visitor("late"));
  rehearsal.client.wish_for("web", "exhibit", "air");
  rehearsal.run_for(5);
  EXPECT_EQ(rehearsal.client.state_of("late"), "refused");
  EXPECT_EQ(rehearsal.client.state_of("web"), "active");
  while (rehearsal.mission.phase != "explaining") rehearsal.run_for(0.5);
  const Time arrived = rehearsal.hub.now();
  while (rehearsal.client.state_of("web") == "active") rehearsal.run_for(0.5);
  EXPECT_GT(to_seconds(rehearsal.hub.now() - arrived), 35.0);
  EXPECT_LT(to_seconds(rehearsal.hub.now() - arrived), 55.0);
}

TEST(Tour, ADailyTourIsAnnouncedAndBeginsByItself) {
  Rehearsal rehearsal{22, "daily"};
  rehearsal.museum.tours[0].daily = {10 * 60 + 8};
  rehearsal.run_for(60);
  EXPECT_NE(rehearsal.mission.texts.at(0).find("10:08"), std::string::npos) << rehearsal.mission.texts.at(0);
  EXPECT_NE(rehearsal.mission.texts.at(1).find("10:08"), std::string::npos) << rehearsal.mission.texts.at(1);
  rehearsal.run_for(7 * 60 - 5);
  std::vector<std::string> languages;
  for (const auto& speech : rehearsal.speeches)
    if (speech.text.find("10:08") != std::string::npos) languages.push_back(speech.language);
  std::sort(languages.begin(), languages.end());
  languages.erase(std::unique(languages.begin(), languages.end()), languages.end());
  EXPECT_EQ(languages, (std::vector<std::string>{"de", "en"}));
  EXPECT_TRUE(rehearsal.events_of("explained").empty());
  rehearsal.run_for(240);
  EXPECT_EQ(rehearsal.events_of("explained"), rehearsal.museum.tours[0].exhibits);
  EXPECT_EQ(rehearsal.events_of("tour_completed").size(), 1U);
  EXPECT_EQ(rehearsal.mission.texts.at(0).find("10:08"), std::string::npos);
}

}  // namespace
}  // namespace docent::modules
