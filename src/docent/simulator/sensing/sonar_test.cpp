#include "docent/simulator/sensing/sonar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A wall of 8 m, 2 m before the body's centre, that the sonar at the front meets at `incidence`.
World slanted_wall(double incidence, SolidKind kind = SolidKind::wall) {
  const Pose2 world_from_wall{2.0, 0.0, Angle::radians(incidence)};
  Polygon polygon;
  for (const Point2 corner : {Point2{0.0, -4.0}, Point2{0.2, -4.0}, Point2{0.2, 4.0}, Point2{0.0, 4.0}}) {
    polygon.push_back(world_from_wall * corner);
  }
  World world;
  world.solids.push_back({"wall", kind, polygon, 0.0, 3.0, false});
  return world;
}

/// What the front sonar reads in many pings, by kind.
std::map<EchoKind, std::vector<double>> front_pings(const World& world, const std::vector<Disc>& people = {},
                                                    int count = 400) {
  const RayCaster walls{sonar_surfaces(world)};
  SonarParams params;
  params.sound_error = 0.0;
  SonarRing ring{params, Rng{5}};
  std::map<EchoKind, std::vector<double>> result;
  for (int i = 0; i < count; ++i) {
    const Ping ping = ring.fire(0, walls, people, Pose2{})[0];
    result[ping.kind].push_back(ping.range);
  }
  return result;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(Sonar, AFacingWallReadsItsDistanceWithSmallQuantisedErrors) {
  auto pings = front_pings(slanted_wall(0.0));
  const auto& direct = pings[EchoKind::direct];
  ASSERT_GT(direct.size(), 380U);
  EXPECT_NEAR(mean(direct), 1.75, 0.003);
  double squares = 0.0;
  for (const double range : direct) {
    EXPECT_NEAR(std::round(range * 100.0), range * 100.0, 1e-6);
    squares += (range - 1.75) * (range - 1.75);
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(direct.size())), 0.013, 0.004);
}

TEST(Sonar, ASlantedSmoothWallAnswersFromItsNearestPointOrNotAtAll) {
  auto some = front_pings(slanted_wall(Angle::degrees(10.0).radians()));
  ASSERT_GT(some[EchoKind::direct].size(), 350U);
  EXPECT_NEAR(mean(some[EchoKind::direct]), 1.75 * std::cos(Angle::degrees(10.0).radians()), 0.03);
  const auto unseen = [](double degrees, SolidKind kind) {
    return front_pings(slanted_wall(Angle::degrees(degrees).radians(), kind))[EchoKind::none].size();
  };
  EXPECT_LT(unseen(10.0, SolidKind::wall), 20U);
  EXPECT_GT(unseen(30.0, SolidKind::wall), 380U);
  EXPECT_GT(unseen(45.0, SolidKind::glass), 380U);
  EXPECT_LT(unseen(30.0, SolidKind::furniture), 40U) << "rough";
}

TEST(Sonar, AMirrorShowsWhatStandsBesideIt) {
  World world = slanted_wall(Angle::degrees(45.0).radians());
  // The mirror at 45 degrees throws the sound to the right, onto a wall that faces it.
  world.solids.push_back(
      {"side", SolidKind::wall, {{0.0, -1.7}, {4.0, -1.7}, {4.0, -1.5}, {0.0, -1.5}}, 0.0, 3.0, false});
  auto pings = front_pings(world);
  ASSERT_GT(pings[EchoKind::bounced].size(), 300U);
  EXPECT_NEAR(mean(pings[EchoKind::bounced]), 1.75 + 1.5, 0.1) << "longer than the wall before the sonar";
}

TEST(Sonar, TheInsideOfACornerAnswersFromEverywhere) {
  World world;
  world.solids.push_back({"a", SolidKind::wall, {{-6.0, 2.0}, {2.0, 2.0}, {2.0, 2.2}, {-6.0, 2.2}}, 0.0, 3.0, false});
  world.solids.push_back({"b", SolidKind::wall, {{2.0, -6.0}, {2.2, -6.0}, {2.2, 2.2}, {2.0, 2.2}}, 0.0, 3.0, false});
  const RayCaster walls{sonar_surfaces(world)};
  SonarParams params;
  params.sound_error = 0.0;
  SonarRing ring{params, Rng{5}};
  int heard = 0;
  for (int i = 0; i < 200; ++i) {
    const Ping ping = ring.fire(3, walls, {}, Pose2{})[0];  // looks at 45 degrees into the corner
    if (ping.kind == EchoKind::bounced && std::abs(ping.range - (2.0 * std::numbers::sqrt2 - 0.25)) < 0.1) ++heard;
  }
  EXPECT_GT(heard, 180);
}

TEST(Sonar, EdgesAndPeopleAnswerWhereAWallWouldNot) {
  const double slant = Angle::degrees(40.0).radians();
  World world = slanted_wall(slant);
  auto people = front_pings(world, {{{1.3, 0.0}, 0.25}});
  ASSERT_GT(people[EchoKind::direct].size(), 380U);
  EXPECT_NEAR(mean(people[EchoKind::direct]), 1.3 - 0.25 - 0.25, 0.01);
  // The same wall, ending before the sonar.
  World stub;
  const Pose2 world_from_wall{2.0, 0.0, Angle::radians(slant)};
  stub.solids.push_back({"stub",
                         SolidKind::wall,
                         {world_from_wall * Point2{0.0, 0.02}, world_from_wall * Point2{0.2, 0.02},
                          world_from_wall * Point2{0.2, 4.0}, world_from_wall * Point2{0.0, 4.0}},
                         0.0,
                         3.0,
                         false});
  auto edge = front_pings(stub);
  ASSERT_GT(edge[EchoKind::direct].size(), 300U);
  EXPECT_NEAR(mean(edge[EchoKind::direct]), 1.75, 0.05);
}

TEST(Sonar, CrossTalkReadsTooShort) {
  // Close to a wall at the left back (sonar 8 faces it); the front sonar looks 4 m down a corridor.
  World world;
  world.solids.push_back(
      {"far", SolidKind::wall, {{4.25, -3.0}, {4.4, -3.0}, {4.4, 3.0}, {4.25, 3.0}}, 0.0, 3.0, false});
  const Pose2 place{0.0, 0.0, Angle::degrees(120.0)};
  world.solids.push_back(
      {"near",
       SolidKind::wall,
       {place * Point2{0.8, -1.0}, place * Point2{1.0, -1.0}, place * Point2{1.0, 1.0}, place * Point2{0.8, 1.0}},
       0.0,
       3.0,
       false});
  auto pings = front_pings(world, {}, 4000);
  const auto& stray = pings[EchoKind::cross_talk];
  EXPECT_NEAR(static_cast<double>(stray.size()) / 4000.0, SonarParams{}.cross_talk, 0.01);
  for (const double range : stray) {
    EXPECT_LT(range, 4.0);
    EXPECT_GT(range, 0.5);
  }
  EXPECT_LT(mean(stray), 1.5);
}

TEST(Sonar, TheSpeedOfSoundIsWrongTheWholeDayAndRunsRepeat) {
  const RayCaster walls{sonar_surfaces(slanted_wall(0.0))};
  std::array<double, 2> means{};
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (double& result : means) {
      SonarRing ring{SonarParams{}, Rng{seed}};
      double sum = 0.0;
      for (int i = 0; i < 300; ++i) sum += std::min(ring.fire(0, walls, {}, Pose2{})[0].range, 2.0);
      result = sum / 300.0;
    }
    EXPECT_EQ(means[0], means[1]);
    EXPECT_NEAR(means[0], 1.75, 0.02);
  }
}

TEST(Sonar, GroupsAreEveryThirdOfTheRingAndCoverIt) {
  const RayCaster walls{sonar_surfaces(slanted_wall(0.0))};
  SonarRing ring{SonarParams{}, Rng{1}};
  std::array<int, 24> fired{};
  for (int group = 0; group < ring.groups(); ++group) {
    const auto pings = ring.fire(group, walls, {}, Pose2{});
    ASSERT_EQ(pings.size(), 3U);
    for (const Ping& ping : pings) ++fired[static_cast<std::size_t>(ping.index)];
    EXPECT_NEAR((pings[1].index - pings[0].index) * kTurn / 24.0, kTurn / 3.0, 1e-9);
  }
  EXPECT_EQ(std::count(fired.begin(), fired.end(), 1), 24);
}

}  // namespace
}  // namespace docent::simulator
