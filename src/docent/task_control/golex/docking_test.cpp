#include "docent/task_control/golex/docking.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

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
      state = docking.step(contact, arrives ? std::optional{GoalStatus::arrived} : std::nullopt, time());
    }
    return state;
  }
  static bool is_over(Docking::State state) {
    return state == Docking::State::docked || state == Docking::State::failed;
  }
  [[nodiscard]] Time time() const { return time_from_seconds(now_s); }

  double now_s = 100.0;
  double moved_s = 0.0;
  std::string move;
  std::set<std::string> moves;
  Docking docking{{}, kCharger, time_from_seconds(100.0)};
};

TEST_F(DockingTest, ABatteryThatChargesEndsIt) { EXPECT_EQ(pass(1.0, Contact::made), Docking::State::docked); }

TEST_F(DockingTest, ABatteryThatNeverSaysIsBelieved) { EXPECT_EQ(pass(1.0, Contact::unknown), Docking::State::docked); }

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
  EXPECT_EQ(docking.step(Contact::made, std::nullopt, time()), Docking::State::failed) << "what is over stays over";
}

TEST_F(DockingTest, AMoveThatDoesNotArriveIsGivenUp) {
  EXPECT_EQ(pass(300.0, Contact::none, 1e9), Docking::State::failed);
  EXPECT_LT(now_s, 100.0 + 4 * 10.5 + 5 * 30.5);
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
  EXPECT_EQ(state.reason, ReasonWord::not_reached);
  EXPECT_TRUE(drives.contains("c/before") && drives.contains("c/behind"));
  EXPECT_EQ(drive->id, "") << "it stays";
}

}  // namespace
}  // namespace docent::task_control
