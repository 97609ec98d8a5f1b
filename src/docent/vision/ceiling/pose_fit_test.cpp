#include "docent/vision/ceiling/pose_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"
#include "docent/vision/ceiling/ceiling_tracker.h"
#include "docent/vision/ceiling/testing.h"

namespace docent::vision::pose_fit_test {
namespace {

using ceiling_testing::camera;
using ceiling_testing::Hall;
using ceiling_testing::near_to;

/// The hall as it is, without pictures.
CeilingMosaic mosaic_of_hall(const Hall& hall) {
  CeilingMosaic mosaic{{500, 400, 0.02, {0.0, 0.0}}, {hall.low, hall.high}, {}, {}};
  mosaic.part.resize(mosaic.frame.size());
  mosaic.brightness.resize(mosaic.frame.size());
  for (int row = 0; row < mosaic.frame.rows; ++row)
    for (int column = 0; column < mosaic.frame.columns; ++column) {
      const Point2 at = mosaic.frame.centre({column, row});
      mosaic.part[mosaic.frame.index({column, row})] = hall.is_high(at) ? 1 : 0;
      mosaic.brightness[mosaic.frame.index({column, row})] = static_cast<float>(hall.brightness(at));
    }
  return mosaic;
}

TEST(PoseFit, FindsThePoseWhateverTheLight) {
  const Hall hall{.seed = 4};
  const CeilingCamera eye = camera();
  const MosaicPyramid levels = pyramid_of(mosaic_of_hall(hall), {0.2, 0.08, 0.03});
  CeilingSampler sampler{eye};
  Rng rng{9};
  for (int i = 0; i < 12; ++i) {
    const Pose2 truth{rng.uniform(3.0, 7.0), rng.uniform(2.5, 5.5), Angle::radians(rng.uniform(-3.1, 3.1))};
    const double gain = rng.uniform(0.6, 1.3), offset = rng.uniform(-0.05, 0.1);
    const auto picture = hall.picture(eye, truth, {.gain = gain, .offset = offset, .noise = 0.01}, rng);
    const Pose2 start =
        truth * Pose2{rng.uniform(-0.12, 0.12), rng.uniform(-0.12, 0.12), Angle::degrees(rng.uniform(-3.0, 3.0))};
    const auto fit = fit_pose(start, levels, eye.mount, sampler.take(picture.view()));
    ASSERT_TRUE(fit) << i;
    EXPECT_TRUE(near_to(fit->map_from_robot, truth, 0.01, 0.3))
        << i << ": " << distance(fit->map_from_robot.position(), truth.position());
    EXPECT_NEAR(fit->gain, gain, 0.15 * gain) << i;
    EXPECT_GT(fit->correlation, 0.9) << i;
  }
}

TEST(PoseFit, SaysNothingOfAPlainCeiling) {
  Hall hall{.seed = 4};
  hall.is_plain = true;
  const CeilingCamera eye = camera();
  const MosaicPyramid levels = pyramid_of(mosaic_of_hall(hall), {0.1, 0.03});
  CeilingSampler sampler{eye};
  Rng rng{2};
  const auto picture = hall.picture(eye, {5.0, 4.0, {}}, {.noise = 0.01}, rng);
  EXPECT_FALSE(fit_pose({5.0, 4.0, {}}, levels, eye.mount, sampler.take(picture.view())));
}

TEST(PoseFit, SaysNothingBesideTheMosaic) {
  const Hall hall{.seed = 4};
  const CeilingCamera eye = camera();
  const MosaicPyramid levels = pyramid_of(mosaic_of_hall(hall), {0.1, 0.03});
  CeilingSampler sampler{eye};
  Rng rng{2};
  const auto picture = hall.picture(eye, {5.0, 4.0, {}}, {}, rng);
  EXPECT_FALSE(fit_pose({-40.0, 4.0, {}}, levels, eye.mount, sampler.take(picture.view())));
  EXPECT_EQ(agreement_at({-40.0, 4.0, {}}, levels.front(), eye.mount, sampler.take(picture.view())).samples, 0);
}

TEST(CeilingTracker, FollowsWithoutOdometry) {
  const Hall hall{.seed = 5};
  const CeilingCamera eye = camera();
  CeilingSampler sampler{eye};
  Pose2 truth{3.0, 3.0, {}};
  CeilingTracker tracker{pyramid_of(mosaic_of_hall(hall), {0.2, 0.05}), eye.mount, truth};
  Rng rng{3};
  for (int i = 0; i < 40; ++i) {
    truth = truth * Pose2{0.07, 0.0, Angle::degrees(2.5)};
    const auto picture = hall.picture(eye, truth, {.gain = 1.0 - 0.01 * i, .noise = 0.01}, rng);
    ASSERT_TRUE(tracker.track(sampler.take(picture.view()))) << i;
    EXPECT_TRUE(near_to(tracker.map_from_robot(), truth, 0.02, 0.5)) << i;
  }
}

TEST(PoseFit, NamesWhatIsOutOfBounds) {
  EXPECT_TRUE(PoseFitParams{}.validate());
  EXPECT_FALSE(PoseFitParams{.most_steps = 0}.validate());
  EXPECT_FALSE(PoseFitParams{.coarse_stride = 0}.validate());
  EXPECT_FALSE(PoseFitParams{.outlier = 0.0}.validate());
  EXPECT_FALSE(PoseFitParams{.least_share = 2.0}.validate());
}

}  // namespace
}  // namespace docent::vision::pose_fit_test
