#include "docent/simulator/physique/slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::simulator {
namespace {

/// Two legs of 6 cm, 10 cm to each side, and a trunk of 20 cm above them.
Physique plain() {
  Physique physique;
  physique.parts = {{{0.0, 0.1}, 0.06, 0.0, 0.8, 1.0, false},
                    {{0.0, -0.1}, 0.06, 0.0, 0.8, -1.0, false},
                    {{0.0, 0.0}, 0.2, 0.8, 1.7, 0.0, true}};
  physique.reach = 0.35;
  return physique;
}

TEST(Slice, CutsWhatStandsAtItsHeight) {
  const Physique physique = plain();
  const std::array<Posture, 2> people{Posture{{2.0, 0.0}, {0.0, 1.0}, 0.15, &physique},
                                      Posture{{30.0, 0.0}, {0.0, 1.0}, 0.0, &physique}};
  Slice slice;
  slice.cut(people, 0.38, {}, 10.0);
  ASSERT_EQ(slice.discs().size(), 2U) << "who is far is left out";
  EXPECT_EQ(slice.persons()[0], 0U);
  // They face +y: the left leg is ahead of them, to the left is -x.
  EXPECT_NEAR(slice.discs()[0].centre.x, 1.9, 1e-12);
  EXPECT_NEAR(slice.discs()[0].centre.y, 0.15, 1e-12);
  EXPECT_NEAR(slice.discs()[1].centre.x, 2.1, 1e-12);
  EXPECT_NEAR(slice.discs()[1].centre.y, -0.15, 1e-12);
  slice.cut(people, 1.0, {}, 10.0);
  ASSERT_EQ(slice.discs().size(), 1U);
  EXPECT_EQ(slice.discs()[0].radius, 0.2);
  slice.cut_trunks(people, {29.0, 0.0}, 3.0);
  ASSERT_EQ(slice.discs().size(), 1U);
  EXPECT_EQ(slice.persons()[0], 1U) << "whose it is";
}

TEST(Slice, ABodyMeetsWhatIsNearestOfThemBelowItsTop) {
  const Physique physique = plain();
  const Posture posture{{1.0, 0.0}, {1.0, 0.0}, 0.0, &physique};
  EXPECT_EQ(nearest_part(posture, {0.0, 0.0}, 1.2).radius, 0.2) << "the trunk";
  EXPECT_EQ(nearest_part(posture, {0.0, 0.0}, 0.5).radius, 0.06) << "a low robot meets legs";
  EXPECT_NEAR(reach_towards(posture, {1.0, 0.0}), 0.2, 1e-12);
  EXPECT_NEAR(reach_towards({{1.0, 0.0}, {1.0, 0.0}, 0.3, &physique}, {1.0, 0.0}), 0.36, 1e-12)
      << "a leg in mid-stride";
}

TEST(Slice, TheNearestPartIsThatOfALookAtAllOfThem) {
  Rng rng{17};
  for (int i = 0; i < 500; ++i) {
    const bool is_child = rng.chance(0.2);
    const Physique physique = draw_physique({.wheelchair_share = 0.2}, {is_child, 1.6, is_child ? 0.17 : 0.26}, rng);
    const Posture posture{{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)},
                          unit(Angle::radians(rng.uniform(-3.0, 3.0))),
                          rng.uniform(-0.15, 0.15),
                          &physique};
    const Point2 from{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)};  // sometimes within a part
    double least = 1e9;
    for (const BodyPart& part : physique.parts)
      if (part.bottom < 1.2) least = std::min(least, distance(posture.place(part).centre, from) - part.radius);
    const Disc nearest = nearest_part(posture, from, 1.2);
    EXPECT_NEAR(distance(nearest.centre, from) - nearest.radius, least, 1e-12);
  }
}

}  // namespace
}  // namespace docent::simulator
