#include "docent/simulator/crowd/replay.h"

#include <gtest/gtest.h>

#include <set>

#include "docent/simulator/crowd/crowd.h"

namespace docent::simulator {
namespace {

/// One person who walks two metres in ten seconds, again and again, and one who stands.
Recording hall() {
  Recording recording{"hall", 20.0, {{4.0, {}}, {0.0, {}}}};
  for (int i = 0; i <= 25; ++i) recording.tracks[0].points.push_back({2.0 + 0.08 * i, 5.0});
  for (int i = 0; i <= 49; ++i) recording.tracks[1].points.push_back({8.0, 2.0});
  return recording;
}

World hall_world() {
  World world;
  world.floor = {{0, 0}, {12, 0}, {12, 10}, {0, 10}};
  world.operating_area = world.floor;
  world.entrances = {{1, 1}};
  world.home = {6, 9};
  world.attractions = {{"a", {6, 1}, 1.0, 1.0}};
  world.pedestrians = {hall()};
  return world;
}

/// 50 Hz.
void run(Crowd& crowd, const RobotView& robot, double& now, double duration) {
  for (const double end = now + duration; now < end; now += 0.02) crowd.step(now, 0.02, robot);
}

std::vector<const Person*> recorded(const Crowd& crowd) {
  std::vector<const Person*> result;
  for (const Person& person : crowd.people()) {
    if (person.activity == Activity::recorded) result.push_back(&person);
  }
  return result;
}

TEST(Replay, EveryTrackBeginsOnceARound) {
  Replay replay{{hall()}, Rng{3}};
  std::vector<Walk> walks;
  for (double now = 0.0; now <= 200.0; now += 0.5) replay.begin(now, walks);
  EXPECT_GE(walks.size(), 20U);
  EXPECT_LE(walks.size(), 22U);
  std::set<std::pair<std::size_t, double>> different;
  for (const Walk& walk : walks) different.insert({walk.track, walk.origin});
  EXPECT_EQ(different.size(), walks.size());
  EXPECT_NEAR(replay.at(walks.back(), walks.back().origin + 5.0).y, hall().tracks[walks.back().track].at(5.0).y, 1e-9);
}

TEST(Replay, RecordedPeopleWalkWhereTheyWalkedWhateverTheRobotDoes) {
  const World world = hall_world();
  RobotView robot;
  robot.position = {3.0, 5.0};  // in the middle of their way
  robot.radius = 0.265;
  Crowd crowd{world, WalkableFloor{world}, {}, 2, Rng{5}, robot};
  double now = 0.0;
  double nearest = 1e9;
  for (int i = 0; i < 3000; ++i) {
    run(crowd, robot, now, 0.02);
    crowd.hear_horn(now);
    for (const Person* person : recorded(crowd)) {
      EXPECT_LE(std::abs(person->position.y - 5.0) * std::abs(person->position.y - 2.0), 1e-6);
      if (person->position.y > 4.0) nearest = std::min(nearest, distance(person->position, robot.position));
    }
  }
  // Too near to appear at the track's begin, they come in when there is room.
  EXPECT_GT(nearest, robot.radius + 0.9);
}

TEST(Replay, NobodyAppearsBeforeTheRobot) {
  World world = hall_world();
  RobotView robot;
  robot.position = {6.0, 5.0};
  robot.radius = 0.265;
  Crowd crowd{world, WalkableFloor{world}, {}, 2, Rng{6}, robot};
  std::set<std::uint32_t> known;
  double now = 0.0;
  for (int i = 0; i < 5000; ++i) {
    for (const Person* person : recorded(crowd)) {
      if (!known.insert(person->id).second) continue;
      EXPECT_GE(distance(person->position, robot.position), 2.9);
    }
    run(crowd, robot, now, 0.02);
  }
  EXPECT_GE(known.size(), 5U);
}

TEST(Replay, ArePartOfTheCrowdAndTheOthersFillItUp) {
  World world = hall_world();
  world.pedestrians[0].tracks.clear();
  for (int i = 0; i < 5; ++i) {
    Track track{0.0, {}};
    for (int k = 0; k <= 49; ++k) track.points.push_back({2.0 + 1.5 * i, 7.0});
    world.pedestrians[0].tracks.push_back(track);
  }
  RobotView robot;
  robot.position = {6.0, 1.0};
  const auto count_of = [&](std::size_t count) {
    Crowd crowd{world, WalkableFloor{world}, {}, count, Rng{1}, robot};
    double now = 0.0;
    run(crowd, robot, now, 1.0);
    const std::size_t of_recording = recorded(crowd).size();
    return std::pair{of_recording, crowd.people().size() - of_recording};
  };
  EXPECT_EQ(count_of(0), (std::pair<std::size_t, std::size_t>{0, 0}));
  EXPECT_EQ(count_of(12), (std::pair<std::size_t, std::size_t>{5, 7}));
  EXPECT_EQ(count_of(3), (std::pair<std::size_t, std::size_t>{5, 0})) << "no walk is left out";
}

TEST(Replay, WhoIsPushedOffTheirTrackComesBackToIt) {
  const World world = hall_world();
  RobotView robot;
  robot.position = {11.0, 9.0};
  Crowd crowd{world, WalkableFloor{world}, {}, 2, Rng{5}, robot};
  double now = 0.0;
  while (recorded(crowd).empty()) run(crowd, robot, now, 0.02);
  const auto index = static_cast<std::size_t>(recorded(crowd).front() - crowd.people().data());
  const Point2 before = crowd.people()[index].position;
  EXPECT_EQ(crowd.give_way(index, before + Point2{0.0, 0.2}, 0.5), 0.0);
  EXPECT_NEAR(distance(crowd.people()[index].position, before), 0.3, 1e-6);
  run(crowd, robot, now, 0.3);
  ASSERT_LT(index, crowd.people().size());
  EXPECT_NEAR(crowd.people()[index].position.y, before.y, 1e-6);
}

}  // namespace
}  // namespace docent::simulator
