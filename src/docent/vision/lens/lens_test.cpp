#include "docent/vision/lens/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "docent/base/random.h"

namespace docent::vision::lens_test {
namespace {

LensParams webcam() {
  return {.kind = LensParams::Kind::pinhole,
          .focal_x = 520.0,
          .focal_y = 517.0,
          .centre_x = 325.3,
          .centre_y = 236.9,
          .bend = {0.08, -0.21, 0.0012, -0.0007, 0.11},
          .half_field = 0.8};
}

LensParams fisheye() {
  return {.kind = LensParams::Kind::fisheye,
          .focal_x = 188.2,
          .focal_y = 187.7,
          .centre_x = 316.0,
          .centre_y = 221.9,
          .bend = {0.0087, -0.002, 0.0004, -0.00003, 0.0},
          .half_field = 1.9};
}

class EveryLens : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] LensParams params() const { return GetParam() ? fisheye() : webcam(); }
};

Eigen::Vector3d any_ray(Rng& rng, double half_field) {
  const double angle = half_field * std::sqrt(rng.uniform()), round = rng.uniform(0.0, 2.0 * std::numbers::pi);
  return {std::sin(angle) * std::cos(round), std::sin(angle) * std::sin(round), std::cos(angle)};
}

TEST_P(EveryLens, RayToPixelAndBackIsTheRay) {
  const Lens lens = Lens::make(params()).value();
  Rng rng{3};
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d ray = any_ray(rng, lens.half_field() * 0.999);
    const auto pixel = lens.pixel_of(rng.uniform(0.1, 20.0) * ray);
    ASSERT_TRUE(pixel) << i;
    const auto back = lens.ray_of(*pixel);
    ASSERT_TRUE(back) << i;
    EXPECT_LT((*back - ray).norm(), 1e-9) << i;
    const auto again = lens.pixel_of(*back);
    ASSERT_TRUE(again) << i;
    EXPECT_LT((*again - *pixel).norm(), 1e-9 * 500.0) << i;
  }
}

TEST_P(EveryLens, JacobiansAreThoseOfFiniteDifferences) {
  constexpr double kStep = 1e-6;
  const Lens lens = Lens::make(params()).value();
  Rng rng{5};
  for (int i = 0; i < 300; ++i) {
    // The first ray is the axis, where quotients are of nothing and nothing.
    const Eigen::Vector3d ray = i == 0
                                    ? Eigen::Vector3d{0.0, 0.0, 1.0}
                                    : Eigen::Vector3d{any_ray(rng, lens.half_field() * 0.98) * rng.uniform(0.5, 3.0)};
    PixelByRay by_ray;
    const auto pixel = lens.pixel_of(ray, &by_ray);
    ASSERT_TRUE(pixel);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector2d slope = (*lens.pixel_of(ray + step) - *lens.pixel_of(ray - step)) / (2.0 * kStep);
      EXPECT_LT((slope - by_ray.col(axis)).norm(), 1e-4 * (1.0 + slope.norm())) << "ray " << i << " axis " << axis;
    }
    RayByPixel by_pixel;
    const auto back = lens.ray_of(*pixel, &by_pixel);
    ASSERT_TRUE(back);
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = 1e-3 * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector3d slope = (*lens.ray_of(*pixel + step) - *lens.ray_of(*pixel - step)) / 2e-3;
      EXPECT_LT((slope - by_pixel.col(axis)).norm(), 1e-5 * (1.0 + slope.norm())) << "pixel " << i << " axis " << axis;
    }
  }
}

TEST_P(EveryLens, RefusesWhatItCannotSee) {
  const Lens lens = Lens::make(params()).value();
  EXPECT_FALSE(lens.pixel_of({0.0, 0.0, -1.0}));
  EXPECT_FALSE(lens.pixel_of({0.1, 0.0, -3.0}));
  EXPECT_FALSE(lens.pixel_of({0.0, 0.0, 0.0}));
  EXPECT_FALSE(lens.pixel_of({std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0}));
  const double outside = lens.half_field() + 0.01;
  EXPECT_FALSE(lens.pixel_of({std::sin(outside), 0.0, std::cos(outside)}));
  EXPECT_FALSE(lens.ray_of({1e7, 0.0}));
  EXPECT_FALSE(lens.ray_of({std::numeric_limits<double>::infinity(), 0.0}));
}

TEST_P(EveryLens, OpticalAxisFallsOnTheCentre) {
  const Lens lens = Lens::make(params()).value();
  const auto pixel = lens.pixel_of({0.0, 0.0, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_DOUBLE_EQ(pixel->x(), params().centre_x);
  EXPECT_DOUBLE_EQ(pixel->y(), params().centre_y);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryLens, ::testing::Values(false, true),
                         [](const auto& tested) { return tested.param ? "fisheye" : "pinhole"; });

TEST(Lens, AgreesWithFormulaeOfOpenCvByHand) {
  // cv::projectPoints of (0.3, -0.2, 1) with k1 = 0.1, k2 = 0.01, p1 = 0.001, p2 = 0.002, k3 = 0: r2 = 0.13
  LensParams params{
      .focal_x = 100.0, .focal_y = 200.0, .centre_x = 10.0, .centre_y = 20.0, .bend = {0.1, 0.01, 0.001, 0.002, 0.0}};
  const double scale = 1.0 + 0.1 * 0.13 + 0.01 * 0.0169;
  const auto pixel = Lens::make(params).value().pixel_of({0.3, -0.2, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 10.0 + 100.0 * (0.3 * scale + 2.0 * 0.001 * 0.3 * -0.2 + 0.002 * (0.13 + 0.18)), 1e-12);
  EXPECT_NEAR(pixel->y(), 20.0 + 200.0 * (-0.2 * scale + 0.001 * (0.13 + 0.08) + 2.0 * 0.002 * 0.3 * -0.2), 1e-12);
  // cv::fisheye::projectPoints of a ray at 90 degrees, k1 = 0.1
  params.kind = LensParams::Kind::fisheye;
  params.bend = {0.1, 0.0, 0.0, 0.0, 0.0};
  params.half_field = 2.0;
  const double quarter = 0.5 * std::numbers::pi;
  EXPECT_NEAR(Lens::make(params).value().pixel_of({0.0, 4.0, 0.0})->y(),
              20.0 + 200.0 * quarter * (1.0 + 0.1 * quarter * quarter), 1e-9);
}

TEST(Lens, EndsWhereItsDistortionFolds) {
  LensParams params = webcam();
  params.bend = {-0.5, 0.0, 0.0, 0.0, 0.0};  // r (1 - r^2 / 2) grows up to r = 0.816
  params.half_field = 1.2;
  const Lens lens = Lens::make(params).value();
  EXPECT_NEAR(std::tan(lens.half_field()), std::sqrt(2.0 / 3.0), 2e-3);
  EXPECT_FALSE(lens.pixel_of({0.9, 0.0, 1.0}));
  EXPECT_FALSE(
      lens.ray_of({params.centre_x + 0.6 * params.focal_x, params.centre_y}));  // farther out than any ray falls
  EXPECT_TRUE(lens.ray_of({params.centre_x + 0.5 * params.focal_x, params.centre_y}));
}

TEST(Lens, NamesWhatIsOutOfBounds) {
  LensParams params = webcam();
  params.half_field = 1.6;
  ASSERT_FALSE(Lens::make(params));
  EXPECT_NE(Lens::make(params).error().message.find("half_field"), std::string::npos);
  params = webcam();
  params.focal_x = 0.0;
  EXPECT_NE(Lens::make(params).error().message.find("focal_x"), std::string::npos);
  params = webcam();
  params.rows = 0;
  EXPECT_FALSE(Lens::make(params));
  params = webcam();
  params.bend[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Lens::make(params));
}

}  // namespace
}  // namespace docent::vision::lens_test
