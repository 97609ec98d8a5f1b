#include "docent/collision_avoidance/body/unseen_bodies.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance {
namespace {

TEST(UnseenBodies, ReachFartherToTheSidesOfWhoWalks) {
  const UnseenBodies bodies{{.ahead = 0.12, .aside = 0.22}, 0.38};
  EXPECT_NEAR(bodies.reach({1.0, 0.0}, {-1.0, 0.0}).likely, 0.12, 1e-12) << "comes";
  EXPECT_NEAR(bodies.reach({1.0, 0.0}, {0.7, 0.0}).likely, 0.12, 1e-12) << "goes";
  EXPECT_NEAR(bodies.reach({0.0, 1.0}, {1.0, 0.0}).likely, 0.22, 1e-12) << "passes";
  const double slanted = bodies.reach({1.0, 1.0}, {1.0, 0.0}).likely;
  EXPECT_GT(slanted, 0.12);
  EXPECT_LT(slanted, 0.22);
}

TEST(UnseenBodies, WhoStandsMayFaceAnyWay) {
  const UnseenBodies bodies{{.ahead = 0.12, .aside = 0.22}, 0.38};
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const auto reach = bodies.reach(0.8 * unit(Angle::degrees(degrees)), {});
    EXPECT_EQ(reach.likely, 0.12);
    EXPECT_EQ(reach.most, 0.22);
  }
}

TEST(UnseenBodies, ALaserAtTheWaistSeesThemWhole) {
  const UnseenBodies bodies{{.waist = 0.7}, 0.9};
  EXPECT_EQ(bodies.reach({1.0, 0.0}, {0.0, 1.0}).likely, 0.0);
  EXPECT_EQ(bodies.reach({1.0, 0.0}, {}).most, 0.0);
  EXPECT_GT((UnseenBodies{{.waist = 0.7}, 0.69}.reach({1.0, 0.0}, {}).most), 0.0);
}

TEST(UnseenBodies, NamesWhatCannotBe) {
  EXPECT_TRUE(UnseenBodyParams{}.validate());
  EXPECT_EQ(UnseenBodyParams{.ahead = -0.1}.validate().error().message,
            "avoid.body.ahead must lie between 0 and 0.5 m");
  EXPECT_FALSE(UnseenBodyParams{.aside = 0.6}.validate());
  EXPECT_FALSE(UnseenBodyParams{.waist = 3.0}.validate());
}

}  // namespace
}  // namespace docent::collision_avoidance
