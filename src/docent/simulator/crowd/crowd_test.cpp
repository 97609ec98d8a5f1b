#include "docent/simulator/crowd/crowd.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/simulator/crowd/steering.h"

namespace docent::simulator {
namespace {

Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

/// Two halls of 10 x 12 m joined by a door of 1.6 m, with cases.
World two_halls() {
  World world;
  world.floor = box(0.0, 0.0, 20.0, 12.0);
  world.operating_area = box(0.5, 0.5, 19.5, 11.5);
  world.home = {3.0, 3.0};
  world.solids.push_back({"wall-south", SolidKind::wall, box(9.9, 0.0, 10.1, 5.0), 0.0, 3.0, false});
  world.solids.push_back({"wall-north", SolidKind::wall, box(9.9, 6.6, 10.1, 12.0), 0.0, 3.0, false});
  for (int i = 0; i < 4; ++i) {
    const double x = 4.0 * i + (i < 2 ? 3.0 : 4.0);
    world.solids.push_back({"case", SolidKind::glass, box(x, 8.0, x + 1.0, 9.0), 0.0, 1.5, false});
    world.attractions.push_back({"case", {x + 0.5, 8.5}, 1.4, 1.0});
  }
  world.attractions.push_back({"bench", {16.0, 2.0}, 1.5, 1.0});
  world.entrances = {{1.0, 1.0}};
  return world;
}

RobotView robot_at(double x, double y) {
  RobotView view;
  view.position = {x, y};
  return view;
}

struct Visit {
  Crowd crowd;
  RobotView robot;
  double now = 0.0;
  void steps(double seconds_) {
    for (const double end = now + seconds_; now < end;) {
      now += 0.02;
      robot.position = robot.position + 0.02 * robot.velocity;
      crowd.step(now, 0.02, robot);
    }
  }
};

Visit make_run(std::size_t count, std::uint64_t seed, RobotView robot = robot_at(5.0, 5.0), CrowdParams params = {}) {
  const World world = two_halls();
  return {Crowd{world, WalkableFloor{world}, params, count, Rng{seed}, robot}, robot};
}

TEST(WalkableFloor, KnowsClearanceAndFreeArea) {
  const World world = two_halls();
  const WalkableFloor floor{world};
  EXPECT_NEAR(floor.clearance({5.0, 1.0}), 1.0, 0.03);
  EXPECT_NEAR(floor.clearance({9.5, 3.0}), 0.4, 0.03);
  EXPECT_LT(floor.clearance({3.5, 8.5}), -0.4);
  EXPECT_LT(floor.clearance({-0.5, 3.0}), 0.0);
  EXPECT_NEAR(floor.free_area(), 20.0 * 12.0 - 0.2 * 10.4 - 4.0, 2.0);
  EXPECT_TRUE(floor.is_clear({5.0, 5.8}, {15.0, 5.8}, 0.25));
  EXPECT_FALSE(floor.is_clear({5.0, 3.0}, {15.0, 3.0}, 0.25));
}

TEST(WalkableFloor, FindsTheWayThroughTheDoor) {
  const World world = two_halls();
  const WalkableFloor floor{world};
  FlowField field = floor.field_to({15.0, 2.0}, 0.3);
  Point2 point{2.0, 2.0};
  double walked = 0.0;
  for (int i = 0; i < 1000 && distance(point, {15.0, 2.0}) > 0.5; ++i) {
    const auto way = floor.direction(field, point, 0.25);
    ASSERT_TRUE(way);
    point = point + 0.05 * *way;
    walked += 0.05;
    EXPECT_GT(floor.clearance(point), 0.1);
  }
  EXPECT_LT(distance(point, {15.0, 2.0}), 0.5);
  EXPECT_LT(walked, 17.0);
  // What it says of the length, somewhat more where it is narrow.
  const auto told = floor.way(field, {2.0, 2.0});
  ASSERT_TRUE(told);
  EXPECT_GT(*told, walked - 1.0);
  EXPECT_LT(*told, 1.5 * walked);
  EXPECT_FALSE(floor.way(field, {-30.0, 2.0})) << "outside the building";
}

TEST(Crowd, LevelsAreThoseOfTheArchitecture) {
  EXPECT_EQ(crowd_density("quiet"), 0.02);
  EXPECT_EQ(crowd_density("busy"), 0.08);
  EXPECT_EQ(crowd_density("packed"), 0.2);
  EXPECT_EQ(crowd_density("empty"), 0.0);
  EXPECT_FALSE(crowd_density("crowded"));
}

TEST(Crowd, NobodyIsInsideASolidOrWalksThroughOthersForFiveMinutes) {
  for (const std::uint64_t seed : {1U, 2U}) {
    Visit run = make_run(40, seed);
    const World world = two_halls();
    int overlaps = 0;
    int samples = 0;
    for (int second = 0; second < 300; ++second) {
      run.steps(1.0);
      const auto people = run.crowd.people();
      ASSERT_EQ(people.size(), 40U);
      for (std::size_t i = 0; i < people.size(); ++i) {
        ASSERT_TRUE(contains(world.floor, people[i].position)) << "second " << second;
        ASSERT_LT(norm(people[i].velocity), 2.2);
        for (const Solid& solid : world.solids) {
          ASSERT_GT(distance(solid.polygon, people[i].position), 0.12) << solid.id << " second " << second;
        }
        for (std::size_t j = 0; j < i; ++j) {
          ++samples;
          const double gap = distance(people[i].position, people[j].position) - people[i].radius - people[j].radius;
          if (gap < -0.1) ++overlaps;
        }
      }
    }
    EXPECT_LT(overlaps, samples / 20000) << "of " << samples;
  }
}

TEST(Crowd, PeopleGetAboutAndStandBeforeExhibits) {
  Visit run = make_run(30, 3);
  std::vector<Point2> starts;
  for (const Person& person : run.crowd.people()) starts.push_back(person.position);
  int looking = 0;
  std::vector<double> farthest(30, 0.0);
  for (int second = 0; second < 240; ++second) {
    run.steps(1.0);
    for (std::size_t i = 0; i < 30; ++i) {
      const Person& person = run.crowd.people()[i];
      farthest[i] = std::max(farthest[i], distance(person.position, starts[i]));
      if (person.activity == Activity::look) ++looking;
    }
  }
  EXPECT_GE(std::count_if(farthest.begin(), farthest.end(), [](double way) { return way > 3.0; }), 24);
  EXPECT_GT(looking, 30 * 240 / 10);
}

TEST(Crowd, PeopleDoNotWalkIntoAStandingRobotUnlessTheyPush) {
  CrowdParams params;
  params.push_rate = 0.0;
  params.inattentive_share = 0.0;
  Visit run = make_run(40, 4, robot_at(5.0, 5.8), params);
  for (int i = 0; i < 3000; ++i) {
    run.steps(0.1);
    for (const Person& person : run.crowd.people()) {
      if (person.is_inattentive) continue;  // children who run
      ASSERT_GT(distance(person.position, run.robot.position), run.robot.radius + person.radius - 1e-6) << run.now;
    }
  }
}

TEST(Crowd, WhoHasWalkedIntoSomethingGetsRoundIt) {
  // Something stands before them, a hand's breadth to a side, and they want to where it stands in the way of.
  const World world = two_halls();
  const WalkableFloor floor{world};
  for (const double aside : {-0.05, 0.0, 0.05}) {
    for (const double speed : {0.5, 0.9, 1.3}) {
      Person person;
      person.position = {3.0, 4.0};
      const Point2 thing{3.52, 4.0 + aside};
      double since = 0.0;
      Point2 from = person.position;
      for (double now = 0.0; now < 15.0 && person.position.x < 4.5; now += 0.1) {
        if (distance(person.position, from) > 0.4) {
          from = person.position;
          since = now;
        }
        const Point2 goal{6.0, 4.0};
        const Point2 desired = (speed / distance(person.position, goal)) * (goal - person.position);
        const Neighbour neighbour{thing - person.position, {}, 0.265 + 0.25 + 0.35, 2.0};
        person.velocity = choose_velocity(person, desired, {&neighbour, 1}, floor, now - since);
        person.position = person.position + 0.1 * person.velocity;
        ASSERT_GT(distance(person.position, thing), 0.45);
      }
      EXPECT_GE(person.position.x, 4.5) << "aside " << aside << ", speed " << speed;
    }
  }
}

TEST(Crowd, TheRobotMeetsEveryKindOfAdventure) {
  CrowdParams params;
  params.block_rate = 0.01;  // rare ones made common
  params.wall_rate = 0.01;
  params.push_rate = 0.01;
  Visit run = make_run(60, 5, robot_at(5.0, 3.0), params);
  std::array<int, 12> seen{};
  for (int i = 0; i < 6000; ++i) {
    // To and fro at 0.3 m/s, with stops.
    const double phase = std::fmod(run.now, 40.0);
    const double speed = phase < 15.0 ? 0.3 : phase < 20.0 ? 0.0 : phase < 35.0 ? -0.3 : 0.0;
    run.robot.velocity = {speed, 0.0};
    run.robot.heading = speed < 0.0 ? 3.14159 : 0.0;
    if (i % 600 == 300) run.crowd.hear_speech(run.now + 8.0);
    if (i % 500 == 100) run.crowd.hear_horn(run.now);
    run.steps(0.1);
    for (const Person& person : run.crowd.people()) ++seen[static_cast<std::size_t>(person.activity)];
  }
  for (const Activity activity :
       {Activity::stroll, Activity::look, Activity::run, Activity::follow, Activity::curious, Activity::block,
        Activity::wall, Activity::push, Activity::listen, Activity::step_aside}) {
    EXPECT_GT(seen[static_cast<std::size_t>(activity)], 0) << static_cast<int>(activity);
  }
}

TEST(Crowd, TheHornClearsTheWay) {
  int cleared_with_horn = 0;
  int cleared_without = 0;
  constexpr int kTrials = 20;
  for (int trial = 0; trial < 2 * kTrials; ++trial) {
    const bool blows = trial % 2 == 0;
    Visit run = make_run(0, static_cast<std::uint64_t>(100 + trial / 2), robot_at(5.0, 4.0));
    const std::vector<Point2> places{{6.2, 3.6}, {6.2, 4.2}};
    run.steps(0.1);
    run.crowd.add_standing(places, run.now + 120.0);
    for (int blast = 0; blast < 4; ++blast) {
      if (blows) run.crowd.hear_horn(run.now);
      run.steps(5.0);
      const bool free = std::none_of(run.crowd.people().begin(), run.crowd.people().end(), [](const Person& person) {
        return person.position.x > 5.0 && person.position.x < 7.0 && std::abs(person.position.y - 4.0) < 0.55;
      });
      if (!free) continue;
      ++(blows ? cleared_with_horn : cleared_without);
      break;
    }
  }
  EXPECT_GE(cleared_with_horn, kTrials / 2);
  EXPECT_EQ(cleared_without, 0);
}

/// Of so many trials with somebody in its way, how often the way is clear after 15 s before this face.
int cleared(double valence, int requests, int trials, std::optional<double> heeds = std::nullopt) {
  int count = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Visit run = make_run(0, static_cast<std::uint64_t>(300 + trial), robot_at(5.0, 4.0));
    const std::vector<Point2> places{{6.2, 4.0}};
    run.steps(0.1);
    run.crowd.add_standing(places, run.now + 120.0, heeds);
    run.crowd.see_face(valence);
    for (int i = 0; i < 3; ++i) {
      if (i < requests) run.crowd.hear_request(run.now);
      run.steps(5.0);
    }
    count += run.crowd.people().front().position.x < 6.5 && std::abs(run.crowd.people().front().position.y - 4.0) < 0.5
                 ? 0
                 : 1;
  }
  return count;
}

TEST(Crowd, WhoIsAskedStepsAsideMoreOftenBeforeADispleasedFace) {
  constexpr int kTrials = 60;
  EXPECT_EQ(cleared(0.0, 0, kTrials), 0) << "nobody asks, and the face is neutral";
  EXPECT_EQ(cleared(1.0, 0, kTrials), 0);
  const int happy = cleared(1.0, 1, kTrials);
  const int neutral = cleared(0.0, 1, kTrials);
  const int angry = cleared(-1.0, 1, kTrials);
  EXPECT_GT(happy, 0);
  EXPECT_LT(happy, neutral);
  EXPECT_LT(neutral, angry);
  EXPECT_GT(cleared(-1.0, 0, kTrials), kTrials / 5) << "a displeased face alone";
  EXPECT_EQ(cleared(-1.0, 3, kTrials, 0.0), 0) << "who heeds nothing does not";
}

TEST(Crowd, ABlockerStaysInTheWayForMinutesButNotForEver) {
  CrowdParams params;
  params.block_rate = 1.0;  // the first who can
  params.follow_rate = params.curious_rate = params.wall_rate = params.push_rate = 0.0;
  params.near_share = 0.0;
  int blocked_long = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Visit run = make_run(25, seed, robot_at(2.5, 5.8), params);
    double blocked = 0.0;
    double longest = 0.0;
    for (int i = 0; i < 6000; ++i) {
      // It wants to the east and stops before people.
      const bool is_free =
          std::none_of(run.crowd.people().begin(), run.crowd.people().end(), [&](const Person& person) {
            const Point2 offset = person.position - run.robot.position;
            return offset.x > 0.0 && offset.x < 1.0 && std::abs(offset.y) < 0.6;
          });
      run.robot.velocity = {is_free && run.robot.position.x < 17.0 ? 0.4 : 0.0, 0.0};
      run.steps(0.1);
      blocked = is_free ? 0.0 : blocked + 0.1;
      longest = std::max(longest, blocked);
    }
    EXPECT_LT(longest, 240.0) << seed;
    if (longest > 30.0) ++blocked_long;
  }
  EXPECT_GE(blocked_long, 2);
}

TEST(Crowd, WhoCameByAScenarioLeavesForGood) {
  Visit run = make_run(10, 3);
  const std::vector<Point2> places{{14.0, 4.0}, {15.0, 4.0}, {16.0, 4.0}};
  run.crowd.add_standing(places, 20.0);
  EXPECT_EQ(run.crowd.people().size(), 13U);
  run.steps(300.0);
  EXPECT_EQ(run.crowd.people().size(), 10U);
}

TEST(Crowd, SpeechGathersListeners) {
  Visit run = make_run(40, 9, robot_at(5.0, 4.0));
  run.steps(30.0);
  const auto near = [&] {
    return std::count_if(run.crowd.people().begin(), run.crowd.people().end(), [&](const Person& person) {
      return person.activity == Activity::listen && distance(person.position, run.robot.position) < 2.6;
    });
  };
  EXPECT_EQ(near(), 0);
  run.crowd.hear_speech(run.now + 20.0);
  run.steps(15.0);
  EXPECT_GE(near(), 2);
  run.steps(15.0);
  EXPECT_EQ(near(), 0);
}

TEST(Crowd, PackedKeepsAQuarterNearTheRobot) {
  CrowdParams params;
  params.near_share = 0.25;
  Visit run = make_run(46, 11, robot_at(4.0, 3.0), params);
  double share = 0.0;
  for (int i = 0; i < 120; ++i) {
    run.steps(1.0);
    const auto people = run.crowd.people();
    share += static_cast<double>(std::count_if(
                 people.begin(), people.end(),
                 [&](const Person& person) { return distance(person.position, run.robot.position) <= 5.0; })) /
             static_cast<double>(people.size());
  }
  EXPECT_GT(share / 120.0, 0.23);
}

TEST(Crowd, APersonWithAWallBehindIsNotPushedIntoIt) {
  Visit run = make_run(0, 1, robot_at(5.0, 5.0));
  const std::vector<Point2> places{{9.6, 3.0}};
  run.crowd.add_standing(places, 60.0);
  ASSERT_EQ(run.crowd.people().size(), 1U);
  const double reach = 0.265 + run.crowd.people()[0].radius;
  EXPECT_GT(run.crowd.give_way(0, {9.25, 3.0}, reach), 0.05);
  EXPECT_LT(run.crowd.people()[0].position.x, 9.7);
  EXPECT_EQ(run.crowd.give_way(0, {9.6, 3.4}, reach), 0.0);  // there is room along the wall
  EXPECT_NEAR(distance(run.crowd.people()[0].position, {9.6, 3.4}), reach, 1e-6);
}

TEST(Crowd, PushersWaitAndThenPressFromTheirSide) {
  Visit run = make_run(0, 5, robot_at(3.0, 3.0));
  run.steps(0.1);
  run.crowd.add_pushers(4, {8.0, 4.0}, Angle::degrees(-90.0).radians(), 60.0);
  run.robot = robot_at(2.0, 1.0);  // 6.7 m away
  run.steps(10.0);
  for (const Person& person : run.crowd.people()) EXPECT_LT(distance(person.position, {8.0, 4.0}), 1.5);
  run.robot = robot_at(7.0, 2.5);
  run.steps(12.0);
  int near = 0;
  for (const Person& person : run.crowd.people()) {
    const bool is_near = distance(person.position, run.robot.position) < run.robot.radius + person.radius + 0.3;
    near += is_near && person.position.y > run.robot.position.y ? 1 : 0;
  }
  EXPECT_GE(near, 3) << "close to it, and all on the side from which they press";
  run.steps(200.0);
  EXPECT_TRUE(run.crowd.people().empty()) << "they leave for good";
}

/// Moments in two minutes in which somebody's body is within 3 cm of a robot that stands among 60 people.
int touches_of(double heedless) {
  CrowdParams params;
  params.push_rate = 0.0;
  params.inattentive_share = 0.0;
  params.heedless_share = heedless;
  Visit run = make_run(60, 4, robot_at(6.0, 6.0), params);
  int touches = 0;
  for (int i = 0; i < 1200; ++i) {
    run.steps(0.1);
    for (const Person& person : run.crowd.people()) {
      EXPECT_EQ(person.is_heedless, heedless == 1.0);
      const Disc part = nearest_part(person.posture(), run.robot.position, 1.2);
      touches += distance(part.centre, run.robot.position) - part.radius - run.robot.radius < 0.03 ? 1 : 0;
    }
  }
  return touches;
}

TEST(Crowd, TheHeedlessWalkIntoARobotThatOthersKeepOff) {
  const int evading = touches_of(0.0);
  EXPECT_GT(touches_of(1.0), 3 * evading + 20);
}

TEST(Crowd, WhoWalksFacesTheirWayAlsoBehindAPram) {
  CrowdParams params;
  params.push_rate = 0.0;
  params.inattentive_share = 0.0;
  params.physique.bodies = Bodies::legs;
  params.physique.pram_share = 0.3;
  Visit run = make_run(40, 8, robot_at(6.0, 6.0), params);
  double facing = 0.0;
  int walking = 0;
  for (int i = 0; i < 600; ++i) {
    run.steps(0.1);
    for (const Person& person : run.crowd.people()) {
      const double speed = norm(person.velocity);
      if (speed < 0.5) continue;
      ++walking;
      facing += dot(person.gait.facing(), person.velocity) / speed;
    }
  }
  EXPECT_GT(walking, 1000);
  EXPECT_GT(facing / walking, 0.9);
}

TEST(Crowd, ChildrenWhoRompKeepToTheirGroundAndHeedNoHorn) {
  Visit run = make_run(0, 6, robot_at(5.0, 5.0));
  run.steps(0.1);
  run.crowd.add_runners(5, {5.0, 4.5}, 2.5, 120.0);
  double fastest = 0.0;
  double farthest = 0.0;
  for (int i = 0; i < 400; ++i) {
    if (i % 50 == 0) run.crowd.hear_horn(run.now);
    run.steps(0.1);
    for (const Person& person : run.crowd.people()) {
      EXPECT_EQ(person.activity, Activity::romp);
      fastest = std::max(fastest, norm(person.velocity));
      farthest = std::max(farthest, distance(person.position, {5.0, 4.5}));
    }
  }
  EXPECT_GT(fastest, 1.3);
  EXPECT_LT(farthest, 3.5);
}

}  // namespace
}  // namespace docent::simulator
