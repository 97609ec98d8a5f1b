#include "docent/simulator/physique/physique.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "docent/simulator/physique/slice.h"

namespace docent::simulator {
namespace {

/// How far somebody who stands at the origin and faces +x reaches ahead and to the left [m], of what is cut.
struct Extent {
  double ahead = 0.0;
  double aside = 0.0;
};
Extent extent_at(const Physique& physique, double height) {
  Extent extent;
  for (const BodyPart& part : physique.parts) {
    if (height < part.bottom || height > part.top) continue;
    extent.ahead = std::max(extent.ahead, part.at.x + part.radius);
    extent.aside = std::max(extent.aside, part.at.y + part.radius);
  }
  return extent;
}

PhysiqueParams nothing_carried() {
  PhysiqueParams params;
  params.bag_share = params.rucksack_share = params.cane_share = params.pram_share = params.wheelchair_share = 0.0;
  return params;
}

TEST(Physique, LegsEndAHandBeforeTheBodyAheadAndToTheSides) {
  Rng rng{3};
  Extent legs;
  Extent bodies;
  constexpr int kPeople = 500;
  for (int i = 0; i < kPeople; ++i) {
    const double height = rng.uniform(1.55, 1.95);
    const Physique physique = draw_physique(nothing_carried(), {false, height, rng.uniform(0.22, 0.28)}, rng);
    const Extent low = extent_at(physique, 0.3);
    const Extent high = extent_at(physique, 1.2);
    EXPECT_GE(low.ahead, 0.05);
    EXPECT_LE(low.ahead, 0.07);
    legs.ahead += low.ahead / kPeople;
    legs.aside += low.aside / kPeople;
    bodies.ahead += high.ahead / kPeople;
    bodies.aside += high.aside / kPeople;
  }
  EXPECT_NEAR(bodies.ahead - legs.ahead, 0.12, 0.02);
  EXPECT_NEAR(bodies.aside - legs.aside, 0.11, 0.02);
}

TEST(Physique, EveryHeightOfALaserSeesEverybody) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Rng rng{seed};
    const bool is_child = rng.chance(0.2);
    const Stature stature{is_child, is_child ? rng.uniform(0.95, 1.35) : rng.uniform(1.55, 1.95),
                          is_child ? rng.uniform(0.15, 0.18) : rng.uniform(0.22, 0.28)};
    const Physique physique = draw_physique({}, stature, rng);
    Slice slice;
    const Posture posture{{2.0, 0.0}, unit(Angle::radians(rng.uniform(-3.0, 3.0))), 0.0, &physique};
    for (const double height : {0.1, 0.2, 0.38, 0.5, 0.9}) {
      slice.cut({&posture, 1}, height, {}, 5.0);
      EXPECT_FALSE(slice.discs().empty()) << "seed " << seed << " at " << height << " m";
    }
    EXPECT_GE(physique.reach, reach_towards(posture, {1.0, 0.0}));
  }
}

TEST(Physique, AidsComeAtTheirShares) {
  const PhysiqueParams params;
  Rng rng{5};
  std::array<int, 6> drawn{};
  constexpr int kPeople = 20000;
  for (int i = 0; i < kPeople; ++i) ++drawn[static_cast<std::size_t>(draw_physique(params, {}, rng).aid)];
  const auto share = [&](Aid aid) { return static_cast<double>(drawn[static_cast<std::size_t>(aid)]) / kPeople; };
  EXPECT_NEAR(share(Aid::bag), params.bag_share, 0.01);
  EXPECT_NEAR(share(Aid::rucksack), params.rucksack_share, 0.01);
  EXPECT_NEAR(share(Aid::cane), params.cane_share, 0.005);
  EXPECT_NEAR(share(Aid::pram), params.pram_share, 0.005);
  EXPECT_NEAR(share(Aid::wheelchair), params.wheelchair_share, 0.004);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(draw_physique(params, {true, 1.1, 0.16}, rng).aid, Aid::none);
}

TEST(Physique, OneSeedDrawsOnePerson) {
  Rng one{9};
  Rng other{9};
  for (int i = 0; i < 50; ++i) {
    const Physique a = draw_physique({}, {}, one);
    const Physique b = draw_physique({}, {}, other);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::size_t k = 0; k < a.parts.size(); ++k) EXPECT_EQ(a.parts[k].at, b.parts[k].at);
  }
}

TEST(Physique, DiscsAreDiscsAndDrawNothing) {
  Rng rng{1};
  const Rng before = rng;
  const Physique disc = draw_physique({.bodies = Bodies::discs}, {false, 1.8, 0.27}, rng);
  ASSERT_EQ(disc.parts.size(), 1U);
  EXPECT_EQ(disc.parts[0].radius, 0.27);
  Rng untouched = before;
  EXPECT_EQ(rng(), untouched());
  EXPECT_EQ(bodies_of("legs"), Bodies::legs);
  EXPECT_EQ(bodies_of("discs"), Bodies::discs);
  EXPECT_FALSE(bodies_of("wheels"));
}

/// Places of one leg, step by step, of somebody who walks along x with 1 m/s.
std::vector<double> places_of_left_leg(const Physique& physique, int steps) {
  Gait gait;
  std::vector<double> places;
  double at = 0.0;
  for (int i = 0; i < steps; ++i) {
    at += 0.02;
    gait.walk({1.0, 0.0}, 0.02, physique);
    places.push_back(at + gait.swing());
  }
  return places;
}

TEST(Gait, TheLegThatCarriesStandsStillAndTheOtherOneCatchesUp) {
  Rng rng{2};
  const Physique physique = draw_physique(nothing_carried(), {}, rng);
  const std::vector<double> places = places_of_left_leg(physique, 300);
  int standing = 0;
  double farthest = 0.0;
  for (std::size_t i = 50; i + 1 < places.size(); ++i) {
    const double way = places[i + 1] - places[i];
    EXPECT_GE(way, -1e-9) << "no leg goes back";
    standing += static_cast<int>(std::abs(way) < 1e-9);
    farthest = std::max(farthest, way);
  }
  EXPECT_NEAR(standing / 249.0, 0.5, 0.1);
  EXPECT_NEAR(farthest, 0.04, 1e-9) << "twice as fast as the body";
}

TEST(Gait, WhoStandsDrawsTheirLegsTogetherAndFacesOn) {
  Rng rng{2};
  const Physique physique = draw_physique(nothing_carried(), {}, rng);
  Gait gait;
  for (int i = 0; i < 100; ++i) gait.walk({0.0, 1.0}, 0.02, physique);
  EXPECT_NEAR(gait.facing().y, 1.0, 1e-6);
  for (int i = 0; i < 100; ++i) gait.walk({-0.05, 0.0}, 0.02, physique);
  EXPECT_NEAR(gait.facing().y, 1.0, 1e-6);
  EXPECT_EQ(gait.swing(), 0.0);
}

TEST(Gait, NobodyTurnsAtOnce) {
  Physique physique = one_disc(0.25);
  physique.turn_rate = 1.5;
  Gait gait;
  gait.walk({-1.0, 0.1}, 0.1, physique);
  EXPECT_NEAR(std::atan2(gait.facing().y, gait.facing().x), 0.15, 1e-9);
}

}  // namespace
}  // namespace docent::simulator
