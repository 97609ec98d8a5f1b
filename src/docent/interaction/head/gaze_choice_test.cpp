#include "docent/interaction/head/gaze_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace docent::interaction {
namespace {

Time at(double time_s) { return time_from_seconds(time_s); }

/// On its way to an exhibit that lies 5 m to the left, straight on along the x axis.
HeadView driving(const std::vector<SeenPerson>& people) {
  HeadView view;
  view.task = TaskKind::visit;
  view.status = TaskStatus::driving;
  view.exhibit = Point2{0.0, 5.0};
  view.wanted = Angle{};
  view.people = people;
  return view;
}
HeadView explaining(const std::vector<SeenPerson>& people) {
  HeadView view = driving(people);
  view.status = TaskStatus::explaining;
  view.wanted.reset();
  return view;
}
HeadView idle(const std::vector<SeenPerson>& people) {
  HeadView view;
  view.people = people;
  return view;
}
GazeTarget choose(const HeadView& view) { return GazeChoice{{}}.choose(view, at(1.0)); }

const std::vector<SeenPerson> kNobody;
const std::vector<SeenPerson> kBeside{{7, {1.0, 2.0}, {}}};
const std::vector<SeenPerson> kInTheWay{{7, {1.0, 2.0}, {}}, {8, {2.0, 0.3}, {}}, {9, {2.5, 0.0}, {}}};

TEST(GazeChoice, LooksAtTheNextExhibitWhileItDrives) {
  for (const auto* people : {&kNobody, &kBeside}) {
    const GazeTarget target = choose(driving(*people));
    EXPECT_EQ(target.at, LookAt::goal);
    EXPECT_NEAR(target.pan, std::numbers::pi / 2.0, 1e-9);
    EXPECT_NEAR(target.tilt, std::atan2(1.2 - 1.35, 5.0), 1e-9) << "an exhibit is lower than its eyes";
  }
}

TEST(GazeChoice, LooksAtWhoeverStandsWhereItWantsToGo) {
  const GazeTarget target = choose(driving(kInTheWay));
  EXPECT_EQ(target.at, LookAt::person);
  EXPECT_EQ(target.person, 8U) << "the nearest of them along the way";
  EXPECT_NEAR(target.pan, std::atan2(0.3, 2.0), 1e-9);
  EXPECT_GT(target.tilt, 0.0) << "a face is higher than its eyes";
  EXPECT_EQ(choose(driving({{8, {2.0, 0.0}, {0.0, 1.0}}})).at, LookAt::goal) << "who walks past does not stand there";
  EXPECT_EQ(choose(driving({{8, {-1.0, 0.0}, {}}})).at, LookAt::goal) << "nor does who is behind it";
  HeadView turned = driving(kInTheWay);
  turned.wanted = Angle::degrees(-90.0);
  EXPECT_EQ(choose(turned).at, LookAt::goal) << "the wanted direction decides, not the robot's heading";
}

TEST(GazeChoice, LooksInTheWantedDirectionDuringABlockage) {
  HeadView view = driving(kBeside);
  view.is_blocked = true;
  view.wanted = Angle::degrees(-40.0);
  const GazeTarget target = choose(view);
  EXPECT_EQ(target.at, LookAt::way);
  EXPECT_NEAR(target.pan, Angle::degrees(-40.0).radians(), 1e-9);
  view.people = kInTheWay;
  view.wanted = Angle{};
  EXPECT_EQ(choose(view).at, LookAt::person);
  view.wanted.reset();
  EXPECT_EQ(choose(view).at, LookAt::goal) << "without a direction the exhibit is all it knows";
}

TEST(GazeChoice, LooksAlongItsWayWhereThereIsNothingToShow) {
  HeadView view = driving(kNobody);
  view.task = TaskKind::home;
  view.exhibit.reset();
  view.wanted = Angle::degrees(20.0);
  EXPECT_EQ(choose(view).at, LookAt::way);
  view.task = TaskKind::relocalize;
  EXPECT_EQ(choose(view).at, LookAt::none) << "a robot that is lost wants to go nowhere";
  EXPECT_EQ(choose(view).pan, 0.0);
}

TEST(GazeChoice, LooksAtAVisitorWhileItExplainsAndAsks) {
  HeadView view = explaining(kBeside);
  EXPECT_EQ(choose(view).at, LookAt::visitor);
  EXPECT_EQ(choose(view).person, 7U);
  view.status = TaskStatus::asking;
  EXPECT_EQ(choose(view).at, LookAt::visitor);
  view.people = kNobody;
  EXPECT_EQ(choose(view).at, LookAt::goal) << "to an empty hall it shows the exhibit";
  const std::vector<SeenPerson> far{{7, {5.0, 5.0}, {}}};
  view.people = far;
  EXPECT_EQ(choose(view).at, LookAt::goal);
}

TEST(GazeChoice, IdleItLooksAtTheNearestPersonOrStraightOn) {
  EXPECT_EQ(choose(idle(kInTheWay)).person, 8U);
  EXPECT_EQ(choose(idle(kNobody)).at, LookAt::none);
  HeadView done = idle(kInTheWay);
  done.task = TaskKind::home;
  done.status = TaskStatus::done;
  EXPECT_EQ(choose(done).at, LookAt::visitor);
  done.company = GazeStrategy::ahead;
  EXPECT_EQ(choose(done).at, LookAt::none);
}

TEST(GazeChoice, KeepsToAPersonUntilSomebodyIsClearlyNearer) {
  GazeChoice choice{{}};
  const auto person_at = [&](const std::vector<SeenPerson>& people, double time_s) {
    return choice.choose(explaining(people), at(time_s)).person;
  };
  EXPECT_EQ(person_at({{1, {1.5, 0.0}, {}}, {2, {1.7, 1.0}, {}}}, 1.0), 1U);
  EXPECT_EQ(person_at({{1, {1.9, 0.0}, {}}, {2, {1.4, 0.0}, {}}}, 2.0), 1U) << "half a metre nearer is not enough";
  EXPECT_EQ(person_at({{1, {2.1, 0.0}, {}}, {2, {1.4, 0.0}, {}}}, 3.0), 2U);
  EXPECT_EQ(person_at({{1, {1.0, 0.0}, {}}}, 4.0), 1U) << "the other one has gone";
}

TEST(GazeChoice, LooksAtEverybodyInTurn) {
  GazeChoice choice{{}};
  const std::vector<SeenPerson> people{
      {4, {1.5, 0.0}, {}}, {2, {1.0, 1.0}, {}}, {9, {3.0, 0.0}, {}}, {5, {9.0, 0.0}, {}}};
  HeadView view = idle(people);
  view.company = GazeStrategy::everybody;
  std::vector<std::uint32_t> seen;
  for (int i = 0; i < 170; ++i) {
    const GazeTarget target = choice.choose(view, at(0.1 * i));
    if (seen.empty() || seen.back() != target.person) seen.push_back(target.person);
  }
  EXPECT_EQ(seen, (std::vector<std::uint32_t>{2, 4, 9, 2, 4})) << "four seconds each, and nobody who is too far";
}

TEST(GazeChoiceParams, HaveBounds) {
  EXPECT_TRUE(GazeChoiceParams{}.validate());
  const auto refused = [](auto change) {
    GazeChoiceParams params;
    change(params);
    return !params.validate();
  };
  EXPECT_TRUE(refused([](auto& p) { p.in_way = 0.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.way_reach = 0.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.standing = -1.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.company = 0.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.loyalty = -0.1; }));
  EXPECT_TRUE(refused([](auto& p) { p.turn_s = 0.0; }));
  EXPECT_TRUE(refused([](auto& p) { p.eyes = 3.5; }));
  EXPECT_TRUE(refused([](auto& p) { p.nearest = 0.0; }));
}

TEST(GazeChoice, ATaskMaySayWhereItLooks) {
  HeadView view = explaining(kBeside);
  view.look = LookFor::place;
  EXPECT_EQ(choose(view).at, LookAt::goal) << "at what it explains";
  view.look = LookFor::nobody;
  EXPECT_EQ(choose(view).at, LookAt::none);
  view.look = LookFor::company;
  EXPECT_EQ(choose(view).at, LookAt::visitor);
  view.company = GazeStrategy::ahead;
  EXPECT_EQ(choose(view).at, LookAt::none) << "the style says at whom";
  view = driving(kNobody);
  view.task.reset();
  EXPECT_EQ(choose(view).at, LookAt::way) << "an action of a museum's own";
  view.look = LookFor::place;
  EXPECT_EQ(choose(view).at, LookAt::goal);
  view.is_blocked = true;
  EXPECT_EQ(choose(view).at, LookAt::way) << "a blocked way comes first";
}

}  // namespace
}  // namespace docent::interaction
