#include "docent/simulator/physique/slice.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace docent::simulator
