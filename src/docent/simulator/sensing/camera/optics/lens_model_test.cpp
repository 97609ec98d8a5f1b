#include "docent/simulator/sensing/camera/optics/lens_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"
#include "docent/simulator/sensing/camera/optics/ray_table.h"

namespace docent::simulator {
namespace {

LensModel barrel() {
  LensModel lens = plain_lens(640, 480, 1.2);
  lens.centre_x = 331.5, lens.centre_y = 236.2;
  lens.brown = {-0.28, 0.09, 0.0012, -0.0007, -0.01};
  return lens;
}

LensModel wide_fisheye() {
  LensModel lens;
  lens.kind = LensKind::fisheye;
  lens.width = 640, lens.height = 480;
  lens.focal_x = 205.0, lens.focal_y = 204.0;
  lens.centre_x = 318.0, lens.centre_y = 243.0;
  lens.fisheye = {-0.02, 0.004, -0.0015, 0.0001};
  lens.widest = 1.65;
  return lens;
}

TEST(LensModel, PutsKnownDirectionsWhereTheFormulaSays) {
  const auto straight = plain_lens(320, 240, 2.0 * std::atan(0.5)).pixel({0.25F, 0.0F, 1.0F});
  ASSERT_TRUE(straight);
  EXPECT_NEAR(straight->x, 240.0, 1e-4) << "half way to the edge";
  EXPECT_NEAR(straight->y, 120.0, 1e-6);
  LensModel lens = plain_lens(640, 480, 1.2);
  lens.focal_x = lens.focal_y = 400.0;
  lens.brown = {-0.2, 0.05, 0.001, 0.002, 0.0};
  // By hand, x = 0.3, y = -0.2: r2 = 0.13, radial = 1 - 0.026 + 0.000845.
  const double radial = 0.974845;
  const auto at = lens.pixel({0.3F, -0.2F, 1.0F});
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x, 320.0 + 400.0 * (0.3 * radial + 2.0 * 0.001 * -0.06 + 0.002 * (0.13 + 0.18)), 1e-3);
  EXPECT_NEAR(at->y, 240.0 + 400.0 * (-0.2 * radial + 0.001 * (0.13 + 0.08) + 2.0 * 0.002 * -0.06), 1e-3);
  const auto aside = wide_fisheye().pixel({1.0F, 0.0F, 0.0F});  // at a right angle
  ASSERT_TRUE(aside);
  const double t = std::numbers::pi / 2.0, t2 = t * t;
  EXPECT_NEAR(
      aside->x,
      318.0 + 205.0 * t * (1.0 - 0.02 * t2 + 0.004 * t2 * t2 - 0.0015 * std::pow(t2, 3) + 0.0001 * std::pow(t2, 4)),
      1e-3);
}

TEST(LensModel, RaysComeFromWhereTheirPixelIs) {
  for (const LensModel& lens : {plain_lens(320, 240, 1.2), barrel(), wide_fisheye()}) {
    Rng rng{3};
    int seen = 0;
    for (int i = 0; i < 2000; ++i) {
      const double u = rng.uniform(0.0, lens.width), v = rng.uniform(0.0, lens.height);
      const Vec3 ray = lens.ray(u, v);
      if (dot(ray, ray) == 0.0F) continue;
      ++seen;
      EXPECT_NEAR(dot(ray, ray), 1.0F, 1e-5F);
      const auto back = lens.pixel(ray);
      ASSERT_TRUE(back) << u << " " << v;
      EXPECT_NEAR(back->x, u, 2e-3);
      EXPECT_NEAR(back->y, v, 2e-3);
    }
    EXPECT_GT(seen, 1700);
  }
}

TEST(LensModel, SeesNothingBeyondItsRim) {
  LensModel lens = wide_fisheye();
  EXPECT_FALSE(lens.pixel({0.0F, 0.0F, -1.0F}));
  EXPECT_FALSE(barrel().pixel({0.0F, 0.0F, -1.0F}));
  lens.widest = 0.5;
  const Vec3 corner = lens.ray(2.0, 2.0);
  EXPECT_EQ(dot(corner, corner), 0.0F);
  EXPECT_FALSE(lens.pixel({1.0F, 0.0F, 1.0F}));
}

TEST(RayTable, GivesTheRayOfAnyPlaceInAPixel) {
  for (const LensModel& lens : {plain_lens(64, 48, 1.2), barrel(), wide_fisheye()}) {
    const RayTable table{lens};
    Rng rng{5};
    for (int i = 0; i < 500; ++i) {
      const int x = static_cast<int>(rng.integer(0, lens.width - 1)),
                y = static_cast<int>(rng.integer(0, lens.height - 1));
      const float u = static_cast<float>(rng.uniform()), v = static_cast<float>(rng.uniform());
      const Vec3 ray = normalized(table.through(x, y, u, v));
      const Vec3 exact = lens.ray(x + static_cast<double>(u), y + static_cast<double>(v));
      if (!table.sees(x, y)) continue;
      EXPECT_GT(dot(ray, exact), 1.0F - 1e-6F) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace docent::simulator
