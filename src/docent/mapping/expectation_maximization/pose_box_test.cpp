#include "docent/mapping/expectation_maximization/pose_box.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::mapping {
namespace {

constexpr PoseCells kCells{0.5, 36};

PoseBox drawn_box(std::uint64_t seed, const Pose2& at) {
  Rng rng{seed};
  PoseBox box = PoseBox::about(kCells, at, 1.5, 0.6, [&](const Pose2&) { return rng.uniform(); });
  box.normalise();
  return box;
}

double sum_of(const PoseBox& box) {
  double sum = 0.0;
  for (std::size_t i = 0; i < box.size(); ++i) sum += box.value(i);
  return sum;
}

double product_of(const PoseBox& a, const PoseBox& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a.value(i) * b.value_at(a.pose(i));
  return sum;
}

TEST(PoseBox, AMotionKeepsTheMassAndMovesTheMean) {
  const PoseBox start{kCells, {1.0, 2.0, Angle::degrees(90)}};
  const Motion motion{{2.0, 0.0, Angle::degrees(20)}, 0.3, 0.02};
  const PoseBox moved = start.moved(motion);
  EXPECT_NEAR(sum_of(moved), 1.0, 1e-4);
  const Pose2 mode = moved.mode();
  EXPECT_NEAR(mode.x, 1.0, 0.05);
  EXPECT_NEAR(mode.y, 4.0, 0.05);
  EXPECT_NEAR(mode.theta.degrees(), 110.0, 1.5);
  const PoseBox::Spread spread = moved.spread();
  EXPECT_NEAR(spread.metres, std::sqrt(2 * 0.3), 0.15);
  EXPECT_NEAR(spread.radians, std::sqrt(0.02), 0.05);
}

TEST(PoseBox, ManySmallNoisesAddUpToOneLarge) {
  PoseBox belief{kCells, {}};
  for (int i = 0; i < 12; ++i) {
    belief = belief.moved({{1.3, 0.0, Angle::degrees(3)}, 0.10, 0.01});
    belief.crop(1e-6F);
  }
  EXPECT_NEAR(belief.spread().radians, std::sqrt(12 * 0.01), 0.06);
}

/// <M a, b> = <a, M^T b>: the backward message is what the forward one needs.
TEST(PoseBox, BackwardsIsTheTransposeOfForwards) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng{seed + 100};
    const Motion motion{{rng.uniform(-2.0, 2.0), rng.uniform(-0.5, 0.5), Angle::radians(rng.uniform(-1.0, 1.0))},
                        rng.uniform(0.05, 0.5),
                        rng.uniform(0.001, 0.05)};
    const PoseBox a = drawn_box(seed, {0.0, 0.0, Angle::degrees(160)});
    const PoseBox moved = a.moved(motion);
    const PoseBox b = drawn_box(seed + 50, moved.mode());
    const double forwards = product_of(moved, b);
    const double backwards = product_of(a, b.moved_back(motion));
    ASSERT_GT(forwards, 0.0);
    EXPECT_NEAR(forwards, backwards, 2e-3 * forwards) << "seed " << seed;
  }
}

TEST(PoseBox, AnArcGrowsToTheWholeCircleAndNoFarther) {
  PoseBox belief{kCells, {}};
  for (int i = 0; i < 8; ++i) belief = belief.moved({{0.0, 0.0, {}}, 1e-4, 1.0});
  EXPECT_NEAR(sum_of(belief), 1.0, 1e-3);
  double least = 1.0;
  for (int turn = 0; turn < 36; ++turn)
    least = std::min(least, belief.value_at({0.0, 0.0, Angle::degrees(10.0 * turn)}));
  EXPECT_NEAR(least, 1.0 / 36, 0.01);
}

TEST(PoseBox, CroppingTakesTheSmallestBoxAndKeepsWhatIsInIt) {
  PoseBox box = PoseBox::about(
      kCells, {}, 3.0, 0.5, [](const Pose2& pose) { return std::exp(-4.0 * dot(pose.position(), pose.position())); });
  const std::size_t before = box.size();
  box.crop(0.1F);
  EXPECT_LT(box.size(), before / 4);
  EXPECT_NEAR(box.value_at({}), 1.0, 1e-6);
  EXPECT_EQ(box.value_at({3.0, 0.0, {}}), 0.0);
}

TEST(PoseBox, MultipliesWhereBothAre) {
  PoseBox a = PoseBox::about(kCells, {}, 1.0, 0.2, [](const Pose2&) { return 2.0; });
  const PoseBox b = PoseBox::about(kCells, {1.0, 0.0, {}}, 1.0, 0.2, [](const Pose2&) { return 3.0; });
  a.multiply(b);
  EXPECT_EQ(a.value_at({0.5, 0.0, {}}), 6.0);
  EXPECT_EQ(a.value_at({-0.5, 0.0, {}}), 0.0);
}

}  // namespace
}  // namespace docent::mapping
