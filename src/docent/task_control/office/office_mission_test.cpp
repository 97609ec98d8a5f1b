#include "docent/task_control/office/office_mission.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {
namespace {

/// 10 x 6 m with a wall across that leaves a door.
OccupancyGrid office_rooms() {
  OccupancyGrid map{{100, 60, 0.1, {0.0, 0.0}}, std::vector<std::int8_t>(6000, OccupancyGrid::kFree)};
  const auto set = [&](int column, int row) { map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied; };
  for (int i = 0; i < 100; ++i) set(i, 0), set(i, 59);
  for (int i = 0; i < 60; ++i) set(0, i), set(99, i);
  for (int i = 0; i < 60; ++i)
    if (i < 12 || i > 24) set(50, i);
  return map;
}

bool anywhere(Point2) { return true; }

TEST(ViewPlan, SeesAllFloorOfBothRoomsAndEnds) {
  ViewPlan plan{office_rooms(), anywhere, anywhere, {2.0, 2.0}};
  Pose2 pose{2.0, 2.0, {}};
  int looks = 0;
  double x_most = 0.0;
  while (const auto next = plan.next(pose)) {
    pose = *next;
    x_most = std::max(x_most, pose.x);
    plan.see(pose);
    ASSERT_LT(++looks, 120);
  }
  EXPECT_GT(plan.seen_share(), 0.96);
  EXPECT_GT(x_most, 6.0) << "it went through the door";
  EXPECT_GT(looks, 15);
}

TEST(ViewPlan, DoesNotSeeThroughWalls) {
  const auto right = [](Point2 at) { return at.x > 5.2; };
  ViewPlan plan{office_rooms(), right, anywhere, {2.0, 2.0}};
  plan.see({4.2, 4.5, {}});  // before the wall
  EXPECT_LT(plan.seen_share(), 0.001);
  plan.see({4.2, 1.8, {}});  // before the door
  EXPECT_GT(plan.seen_share(), 0.02);
}

TEST(ViewPlan, LooksNoMoreFromWhereItDidNotGet) {
  ViewPlan plan{office_rooms(), anywhere, anywhere, {2.0, 2.0}};
  const auto first = plan.next({2.0, 2.0, {}});
  ASSERT_TRUE(first);
  plan.give_up(first->position());
  const auto second = plan.next({2.0, 2.0, {}});
  ASSERT_TRUE(second);
  EXPECT_GT(distance(first->position(), second->position()), 0.2);
}

TEST(ViewPlan, StandsBeforeAThingAndFacesIt) {
  const ViewPlan plan{office_rooms(), anywhere, anywhere, {2.0, 2.0}};
  const auto pose = plan.stand_before({4.75, 4.0}, 1.1, {2.0, 2.0, {}});  // beside the wall
  ASSERT_TRUE(pose);
  EXPECT_NEAR(distance(pose->position(), {4.75, 4.0}), 1.1, 0.01);
  EXPECT_LT(pose->x, 4.6);
  EXPECT_NEAR((pose->theta - direction(pose->position(), {4.75, 4.0})).degrees(), 0.0, 1e-6);
}

class OfficeMissionTest : public testing::Test {
 protected:
  void order(OfficeOrderKind kind, const std::string& room = "") {
    mission.order({"order-" + std::to_string(++orders), kind, room}, time());
    collect();
  }
  void collect() {
    auto actions = mission.take_actions();
    if (actions.withdraws) wished.reset();
    withdrawn += actions.withdraws ? 1 : 0;
    if (actions.wish) wished = actions.wish;
    for (const auto& [line, about] : actions.lines) said.push_back(std::string{docent::to_text(line)} + " " + about);
  }
  void pass(double duration_s) {
    for (const double end = now_s + duration_s; now_s < end;) {
      now_s += 0.25;
      mission.see_things(things);
      mission.stand(pose, true, time());
      mission.tick(time());
      collect();
    }
  }
  /// The robot gets where it wished to be.
  void arrive(bool is_fulfilled = true) {
    ASSERT_TRUE(wished);
    double heading = 0.0;
    if (is_fulfilled && wished->kind == RequestKind::point &&
        std::sscanf(wished->target.c_str(), "%lf,%lf,%lf", &pose.x, &pose.y, &heading) == 3)
      pose.theta = Angle::radians(heading);
    wished.reset();
    mission.wish_over(is_fulfilled, is_fulfilled ? "" : "no_way", time());
    collect();
  }
  /// Until the robot is in that phase, arriving everywhere. @returns whether it was
  bool until(OfficePhase phase) {
    for (int i = 0; i < 400; ++i) {
      if (mission.status().phase == phase) return true;
      if (wished) arrive();
      pass(0.25);
    }
    return false;
  }
  [[nodiscard]] Time time() const { return time_from_seconds(now_s); }
  [[nodiscard]] long count(const std::string& line) const {
    return std::count_if(said.begin(), said.end(), [&](const std::string& one) { return one.starts_with(line); });
  }

  double now_s = 100.0;
  int orders = 0, withdrawn = 0;
  Pose2 pose{2.0, 2.0, {}};
  OfficeMission mission{{},
                        [](const std::string& room, Point2 robot) -> std::optional<ViewPlan> {
                          if (room == "nowhere") return std::nullopt;
                          return ViewPlan{office_rooms(), anywhere, anywhere, robot};
                        },
                        {1.0, 1.0, {}}};
  std::vector<KnownThing> things;
  std::optional<OfficeMission::Wish> wished;
  std::vector<std::string> said;
};

TEST_F(OfficeMissionTest, DeliversAndWaitsForSomebody) {
  order(OfficeOrderKind::deliver, "kitchen");
  ASSERT_TRUE(wished);
  EXPECT_EQ(wished->kind, RequestKind::room);
  EXPECT_EQ(wished->target, "kitchen");
  arrive();
  EXPECT_EQ(said, std::vector<std::string>{"delivery kitchen"});
  pass(20.0);
  EXPECT_EQ(mission.status().phase, OfficePhase::handing_over);
  mission.confirm(time());
  EXPECT_EQ(mission.status().phase, OfficePhase::done);
  EXPECT_EQ(mission.status().reason, "");
}

TEST_F(OfficeMissionTest, ADeliveryThatNobodyTakesEndsByTime) {
  order(OfficeOrderKind::deliver, "kitchen");
  arrive();
  pass(61.0);
  EXPECT_EQ(mission.status().phase, OfficePhase::done);
  EXPECT_EQ(mission.status().reason, "nobody confirmed it");
}

TEST_F(OfficeMissionTest, ADeliveryWithoutAWayFailsAndSaysSo) {
  order(OfficeOrderKind::deliver, "attic");
  arrive(false);
  EXPECT_EQ(mission.status().phase, OfficePhase::failed);
  EXPECT_EQ(mission.status().reason, "no_way");
  EXPECT_EQ(count("cannot_get_there"), 1);
}

TEST_F(OfficeMissionTest, TidiesUpThreeToABin) {
  for (int i = 0; i < 4; ++i)
    things.push_back({static_cast<std::uint32_t>(i + 1), i % 2 == 0 ? "can" : "wad", {1.5 + 0.8 * i, 3.0}});
  things.push_back({9, "", {3.0, 4.5}});       // something that nobody taught
  things.push_back({10, "shoe", {3.5, 4.5}});  // and what belongs here
  order(OfficeOrderKind::tidy);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(until(OfficePhase::asking)) << i;
    ASSERT_TRUE(mission.status().points);
    EXPECT_NEAR(distance(*mission.status().points, pose.position()), 1.15, 0.02);
    mission.confirm(time());
  }
  EXPECT_EQ(mission.status().in_bin, 3U);
  ASSERT_TRUE(until(OfficePhase::to_bin)) << "before it goes on";
  EXPECT_EQ(wished->target, "1.00,1.00,0.000");
  ASSERT_TRUE(until(OfficePhase::emptying));
  mission.confirm(time());
  EXPECT_EQ(mission.status().in_bin, 0U);
  ASSERT_TRUE(until(OfficePhase::asking));
  mission.confirm(time());
  ASSERT_TRUE(until(OfficePhase::emptying)) << "with what is left";
  mission.confirm(time());
  ASSERT_TRUE(until(OfficePhase::done));
  EXPECT_EQ(mission.status().found, 4U);
  EXPECT_EQ(mission.status().picked_up, 4U);
  EXPECT_EQ(count("please_put_in"), 4);
  EXPECT_EQ(count("all_tidy"), 1);
  EXPECT_GT(mission.seen_share(), 0.95);
}

TEST_F(OfficeMissionTest, WhatIsTakenAwayCountsWithoutAButton) {
  things.push_back({1, "can", {3.0, 3.0}});
  order(OfficeOrderKind::tidy);
  ASSERT_TRUE(until(OfficePhase::asking));
  things.clear();
  pass(4.0);
  EXPECT_EQ(mission.status().picked_up, 1U);
}

TEST_F(OfficeMissionTest, WhatNobodyPicksUpIsLeftAndNotAskedForAgain) {
  things.push_back({1, "can", {3.0, 3.0}});
  order(OfficeOrderKind::tidy);
  ASSERT_TRUE(until(OfficePhase::asking));
  pass(26.0);
  EXPECT_EQ(mission.status().left, 1U);
  ASSERT_TRUE(until(OfficePhase::done));
  EXPECT_EQ(count("please_put_in"), 1);
}

TEST_F(OfficeMissionTest, WhatIsSomethingElseFromNearIsNotAskedFor) {
  things.push_back({1, "can", {3.0, 3.0}});
  order(OfficeOrderKind::tidy);
  ASSERT_TRUE(until(OfficePhase::checking));
  things.front().object = "";
  ASSERT_TRUE(until(OfficePhase::done));
  EXPECT_EQ(count("please_put_in"), 0);
  EXPECT_EQ(mission.status().found, 0U);
}

TEST_F(OfficeMissionTest, ABinThatNobodyEmptiesEndsIt) {
  things = {{1, "can", {1.5, 3.0}}, {2, "can", {2.5, 3.0}}, {3, "can", {3.5, 3.0}}};
  order(OfficeOrderKind::tidy);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(until(OfficePhase::asking));
    mission.confirm(time());
  }
  ASSERT_TRUE(until(OfficePhase::emptying));
  pass(121.0);
  EXPECT_EQ(mission.status().phase, OfficePhase::failed);
  EXPECT_EQ(mission.status().in_bin, 3U) << "it is still full";
}

TEST_F(OfficeMissionTest, StopWithdrawsTheDriveAndTheSameOrderTwiceIsOne) {
  mission.order({"a", OfficeOrderKind::deliver, "kitchen"}, time());
  mission.order({"a", OfficeOrderKind::deliver, "kitchen"}, time());
  collect();
  EXPECT_EQ(withdrawn, 0);
  order(OfficeOrderKind::stop);
  EXPECT_EQ(withdrawn, 1);
  EXPECT_EQ(mission.status().phase, OfficePhase::idle);
  order(OfficeOrderKind::tidy, "nowhere");
  pass(1.0);
  EXPECT_EQ(mission.status().phase, OfficePhase::failed);
}

}  // namespace
}  // namespace docent::task_control
