#include "docent/collision_avoidance/obstacle_field/felt_things.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::collision_avoidance::felt_things_test {
namespace {

constexpr double kBody = 0.265;  // [m]
Time at(double s) { return time_from_seconds(s); }

TEST(FeltThings, HoldTheRoundThingThatWasTouchedWhereverItWasMet) {
  Rng rng{7};
  for (int i = 0; i < 200; ++i) {
    const double radius = rng.uniform(0.03, FeltThingsParams{}.radius);
    const Point2 thing{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
    const Point2 outward = unit(Angle::radians(rng.uniform(-3.1, 3.1)));
    const Point2 robot = thing - (kBody + radius) * outward;
    FeltThings felt;
    felt.feel(robot + kBody * outward, outward, false, at(1.0));
    ASSERT_EQ(felt.discs().size(), 1U);
    const auto& disc = felt.discs().front();
    EXPECT_LE(distance(disc.middle(), thing) + radius, disc.radius + 1e-9);
  }
}

TEST(FeltThings, ATouchThatLastsIsOneThing) {
  FeltThings felt;
  for (double s = 1.0; s < 5.0; s += 0.1) felt.feel({1.0, 0.01 * s}, {1.0, 0.0}, false, at(s));
  EXPECT_EQ(felt.discs().size(), 1U);
  felt.feel({1.0, 2.0}, {1.0, 0.0}, false, at(6.0));
  EXPECT_EQ(felt.discs().size(), 2U);
}

TEST(FeltThings, ShrinkToWhatTheBodyHasNotStoodIn) {
  FeltThings felt;
  felt.feel({1.0, 0.0}, {1.0, 0.0}, false, at(1.0));
  felt.stand({1.0 - kBody, 0.0}, kBody - 0.03);
  EXPECT_NEAR(felt.discs().front().radius, 0.3, 1e-9) << "from where it was touched";
  const Point2 beside{1.3, 0.45};
  felt.stand(beside, kBody);
  const auto& disc = felt.discs().front();
  EXPECT_LT(disc.radius, 0.3);
  EXPECT_NEAR(distance(disc.middle(), beside), kBody + disc.radius, 1e-9) << "just beside the body";
  EXPECT_EQ(disc.at.x, 1.0) << "what was touched is still there";
  felt.stand({5.0, 5.0}, kBody);
  EXPECT_EQ(felt.discs().size(), 1U);
  felt.stand({1.1, 0.0}, kBody);
  EXPECT_TRUE(felt.discs().empty()) << "the body stands where it was";
}

TEST(FeltThings, AreTriedAgainAfterLong) {
  FeltThings felt;
  felt.feel({1.0, 0.0}, {1.0, 0.0}, false, at(0.0));
  felt.feel({9.0, 0.0}, {1.0, 0.0}, true, at(0.0));
  felt.forget(at(200.0));
  EXPECT_EQ(felt.discs().size(), 2U);
  felt.forget(at(400.0));
  EXPECT_EQ(felt.discs().size(), 1U) << "who may have been somebody";
  felt.forget(at(1900.0));
  EXPECT_TRUE(felt.discs().empty());
}

TEST(FeltThings, AreCarriedToAnotherFrame) {
  FeltThings felt;
  felt.feel({1.0, 0.0}, {1.0, 0.0}, false, at(0.0));
  felt.carry({2.0, 3.0, Angle::degrees(90)});
  const auto& disc = felt.discs().front();
  EXPECT_NEAR(disc.middle().x, 2.0, 1e-9);
  EXPECT_NEAR(disc.middle().y, 4.3, 1e-9);
}

TEST(FeltThings, AreNotWithoutNumber) {
  FeltThingsParams params;
  params.most = 3;
  FeltThings felt{params};
  for (int i = 0; i < 10; ++i) felt.feel({2.0 * i, 0.0}, {1.0, 0.0}, false, at(i));
  ASSERT_EQ(felt.discs().size(), 3U);
  EXPECT_EQ(felt.discs().front().at.x, 14.0) << "the oldest go";
}

}  // namespace
}  // namespace docent::collision_avoidance::felt_things_test
