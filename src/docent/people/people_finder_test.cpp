#include "docent/people/people_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/people/testing.h"

namespace docent::people {
namespace {

constexpr Pose2 kMapFromOdom{};

/// A hall of which the map knows the walls.
Scene hall(Rng& rng, const Pose2& robot = {}) {
  Scene scene{&rng, robot};
  scene.add_wall({-5.0, -4.0}, {6.0, -4.0}, true);
  scene.add_wall({-5.0, 4.0}, {6.0, 4.0}, true);
  scene.add_wall({6.0, -4.0}, {6.0, 4.0}, true);
  return scene;
}

bool finds(const PeopleFinder& finder, Point2 place) {
  return std::any_of(finder.people().begin(), finder.people().end(),
                     [&](const TrackedPerson& person) { return distance(person.position, place) < 0.3; });
}

TEST(PeopleFinder, AStandingVisitorIsFoundByADrivingRobot) {
  Rng rng{1};
  PeopleFinder finder{{}};
  for (int i = 0; i < 50; ++i) {
    Scene scene = hall(rng, {-3.0 + 0.05 * i, 0.0, Angle::degrees(2.0 * i)});
    scene.add_disc({1.0, 1.5}, 0.25);
    finder.update(scene.sweep(), kMapFromOdom, time_from_seconds(0.1 * i));
    if (i >= 3) {
      ASSERT_EQ(finder.people().size(), 1U) << i;
      EXPECT_TRUE(finds(finder, {1.0, 1.5})) << i;
    }
  }
  EXPECT_EQ(finder.people()[0].id, 1U);
}

TEST(PeopleFinder, PeopleStayWhenTheRobotGetsLost) {
  Rng rng{2};
  PeopleFinder finder{{}};
  std::uint32_t id = 0;
  for (int i = 0; i < 100; ++i) {
    Scene scene = hall(rng);
    scene.add_disc({2.0, 1.5}, 0.25);  // stands
    scene.add_disc(
        {
            3.0,
            -2.0 + 0.04 * std::clamp(i - 30, 0, 40),
        },
        0.25);  // stands, walks, stands
    const bool knows = i < 50;
    finder.update(scene.sweep(knows), knows ? std::optional{kMapFromOdom} : std::nullopt, time_from_seconds(0.1 * i));
    if (i == 40) id = finder.people()[0].id;
    if (i > 50) {
      EXPECT_TRUE(finds(finder, {2.0, 1.5})) << i;
      EXPECT_TRUE(finds(finder, {3.0, -2.0 + 0.04 * std::clamp(i - 30, 0, 40)})) << i;
      EXPECT_EQ(finder.people().size(), 2U) << i;
    }
  }
  EXPECT_EQ(finder.people()[0].id, id);
}

TEST(PeopleFinder, WithoutAMapWhoComesIsFoundAndTheColumnIsNot) {
  Rng rng{3};
  PeopleFinder finder{{}};
  for (int i = 0; i < 60; ++i) {
    Scene scene = hall(rng);
    scene.add_disc({2.0, 2.0}, 0.25);
    scene.add_disc({3.5, -3.0 + 0.1 * i}, 0.24);
    finder.update(scene.sweep(false), std::nullopt, time_from_seconds(0.1 * i));
  }
  EXPECT_FALSE(finds(finder, {2.0, 2.0}));
  EXPECT_TRUE(finds(finder, {3.5, 2.9}));
}

TEST(PeopleFinder, ABenchIsNobodyAndAPlantIsSomebodyForAWhile) {
  Rng rng{4};
  PeopleFinder finder{{}};
  const double patience = StandingThingParams{}.patience();
  for (int i = 0; i < static_cast<int>(10.0 * (patience + 3.0)); ++i) {
    Scene scene = hall(rng);
    scene.add_wall({3.0, -1.0}, {3.2, 0.8});
    scene.add_disc({1.5, 2.0}, 0.28);
    finder.update(scene.sweep(), kMapFromOdom, time_from_seconds(0.1 * i));
    if (i == 50) {
      EXPECT_EQ(finder.people().size(), 1U);
      EXPECT_TRUE(finds(finder, {1.5, 2.0}));
    }
  }
  EXPECT_TRUE(finder.people().empty());
}

/// Two legs that walk along y, in odometry's frame.
void add_walker(Scene& scene, Point2 at, double phase) {
  const double stride = 0.15 * std::sin(phase);
  scene.add_disc({at.x - 0.09, at.y + stride}, 0.06);
  scene.add_disc({at.x + 0.09, at.y - stride}, 0.06);
}

TEST(PeopleFinder, WhereLasersMeetLegsPlantsAndStoolsAreNobody) {
  const Point2 plant{1.5, 2.0};
  const Point2 stool{-1.5, 2.0};
  const auto things_taken_for_people = [&](double body) {
    Rng rng{7};
    PeopleFinder finder{{}};
    for (int i = 0; i < 600; ++i) {
      const double t = 0.1 * i;
      Scene scene = hall(rng);
      scene.add_disc(plant, 0.28);
      scene.add_disc(stool, 0.16);
      for (int passer = 0; passer < 2; ++passer) {  // one after the other
        const Point2 at{2.2 + passer, -3.6 + std::fmod(0.8 * t + 3.0 * passer, 7.2)};
        if (body > 0.0) scene.add_disc(at, body);
        if (body <= 0.0) add_walker(scene, at, 6.0 * t);
      }
      finder.update(scene.sweep(), kMapFromOdom, time_from_seconds(t));
    }
    return (finds(finder, plant) ? 1 : 0) + (finds(finder, stool) ? 1 : 0);
  };
  EXPECT_EQ(things_taken_for_people(0.0), 0);
  EXPECT_EQ(things_taken_for_people(0.27), 2) << "where they meet bodies they may be people";
}

TEST(PeopleFinder, WhoCameAndStandsForLongStaysAPerson) {
  Rng rng{5};
  PeopleFinder finder{{}};
  for (int i = 0; i < 2500; ++i) {
    Scene scene = hall(rng);
    scene.add_disc({3.0, std::max(0.0, 3.0 - 0.1 * i)}, 0.24);
    finder.update(scene.sweep(), kMapFromOdom, time_from_seconds(0.1 * i));
    if (i > 10) {
      ASSERT_EQ(finder.people().size(), 1U) << i;
    }
  }
}

TEST(PeopleFinder, OdometryThatBeginsAnewLeavesNoGhosts) {
  Rng rng{6};
  PeopleFinder finder{{}};
  for (int i = 0; i < 10; ++i) {
    Scene scene = hall(rng);
    scene.add_disc({2.0, 0.0}, 0.25);
    finder.update(scene.sweep(), kMapFromOdom, time_from_seconds(0.1 * i));
  }
  EXPECT_EQ(finder.people().size(), 1U);
  PeopleSweep elsewhere = hall(rng).sweep();
  elsewhere.odom_from_base = {40.0, 7.0, Angle{}};
  finder.update(elsewhere, std::nullopt, time_from_seconds(1.1));
  EXPECT_TRUE(finder.people().empty());
}

}  // namespace
}  // namespace docent::people
