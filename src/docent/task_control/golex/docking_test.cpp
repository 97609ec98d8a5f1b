#include "docent/task_control/golex/docking.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "docent/task_control/golex/executive_fixture.h"

namespace docent::task_control {
namespace {

const Pose2 kCharger{7.0, 1.5, Angle::degrees(90)};

class DockingTest : public testing::Test {
 protected:
  /// Steps four times a second for so long, or until it is over; drives arrive after `drive_s`.
  Docking::State pass(double duration_s, Contact contact, double drive_s = 3.0) {
    auto state = Docking::State::under_way;
    for (const double end = now_s + duration_s; now_s < end && !is_over(state); now_s += 0.25) {
      const auto before = docking.move();
      if (!before || before->name != move) moved_s = 0.0;
      moved_s += 0.25;
      move = before ? before->name : "";
      if (before) moves.insert(before->name);
      const bool arrives = before && moved_s >= drive_s;
      DockingView view{.contact = contact};
      if (before) view.moved = arrives ? GoalStatus::arrived : is_occupied ? GoalStatus::blocked : GoalStatus::driving;
      view.blocked_s = view.moved == GoalStatus::blocked ? moved_s : 0.0;
      view.is_occupied = is_occupied;
      state = docking.step(view, time());
    }
    return state;
  }
  static bool is_over(Docking::State state) {
    return state == Docking::State::docked || state == Docking::State::failed;
  }
  [[nodiscard]] Time time() const { return time_from_seconds(now_s); }

  /// It stands before a charger on which something stands.
  void stand_before() {
    docking = Docking{{}, kCharger, DockingStart::occupied, time()};
    is_occupied = true;
  }

  double now_s = 100.0;
  double moved_s = 0.0;
  bool is_occupied = false;
  std::string move;
  std::set<std::string> moves;
  Docking docking{{}, kCharger, DockingStart::at_charger, time_from_seconds(100.0)};
};

TEST_F(DockingTest, ABatteryThatChargesEndsIt) { EXPECT_EQ(pass(1.0, Contact::made), Docking::State::docked); }

TEST_F(DockingTest, ABatteryThatNeverSaysIsBelieved) { EXPECT_EQ(pass(1.0, Contact::unknown), Docking::State::docked); }

TEST_F(DockingTest, WhoDocksByItselfIsWaitedForAndSetsOutAnewFromFartherOff) {
  EXPECT_EQ(pass(60.0, Contact::coming), Docking::State::under_way);
  EXPECT_TRUE(moves.empty()) << "the base moves, and the robot does not";
  EXPECT_EQ(pass(9.0, Contact::none), Docking::State::under_way);
  EXPECT_TRUE(moves.empty()) << "its time begins when the base has given up";
  DockingParams params;
  params.by_action = true;
  docking = Docking{params, kCharger, DockingStart::at_charger, time()};
  while (!docking.move() || docking.move()->name != "before") pass(0.25, Contact::none);
  // The robot looks to where y grows, at the dock.
  EXPECT_NEAR(docking.move()->map_from_base.y, 1.5 - params.stand_off_m, 1e-9);
}

TEST_F(DockingTest, ABatteryThatWasNotHeardYetMayStillSay) {
  EXPECT_EQ(pass(9.0, Contact::unheard), Docking::State::under_way);
  EXPECT_EQ(pass(2.0, Contact::unheard), Docking::State::docked) << "the robot has no gauge";
}

TEST_F(DockingTest, WithoutContactItComesCloser) {
  EXPECT_FALSE(docking.move()) << "it stands and waits";
  EXPECT_FALSE(is_over(pass(11.0, Contact::none)));
  ASSERT_TRUE(docking.move());
  EXPECT_EQ(docking.move()->map_from_base.position(), kCharger.position());
  EXPECT_LT(docking.move()->position_tolerance, 0.15) << "closer than an ordinary arrival at the charger";
  pass(3.0, Contact::none);
  EXPECT_EQ(pass(2.0, Contact::made), Docking::State::docked);
}

TEST_F(DockingTest, ThenItSetsOutAnewFromBothSidesAndGivesUp) {
  EXPECT_EQ(pass(300.0, Contact::none), Docking::State::failed);
  EXPECT_EQ(moves, (std::set<std::string>{"closer", "before", "from-before", "behind", "from-behind"}));
  EXPECT_LT(now_s, 100.0 + 4 * 10.5 + 5 * 3.5);
  EXPECT_EQ(docking.failure(), ReasonWord::charger_no_current);
  EXPECT_EQ(docking.step({.contact = Contact::made}, time()), Docking::State::failed) << "what is over stays over";
}

TEST_F(DockingTest, AMoveThatDoesNotArriveIsGivenUp) {
  EXPECT_EQ(pass(300.0, Contact::none, 1e9), Docking::State::failed);
  EXPECT_LT(now_s, 100.0 + 4 * 10.5 + 5 * 30.5);
}

TEST_F(DockingTest, BeforeAnOccupiedChargerItWaitsAndTriesOtherWays) {
  stand_before();
  EXPECT_EQ(pass(19.0, Contact::none, 1e9), Docking::State::under_way);
  EXPECT_FALSE(docking.move()) << "it waits for whatever stands there to go";
  EXPECT_TRUE(docking.is_occupied());
  EXPECT_EQ(pass(300.0, Contact::none, 1e9), Docking::State::failed);
  EXPECT_EQ(moves, (std::set<std::string>{"again", "beside", "behind", "from-behind"}));
  EXPECT_EQ(docking.failure(), ReasonWord::charger_occupied);
  EXPECT_LT(now_s, 100.0 + 20.5 + 4 * 8.5 + 3 * 0.5) << "no drive in vain lasts long";
}

TEST_F(DockingTest, ThatItCameNearAnOccupiedChargerIsNoArrival) {
  stand_before();
  EXPECT_EQ(pass(300.0, Contact::unknown, 3.0), Docking::State::failed) << "settled half a metre off, without a gauge";
  EXPECT_EQ(docking.failure(), ReasonWord::charger_occupied);
}

TEST_F(DockingTest, WhereWhatStoodThereHasGoneItDocksAtOnce) {
  stand_before();
  (void)pass(5.0, Contact::none);
  is_occupied = false;
  (void)pass(3.0, Contact::none);
  ASSERT_TRUE(docking.move());
  EXPECT_EQ(docking.move()->name, "again");
  EXPECT_EQ(pass(4.0, Contact::none), Docking::State::under_way);
  EXPECT_EQ(pass(1.0, Contact::made), Docking::State::docked);
}

TEST_F(DockingTest, BesideWhatStandsThereItTakesTheContactThatItGets) {
  stand_before();
  while (move != "beside") (void)pass(0.25, Contact::none, 1e9);
  EXPECT_GT(docking.move()->position_tolerance, 0.2);
  EXPECT_EQ(pass(20.0, Contact::made, 1e9), Docking::State::docked);
}

TEST_F(DockingTest, WhatIsPutOnTheChargerBetweenTwoTriesIsSeen) {
  (void)pass(11.0, Contact::none);
  ASSERT_TRUE(docking.move());
  is_occupied = true;
  EXPECT_EQ(pass(300.0, Contact::none, 1e9), Docking::State::failed);
  EXPECT_EQ(docking.failure(), ReasonWord::charger_occupied);
}

/// A docking by the tag, from where the tag is seen.
Docking by_tag() { return {{}, kCharger, DockingStart::before_tag, time_from_seconds(0.0)}; }

TEST(DockingByTag, OrdersItAndIsDockedByTheBattery) {
  Docking docking = by_tag();
  const auto order = docking.tag_order();
  ASSERT_TRUE(order);
  EXPECT_FALSE(docking.move()) << "nothing else drives meanwhile";
  EXPECT_TRUE(docking.is_by_tag());
  const auto step = [&](double at, Contact contact, ByTag tag) {
    return docking.step({.contact = contact, .by_tag = tag}, time_from_seconds(at));
  };
  EXPECT_EQ(step(1.0, Contact::none, ByTag::ready), Docking::State::under_way);
  EXPECT_EQ(step(60.0, Contact::none, ByTag::drives), Docking::State::under_way) << "as long as it takes";
  EXPECT_EQ(step(61.0, Contact::made, ByTag::drives), Docking::State::docked);
  EXPECT_TRUE(docking.is_by_tag());
}

TEST(DockingByTag, TriesOnceMoreAndThenAsWithoutATag) {
  Docking docking = by_tag();
  std::vector<std::string> seen;
  auto state = Docking::State::under_way;
  for (double now = 0.0; now < 300.0 && state != Docking::State::failed; now += 0.25) {
    const auto order = docking.tag_order();
    const auto move = docking.move();
    const std::string name = order ? *order : move ? move->name : "waits";
    if (seen.empty() || seen.back() != name) seen.push_back(name);
    DockingView view{.contact = Contact::none, .by_tag = order ? ByTag::failed : ByTag::ready};
    if (move) view.moved = GoalStatus::arrived;
    state = docking.step(view, time_from_seconds(now));
  }
  EXPECT_EQ(state, Docking::State::failed);
  const std::vector<std::string> asked{"by-tag-0", "waits", "again",  "by-tag-3",    "waits",
                                       "closer",   "waits", "before", "from-before", "waits"};
  EXPECT_EQ(seen, asked);
  EXPECT_EQ(docking.failure(), ReasonWord::charger_no_current) << "it stood there";
}

TEST(DockingByTag, WithoutAnAnswerItGoesOnSoon) {
  Docking docking = by_tag();
  (void)docking.step({.contact = Contact::none, .by_tag = ByTag::ready}, time_from_seconds(3.5));
  EXPECT_FALSE(docking.tag_order());
}

TEST_F(ExecutiveTest, DocksByTheTagFromBeforeTheCharger) {
  executive.tag_report(ByTag::ready);
  start({{"c", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  executive.charging_report(false);
  EXPECT_EQ(drive->id, "c/drive");
  EXPECT_NEAR(drive->map_from_base.x, 1.5, 1e-9) << "from there it sees the tag";
  EXPECT_FALSE(executive.tag_order());
  pass(6.0);
  goal(GoalStatus::arrived);
  ASSERT_TRUE(executive.tag_order());
  EXPECT_EQ(executive.tag_order()->map_from_base.position(), (Point2{3, 4}));
  EXPECT_EQ(drive->id, "") << "nothing else drives";
  executive.tag_report(ByTag::drives);
  pass(30.0);
  EXPECT_TRUE(executive.tag_order());
  executive.charging_report(true);
  pass(1.0);
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_FALSE(executive.tag_order());
  EXPECT_EQ(drive->id, "") << "it stays where it stands";
}

TEST_F(ExecutiveTest, WithoutAnEyeItDrivesToTheChargerItself) {
  executive.tag_report(ByTag::none);
  start({{"c", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  EXPECT_EQ(drive->map_from_base.position(), (Point2{3, 4}));
}

TEST_F(ExecutiveTest, BeforeAThingOnItsChargerItBlowsNoHornAndAsksNobody) {
  start({{"c", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  executive.charging_report(false);
  std::set<std::string> drives;
  for (int i = 0; i < 200 && state.state == TaskStatus::driving; ++i) {
    executive.obstacle_report({true, true, "person_in_way", false}, time());
    if (const bool waits = drive->id == "c/drive" && i > 40; !waits)
      executive.goal_report({drive->id, GoalStatus::blocked, 2.8, 0.7, 1.0 * i, "no progress", "none", true}, time());
    collect();
    pass(1.0);
    drives.insert(drive->id);
  }
  EXPECT_EQ(state.state, TaskStatus::failed);
  EXPECT_EQ(state.reason, ReasonWord::charger_occupied);
  EXPECT_TRUE(drives.contains("c/again") && drives.contains("c/behind"));
  EXPECT_EQ(std::count(rungs.begin(), rungs.end(), Rung::horn), 0);
  EXPECT_EQ(std::count(rungs.begin(), rungs.end(), Rung::ask), 0);
  EXPECT_EQ(count("c/call"), 1) << "it says what it needs";
}

TEST_F(ExecutiveTest, WhoeverWasSeenToWalkToTheChargerIsAsked) {
  start({{"c", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  for (int i = 0; i < 40; ++i) {
    const PersonSeen person{7, {3.1, 4.2}, i == 0 ? 0.8 : 0.0};
    executive.people_report({&person, 1}, time());
    executive.obstacle_report({true, true, "person_in_way", false}, time());
    executive.goal_report({drive->id, GoalStatus::blocked, 2.8, 0.7, 0.25 * i, "no progress", "none", true}, time());
    collect();
    pass(0.25);
  }
  EXPECT_GT(std::count(rungs.begin(), rungs.end(), Rung::horn), 0);
  EXPECT_GT(std::count(rungs.begin(), rungs.end(), Rung::ask), 0);
  EXPECT_EQ(drive->id, "c/drive");
}

TEST_F(DockingTest, TheStandOffLiesOnTheAxisOfTheCharger) {
  while (move != "before") pass(0.25, Contact::none);
  ASSERT_TRUE(docking.move());
  EXPECT_NEAR(docking.move()->map_from_base.x, 7.0, 1e-9);
  EXPECT_NEAR(docking.move()->map_from_base.y, 2.1, 1e-9);
}

TEST_F(ExecutiveTest, DocksUntilTheBatteryCharges) {
  start({{"c", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  executive.charging_report(false);
  pass(6.0);
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::driving) << "it stands at the charger, but has no contact";
  EXPECT_EQ(drive->id, "c/drive");
  pass(10.5);
  EXPECT_EQ(drive->id, "c/closer");
  EXPECT_LT(drive->position_tolerance, 0.1);
  restart();
  EXPECT_EQ(drive->id, "c/drive") << "it begins to dock anew";
  pass(5.0);
  EXPECT_EQ(state.state, TaskStatus::driving) << "it has not heard its battery yet";
  executive.charging_report(false);
  pass(5.5);
  EXPECT_EQ(drive->id, "c/closer");
  goal(GoalStatus::arrived);
  executive.charging_report(true);
  pass(0.5);
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_EQ(said.back().id, "c/at_charger");
}

TEST_F(ExecutiveTest, AChargerWithoutContactIsGivenUp) {
  start({{"c", TaskKind::charge, "", {3, 4, {}}, "en", false, ""}, "", "", ""});
  executive.charging_report(false);
  goal(GoalStatus::arrived);
  std::set<std::string> drives;
  for (int i = 0; i < 100 && state.state == TaskStatus::driving; ++i) {
    pass(3.0);
    drives.insert(drive->id);
    if (drive->id != "c/drive" && state.state == TaskStatus::driving) goal(GoalStatus::arrived);
  }
  EXPECT_EQ(state.state, TaskStatus::failed);
  EXPECT_EQ(state.reason, ReasonWord::charger_no_current);
  EXPECT_EQ(count("c/call"), 1);
  EXPECT_TRUE(drives.contains("c/before") && drives.contains("c/behind"));
  EXPECT_EQ(drive->id, "") << "it stays";
}

}  // namespace
}  // namespace docent::task_control
