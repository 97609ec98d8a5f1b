#include "docent/planning/exploration/exploration_drive.h"

#include <gtest/gtest.h>

namespace docent::planning {
namespace {

/// A hall of 12 x 4 m, known up to `known` [m].
OccupancyGrid hall(double known) {
  OccupancyGrid map;
  map.frame = {240, 80, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 0; row < 80; ++row)
    for (int column = 0; column < 240; ++column) {
      if (map.frame.centre({column, row}).x > known) continue;
      const bool is_wall = row == 0 || row == 79 || column == 0 || column == 239;
      map.cells[map.frame.index({column, row})] = is_wall ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
    }
  return map;
}

ExplorationDrive drive_from(Point2 home) { return {{}, Explorer{{}}, home}; }

TEST(ExplorationDrive, GoesToWhatIsUnknownThenHomeThenStays) {
  const Point2 home{1.0, 2.0};
  ExplorationDrive drive = drive_from(home);
  Time now{};
  EXPECT_TRUE(drive.ahead(home).via.empty());
  drive.plan(hall(6.0), home, false, now);
  EXPECT_EQ(drive.state(), ExplorationDrive::State::exploring);
  EXPECT_GT(drive.frontier(), 0U);
  const auto ahead = drive.ahead(home);
  ASSERT_FALSE(ahead.via.empty());
  EXPECT_FALSE(ahead.is_final) << "it lies beyond the horizon";
  EXPECT_LE(ahead.via.back().x, home.x + 3.2);
  const Point2 far{9.0, 2.0};
  const auto plan_for = [&](double seconds_of_it, Point2 robot) {
    for (double t = 0.0; t < seconds_of_it; t += 1.0) drive.plan(hall(12.0), robot, false, now = now + seconds(1.0));
  };
  plan_for(20.0, far);
  EXPECT_EQ(drive.state(), ExplorationDrive::State::exploring) << "a way on may open";
  EXPECT_TRUE(drive.ahead(far).via.empty());
  plan_for(15.0, far);
  EXPECT_EQ(drive.state(), ExplorationDrive::State::returning);
  EXPECT_LT(drive.ahead(far).via.back().x, far.x);
  plan_for(1.0, home);
  EXPECT_EQ(drive.state(), ExplorationDrive::State::arrived);
  EXPECT_TRUE(drive.ahead(home).via.empty());
}

/// A robot that stands still at x = 5 m in a hall of which it knows 8 m, on its way on.
int seconds_until_it_gives_up(ExplorationDrive& drive, ExplorationDrive::Hindrance hindrance, int most) {
  Time now{};
  for (int i = 0; i < most; ++i) {
    drive.plan(hall(8.0), {5.0, 2.0}, false, now = now + seconds(1.0), hindrance);
    if (drive.frontier() == 0) return i;
  }
  return most;
}

TEST(ExplorationDrive, WhatBarsTheWayForGoodIsLookedAtOnce) {
  using Hindrance = ExplorationDrive::Hindrance;
  ExplorationDriveParams params;
  params.turned_away = 1e-3;  // [s]: the disc in its way alone would be forgotten at once
  const auto drive_with = [&](Hindrance hindrance, int most) {
    ExplorationDrive drive{params, Explorer{{}}, {5.0, 2.0}};
    const int took = seconds_until_it_gives_up(drive, hindrance, most);
    EXPECT_LE(drive.explorer().unreached(hall(8.0)).size(), 2U);
    return took;
  };
  const int ground = drive_with(Hindrance::ground, 200), thing = drive_with(Hindrance::thing, 200);
  const int person = drive_with(Hindrance::person, 200);
  EXPECT_LT(ground, thing) << "nobody moves a border";
  EXPECT_LT(thing, person) << "somebody may go away";
}

TEST(ExplorationDrive, ComesHomeThroughADoorThatIsHardlyWideEnough) {
  OccupancyGrid map = hall(12.0);
  for (int row = 1; row < 79; ++row) {  // a wall at 6 m, with a door of 0.65 m
    if (row < 34 || row > 46) map.cells[map.frame.index({120, row})] = OccupancyGrid::kOccupied;
  }
  const Point2 home{1.0, 2.0};
  EXPECT_TRUE(Explorer{{}}.way_to(map, {9.0, 2.0}, home).empty());
  ExplorationDrive drive = drive_from(home);
  Time now{};
  for (int i = 0; i < 40; ++i) drive.plan(map, {9.0, 2.0}, false, now = now + seconds(1.0));
  EXPECT_EQ(drive.state(), ExplorationDrive::State::returning);
  ASSERT_FALSE(drive.way().empty());
  EXPECT_LT(distance(drive.way().back(), home), 0.1);
}

TEST(ExplorationDrive, DoesNotDriveToAndFroBetweenTwoPlacesForEver) {
  OccupancyGrid west = hall(12.0);  // what is unknown lies in the west when it is in the east, and the other way round
  for (int row = 1; row < 79; ++row) {
    for (int column = 1; column < 20; ++column) west.cells[west.frame.index({column, row})] = OccupancyGrid::kUnknown;
  }
  ExplorationDrive drive = drive_from({4.0, 2.0});
  Time now{};
  int turns = 0;
  for (; turns < 200; ++turns) {
    drive.plan(turns % 2 == 0 ? hall(8.0) : west, {turns % 2 == 0 ? 3.0 : 6.0, 2.0}, false, now = now + seconds(10.0));
    if (drive.way().empty() || drive.state() != ExplorationDrive::State::exploring) break;
  }
  EXPECT_GT(turns, 5);
  EXPECT_LT(turns, 60) << "a line of unknown cells is some places wide";
}

TEST(ExplorationDrive, WhoHasWaitedForAWayIsNotHeldUpOnIt) {
  // A room whose door is the only way home: a mark in it would shut the robot in.
  OccupancyGrid map = hall(12.0);
  for (int row = 1; row < 79; ++row)
    if (row < 30 || row > 50) map.cells[map.frame.index({120, row})] = OccupancyGrid::kOccupied;
  const Point2 robot{6.8, 2.0};
  ExplorationDrive drive = drive_from({1.0, 2.0});
  Time now{};
  const auto plan = [&] { drive.plan(map, robot, false, now = now + seconds(1.0)); };
  for (int i = 0; i < 60 && drive.state() == ExplorationDrive::State::exploring; ++i) plan();
  ASSERT_EQ(drive.state(), ExplorationDrive::State::returning);
  for (int i = 0; i < 6; ++i) {  // it turns on the spot before it sets out
    plan();
    ASSERT_FALSE(drive.way().empty()) << i;
    EXPECT_LT(distance(drive.way().back(), {1.0, 2.0}), 0.2) << i << ": it is on its way home";
  }
}

TEST(ExplorationDrive, TurnsBackOnItsWayHomeWhenAWayHasOpened) {
  ExplorationDrive drive = drive_from({1.0, 2.0});
  Time now{};
  for (int i = 0; i < 40; ++i) drive.plan(hall(12.0), {9.0, 2.0}, false, now = now + seconds(1.0));
  ASSERT_EQ(drive.state(), ExplorationDrive::State::returning);
  drive.plan(hall(6.0), {5.0, 2.0}, false, now = now + seconds(1.0));
  EXPECT_EQ(drive.state(), ExplorationDrive::State::exploring);
}

TEST(ExplorationDrive, WhatHeldItUpDoesNotShutItIn) {
  // A corridor of 1.2 m whose left end is unknown; the robot is held up on its way there, which is its way home, too.
  OccupancyGrid map;
  map.frame = {240, 24, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 0; row < 24; ++row)
    for (int column = 40; column < 240; ++column) {
      const bool is_wall = row == 0 || row == 23 || column == 239;
      map.cells[map.frame.index({column, row})] = is_wall ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
    }
  ExplorationDrive drive = drive_from({2.6, 0.6});
  const Point2 robot{7.0, 0.6};
  Time now{};
  const auto plan = [&](ExplorationDrive::Hindrance hindrance) {
    drive.plan(map, robot, false, now = now + seconds(1.0), hindrance);
    return !drive.ahead(robot).via.empty();
  };
  ASSERT_TRUE(plan(ExplorationDrive::Hindrance::thing));
  int held = 0;
  while (plan(ExplorationDrive::Hindrance::thing) && held < 100) ++held;
  ASSERT_LT(held, 20) << "a thing in the way";
  int shut_in = 0;
  while (!plan(ExplorationDrive::Hindrance::unknown) && shut_in < 400) ++shut_in;
  EXPECT_LT(shut_in, 60) << "it came this way, so it may go back";
}

TEST(ExplorationDrive, GoesRoundWhereItIsHeldUpButNotWhileItWaits) {
  const Point2 robot{1.0, 2.0};
  ExplorationDrive drive = drive_from(robot);
  Time now{};
  const auto side_of_way = [&](bool waits) {
    for (int i = 0; i < 10; ++i) drive.plan(hall(6.0), robot, waits, now = now + seconds(1.0));
    double most = 0.0;
    for (const Point2 point : drive.way()) most = std::max(most, std::abs(point.y - robot.y));
    return most;
  };
  EXPECT_LT(side_of_way(true), 0.3);
  EXPECT_GT(side_of_way(false), 0.3);
}

}  // namespace
}  // namespace docent::planning
