#include "docent/task_control/golex/executive.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "docent/base/files.h"
#include "docent/interaction/speech/sentences.h"
#include "docent/task_control/golex/checkpoint.h"
#include "docent/task_control/golex/executive_fixture.h"

namespace docent::task_control {
namespace {

TEST_F(ExecutiveTest, AVisitStepByStep) {
  EXPECT_EQ(drive->id, "") << "without a task it stays";
  start(visit("t1"));
  EXPECT_EQ(state.state, TaskStatus::driving);
  EXPECT_EQ(drive->map_from_base.theta.degrees(), 90.0);
  EXPECT_NE(said.back().text.find("Sputnik"), std::string::npos) << said.back().text;
  goal(GoalStatus::driving);
  goal(GoalStatus::turning);
  EXPECT_EQ(state.state, TaskStatus::driving);
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::explaining);
  EXPECT_EQ(said.back().id, "t1/short");
  EXPECT_EQ(said.back().text, "Sputnik. It was the first satellite.");
  speech("t1/short", SpeechStatus::speaking);
  speech("another", SpeechStatus::done);
  EXPECT_EQ(state.state, TaskStatus::explaining);
  speech("t1/short", SpeechStatus::done);
  EXPECT_EQ(state.state, TaskStatus::asking);
  EXPECT_EQ(state.question.default_option, Answer::next);
  executive.choose("t0/more", Answer::more, time());
  executive.choose(state.question.id, parse<Answer>("dance"), time());
  collect();
  EXPECT_EQ(state.state, TaskStatus::asking);
  executive.choose(state.question.id, Answer::more, time());
  collect();
  EXPECT_EQ(state.state, TaskStatus::explaining);
  EXPECT_EQ(said.back().text, "It weighed 83 kilograms.");
  EXPECT_TRUE(state.question.id.empty());
  speech("t1/long", SpeechStatus::done);
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_TRUE(state.took_long);
}

TEST_F(ExecutiveTest, TheFastVersionIsTheDefaultAfterFiveSeconds) {
  start(visit("t1"));
  goal(GoalStatus::arrived);
  speech("t1/short", SpeechStatus::done);
  const double asked = now_s;
  while (state.state == TaskStatus::asking) pass(0.25);
  EXPECT_NEAR(now_s - asked, 5.0, 0.3);
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_EQ(happenings.back().kind, EventKind::choice);
}

TEST_F(ExecutiveTest, NothingMoreToTellMeansNoQuestion) {
  start(visit("t1", false));
  goal(GoalStatus::arrived);
  speech("t1/short", SpeechStatus::done);
  EXPECT_EQ(state.state, TaskStatus::done);
}

TEST_F(ExecutiveTest, ADeadSoundModuleHoldsNothingUp) {
  start(visit("t1"));
  goal(GoalStatus::arrived);
  const double began = now_s;
  while (state.state == TaskStatus::explaining) pass(0.25);
  EXPECT_GT(now_s - began, 5.0);
  EXPECT_LT(now_s - began, 12.0);
  EXPECT_GE(count("t1/short"), 5) << "it repeats the order until it is heard";
}

TEST_F(ExecutiveTest, AVoiceThatDiesInTheMiddleHoldsNothingUp) {
  start(visit("t1"));
  goal(GoalStatus::arrived);
  speech("t1/short", SpeechStatus::speaking, 20.0);
  pass(24.0);
  EXPECT_EQ(state.state, TaskStatus::explaining);
  pass(2.0);
  EXPECT_EQ(state.state, TaskStatus::asking);
}

TEST_F(ExecutiveTest, ABlockedWayIsAskedForAndThenGivenUp) {
  start(visit("t1"));
  said.clear();
  goal(GoalStatus::driving);
  for (int i = 0; i < 85; ++i) {
    pass(1.0);
    goal(GoalStatus::blocked);
  }
  EXPECT_EQ(state.state, TaskStatus::driving);
  EXPECT_EQ(state.reason, ReasonWord::person_in_way);
  EXPECT_GE(said.size(), 5U);
  EXPECT_LE(said.size(), 6U) << "at most every fifteen seconds";
  for (std::size_t i = 1; i < said.size(); ++i) EXPECT_NE(said[i].id, said[i - 1].id);
  goal(GoalStatus::driving);
  pass(4.0);
  EXPECT_EQ(state.reason, Reason{});
  EXPECT_EQ(rungs.back(), Rung::free);
  for (int i = 0; i < 92; ++i) {
    if (state.state == TaskStatus::driving) goal(GoalStatus::blocked);
    pass(1.0);
  }
  EXPECT_EQ(state.state, TaskStatus::failed);
  EXPECT_EQ(state.reason, ReasonWord::way_blocked);
  EXPECT_EQ(rungs.back(), Rung::give_up);
  EXPECT_EQ(drive->id, "") << "it stays where it is";
}

TEST_F(ExecutiveTest, ADriveToAndFroBetweenClosedWaysIsGivenUp) {
  const auto drive_for = [&](double seconds_driven, double nearest_m, bool comes_nearer) {
    start(visit("t" + std::to_string(now_s)));
    const double began = now_s;
    while (now_s - began < seconds_driven && state.state == TaskStatus::driving) {
      const double way_m = std::abs(std::fmod(now_s - began, 40.0) - 20.0) / 2.0;  // 10 m to and fro
      const double progress_m = comes_nearer ? 0.05 * (now_s - began) : 0.0;
      executive.goal_report({drive->id, GoalStatus::driving, nearest_m + way_m - progress_m, 0.0, 0.0, "", "global"},
                            time());
      collect();
      pass(0.5);
    }
    return now_s - began;
  };
  const double vain_s = drive_for(500.0, 30.0, false);
  EXPECT_EQ(state.state, TaskStatus::failed);
  EXPECT_GT(vain_s, 20.0 + 120.0 + 30.0 / 0.25);
  EXPECT_LT(vain_s, 20.0 + 120.0 + 40.0 / 0.25 + 1.0);
  drive_for(500.0, 30.0, true);
  EXPECT_EQ(state.state, TaskStatus::driving) << "it comes nearer, though slowly";
}

TEST_F(ExecutiveTest, ADriveThatIsInterruptedAgainAndAgainIsGivenUpAllTheSame) {
  // It loses its place every 40 s, and finds it within 5 s.
  const auto give_up_after = [&](double pause_s) {
    const double began = now_s;
    for (int i = 0; now_s - began < 900.0; ++i) {
      start(visit("t" + std::to_string(now_s)));
      for (double end = now_s + 40.0; now_s < end; pass(0.5)) {
        executive.goal_report({drive->id, GoalStatus::driving, 30.0, 25.0, 0.0, "", "global"}, time());
        collect();
        if (state.state == TaskStatus::failed) return now_s - began;
      }
      ExecutiveTask lost;
      lost.order.id = "lost" + std::to_string(now_s);
      lost.order.kind = TaskKind::relocalize;
      start(lost);
      pass(pause_s);
    }
    return 900.0;
  };
  const double patience_s = 120.0 + 30.0 / 0.25;
  const double vain_s = give_up_after(5.0);
  EXPECT_GT(vain_s, patience_s);
  EXPECT_LT(vain_s, 1.3 * patience_s) << "the pauses do not count";
  EXPECT_EQ(give_up_after(100.0), 900.0) << "long after, it is a drive of its own";
}

TEST_F(ExecutiveTest, APersonInTheWayIsBlownAtAndAsked) {
  start(visit("t1"));
  said.clear();
  goal(GoalStatus::driving);
  executive.obstacle_report({true, true, "person_in_way"}, time());
  pass(1.0);
  EXPECT_EQ(rungs, std::vector<Rung>{Rung::slow});
  for (int i = 0; i < 8; ++i) {
    executive.obstacle_report({true, true, "person_in_way"}, time());
    pass(1.0);
    goal(GoalStatus::blocked);
  }
  EXPECT_EQ(std::count(rungs.begin(), rungs.end(), Rung::horn), 2);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].text, "Please let me through.");
  executive.obstacle_report({}, time());
  goal(GoalStatus::driving);
  pass(30.0);
  EXPECT_EQ(said.size(), 1U);
}

TEST_F(ExecutiveTest, ADeadCollisionAvoidanceBlowsAtNobody) {
  start(visit("t1"));
  goal(GoalStatus::driving);
  for (int i = 0; i < 4; ++i) {
    executive.obstacle_report({true, true, "person_in_way"}, time());
    pass(1.0);
    goal(GoalStatus::blocked);
  }
  const auto horns = std::count(rungs.begin(), rungs.end(), Rung::horn);
  ASSERT_GE(horns, 1);
  for (int i = 0; i < 30; ++i) {  // its last word was that somebody stands there
    pass(1.0);
    goal(GoalStatus::blocked);
  }
  EXPECT_EQ(std::count(rungs.begin(), rungs.end(), Rung::horn), horns);
}

TEST_F(ExecutiveTest, AnUnreachablePlaceFailsAfterAShortPatience) {
  start(visit("t1"));
  for (int i = 0; i < 15; ++i) {
    goal(GoalStatus::unreachable);
    pass(1.0);
  }
  EXPECT_EQ(state.state, TaskStatus::driving);
  goal(GoalStatus::driving);
  for (int i = 0; i < 24 && state.state == TaskStatus::driving; ++i) {
    pass(1.0);
    goal(GoalStatus::unreachable);
  }
  EXPECT_EQ(state.state, TaskStatus::failed);
}

TEST_F(ExecutiveTest, ReportsOfOtherGoalsDoNotCount) {
  start(visit("t1"));
  executive.goal_report({"t0/drive", GoalStatus::arrived, 0.0, 0.0, 0.0, "", ""}, time());
  collect();
  EXPECT_EQ(state.state, TaskStatus::driving);
}

TEST_F(ExecutiveTest, HomeAndRelocalizing) {
  start({{"h", TaskKind::home, "", {0, 0, {}}, "de", false, ""}, "", "", ""});
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_EQ(said.back().id, "h/home_again");
  start({{"l", TaskKind::relocalize, "", {}, "en", false, ""}, "", "", ""});
  EXPECT_TRUE(drive->relocalize);
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::done);
  start({{"x", Word<TaskKind>{std::string{"dance"}}, "", {}, "en", false, ""}, "", "", ""});
  EXPECT_EQ(state.state, TaskStatus::failed);
  start({});
  EXPECT_EQ(drive->id, "");
  EXPECT_EQ(state.id, "");
}

TEST_F(ExecutiveTest, SaysFarewellWhereItStands) {
  start({{"f", TaskKind::farewell, "", {3, 4, {}}, "de", false, "space"}, "", "", ""});
  EXPECT_EQ(state.state, TaskStatus::explaining);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.back().id, "f/farewell");
  EXPECT_EQ(said.back().mood, Mood::happy);
  speech("f/farewell", SpeechStatus::speaking);
  pass(2.0);
  restart();
  EXPECT_EQ(state.state, TaskStatus::explaining) << "it is said again under the same id: heard once";
  speech("f/farewell", SpeechStatus::done);
  EXPECT_EQ(state.state, TaskStatus::done);
  now_s += 2000.0;
  saved.phase = Phase::running;
  restart();
  EXPECT_EQ(state.state, TaskStatus::done) << "nobody is there any more";
}

TEST_F(ExecutiveTest, ATourBeginsWithAGreeting) {
  ExecutiveTask first = visit("t1");
  first.order.tour_id = "space";
  start(first);
  EXPECT_EQ(said.back().id, "t1/greeting");
  EXPECT_EQ(state.state, TaskStatus::driving) << "it is not at its place yet";
  EXPECT_EQ(drive->id, "") << "it looks at the visitors";
  restart();
  EXPECT_EQ(state.state, TaskStatus::driving);
  speech("t1/greeting", SpeechStatus::done);
  EXPECT_EQ(said.back().id, "t1/announcement");
  EXPECT_EQ(drive->id, "t1/drive");
  start({});
  ExecutiveTask second = first;
  second.order.id = "t2";
  start(second);
  EXPECT_EQ(said.back().id, "t2/announcement");
  start({{"f", TaskKind::farewell, "", {3, 4, {}}, "en", false, "space"}, "", "", ""});
  ExecutiveTask again = first;
  again.order.id = "t3";
  start(again);
  EXPECT_EQ(said.back().id, "t3/greeting") << "others take the same tour";
  start(visit("t4"));
  EXPECT_EQ(said.back().id, "t4/announcement") << "no tour";
}

TEST_F(ExecutiveTest, WhoIsLostAmidPeopleAsksForTheWayAndDoesNotGiveUp) {
  start({{"l", TaskKind::relocalize, "", {}, "en", false, ""}, "", "", ""});
  for (int i = 0; i < 120; ++i) {
    executive.obstacle_report({true, true, "person_in_way"}, time());
    pass(1.0);
    goal(GoalStatus::blocked);
  }
  EXPECT_GE(std::count(rungs.begin(), rungs.end(), Rung::horn), 10);
  ASSERT_FALSE(said.empty());
  EXPECT_TRUE(said[0].text.starts_with("I do not know where I am")) << said[0].text;
  EXPECT_NE(state.state, TaskStatus::failed) << "there is nothing else that it could do";
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::done);
}

TEST_F(ExecutiveTest, ARestartContinuesTheStep) {
  start(visit("t1"));
  restart();
  EXPECT_EQ(drive->id, "t1/drive");
  EXPECT_EQ(state.state, TaskStatus::driving);
  EXPECT_EQ(count("t1/announcement"), 0);
  goal(GoalStatus::arrived);
  restart();
  EXPECT_EQ(state.state, TaskStatus::explaining);
  speech("t1/short", SpeechStatus::speaking);
  pass(2.0);
  EXPECT_EQ(count("t1/short"), 0) << "it is being said already";
  speech("t1/short", SpeechStatus::done);
  restart();
  EXPECT_EQ(state.state, TaskStatus::asking);
  pass(5.5);
  EXPECT_EQ(state.state, TaskStatus::done);
  restart();
  EXPECT_EQ(state.state, TaskStatus::done);
  start(visit("t1"));
  EXPECT_EQ(state.state, TaskStatus::done) << "what was done is not done again";
}

TEST_F(ExecutiveTest, ALongDeathMeansDrivingThereAgain) {
  start(visit("t1"));
  goal(GoalStatus::arrived);
  now_s += 3600.0;
  restart();
  EXPECT_EQ(state.state, TaskStatus::driving);
}

TEST_F(ExecutiveTest, TheCheckpointHoldsEverything) {
  const auto path = std::filesystem::temp_directory_path() / ("docent_executive_" + std::to_string(getpid()) + ".json");
  std::filesystem::remove(path);
  const auto none = load_checkpoint(path, "hall");
  ASSERT_TRUE(none);
  EXPECT_EQ(none->phase, Phase::idle);
  start(visit("t1"));
  goal(GoalStatus::arrived);
  speech("t1/short", SpeechStatus::done);
  ASSERT_TRUE(save_checkpoint(path, saved, "hall"));
  const auto loaded = load_checkpoint(path, "hall");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->phase, Phase::running);
  EXPECT_EQ(loaded->item, saved.item);
  EXPECT_EQ(loaded->item_began, saved.item_began);
  EXPECT_EQ(loaded->look, "visitors");
  EXPECT_EQ(loaded->drive_began, saved.drive_began);
  EXPECT_EQ(loaded->task.order.id, "t1");
  EXPECT_EQ(loaded->task.order.map_from_base.y, 4.0);
  EXPECT_EQ(loaded->task.long_text, saved.task.long_text);
  EXPECT_EQ(load_checkpoint(path, "another hall")->phase, Phase::idle) << "its poses mean nothing there";
  const std::string whole = *read_file(path);
  for (const std::string& damaged : {whole.substr(0, whole.size() / 2), std::string{"{}"}, std::string{"[1]"},
                                     std::string{"{\"phase\": \"dancing\"}"}, std::string{}}) {
    ASSERT_TRUE(write_file_atomically(path, damaged));
    EXPECT_FALSE(load_checkpoint(path, "hall")) << damaged;
  }
  std::filesystem::remove(path);
}

TEST_F(ExecutiveTest, ChargesNearerToThePlaceAndInvitesNobody) {
  start({{"c1", TaskKind::charge, "", {3, 4, {}}, "en", false, "space"}, "", "", ""});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said.back().text.find("battery"), std::string::npos) << "the tour ends with a word";
  EXPECT_LT(drive->position_tolerance, 0.25);
  executive.charging_report(true);
  goal(GoalStatus::arrived);
  pass(0.5);
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_EQ(said.back().text.find("Who would like"), std::string::npos);
  now_s += 100.0;
  start({{"c2", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  EXPECT_EQ(count("c2/must_charge"), 0) << "nobody was with it";
}

TEST_F(ExecutiveTest, StaysAtTheExhibitAsLongAsTheModeSays) {
  ExecutiveTask task = visit("t1", false);
  task.wait_s = 30.0;
  start(task);
  goal(GoalStatus::arrived);
  speech("t1/short", SpeechStatus::speaking);
  speech("t1/short", SpeechStatus::done);
  EXPECT_EQ(state.state, TaskStatus::explaining);
  pass(20.0);
  restart();
  pass(9.0);
  EXPECT_EQ(state.state, TaskStatus::explaining);
  pass(2.0);
  EXPECT_EQ(state.state, TaskStatus::done);
}

TEST_F(ExecutiveTest, ADepartureIsLookedForwardToAndHeard) {
  executive.set_task(visit("t1"), time());
  const auto actions = executive.take_actions();
  EXPECT_EQ(actions.report->look, "place");
  EXPECT_EQ(actions.horns.size(), 1U);
  EXPECT_EQ(actions.music, true);
  ASSERT_TRUE(actions.drive);
  EXPECT_EQ(actions.drive->id, "t1/drive");
  executive.goal_report({"t1/drive", GoalStatus::arrived, 0.0, 0.0, 0.0, "", "none"}, time());
  const auto arrived = executive.take_actions();
  EXPECT_EQ(arrived.music, false);
  EXPECT_EQ(arrived.report->look, "visitors");
  EXPECT_TRUE(arrived.horns.empty());
}

TEST_F(ExecutiveTest, AsksForTheWayInTheMoodThatItsFaceShows) {
  start(visit("t1"));
  said.clear();
  goal(GoalStatus::driving);
  for (int i = 0; i < 10 && said.empty(); ++i) {
    executive.mood_report(Mood::angry, time());
    executive.obstacle_report({true, true, "person_in_way"}, time());
    pass(1.0);
    goal(GoalStatus::blocked);
  }
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said[0].mood, Mood::angry);
  EXPECT_EQ(said[0].text, interaction::sentence(interaction::Sentence::let_me_through, "en", Mood::angry, 0));
}

TEST_F(ExecutiveTest, AttractsPeopleAsItsStyleSaysAlsoAfterARestart) {
  ExecutiveTask mingle{{"m1", TaskKind::mingle, "", {}, "en", false, ""}, "", "", ""};
  mingle.style = interaction::AttractionAction{GazeStrategy::everybody, Mood::happy, SpeechAct::invite};
  start(mingle);
  EXPECT_EQ(state.look, "company");
  pass(25.0);
  restart();
  pass(30.0);
  EXPECT_EQ(state.state, TaskStatus::explaining);
  pass(6.0);
  EXPECT_EQ(state.state, TaskStatus::done);
  ASSERT_EQ(said.size(), 1U) << "since the restart";
  EXPECT_EQ(said[0].mood, Mood::happy);
  EXPECT_EQ(said[0].id, "m1/attraction-3");

  said.clear();
  mingle.order.id = "m2";
  mingle.style->speech = SpeechAct::silence;
  start(mingle);
  pass(61.0);
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_TRUE(said.empty());
}

}  // namespace
}  // namespace docent::task_control
