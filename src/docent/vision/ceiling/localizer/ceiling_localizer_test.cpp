#include "docent/vision/ceiling/localizer/ceiling_localizer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/vision/ceiling/testing.h"

namespace docent::vision::ceiling_localizer_test {
namespace {

using ceiling_testing::camera;
using ceiling_testing::Hall;
using ceiling_testing::Light;

CeilingMosaic mosaic_of(const Hall& hall) {
  CeilingMosaic mosaic{{500, 400, 0.02, {0.0, 0.0}}, {hall.low, hall.high}, {}, {}};
  for (int row = 0; row < mosaic.frame.rows; ++row)
    for (int column = 0; column < mosaic.frame.columns; ++column) {
      const Point2 at = mosaic.frame.centre({column, row});
      mosaic.part.push_back(hall.is_high(at) ? 1 : 0);
      mosaic.brightness.push_back(static_cast<float>(hall.brightness(at)));
    }
  return mosaic;
}

/// What a drive round the hall's middle says.
struct Drive {
  int sure = 0, sure_and_wrong = 0, pictures = 0;
  double worst = 0.0;        ///< [m] of sure ones
  double worst_turn = 0.0;   ///< [deg]
  double first_sure = -1.0;  ///< [m] of way
};

Drive drive(CeilingLocalizer& localizer, const Hall& hall, std::uint64_t seed, const Light& light, int pictures = 30) {
  const CeilingCamera eye = camera();
  Rng rng{seed};
  Drive seen;
  Pose2 odom{1.0, 2.0, Angle::degrees(50.0)};
  const double begin = rng.uniform(0.0, 6.28);
  constexpr double kStep = 0.12;  // [m]
  const double radius = rng.uniform(1.2, 2.2);
  const auto pose_at = [&](int i) {
    const double a = begin + kStep * i / radius;
    return Pose2{5.0 + radius * std::cos(a), 4.0 + 0.8 * radius * std::sin(a), Angle::radians(a + 0.5 * 3.14159)};
  };
  for (int i = 0; i < pictures; ++i) {
    const Pose2 truth = pose_at(i);
    if (i > 0) {
      Pose2 step = inverse(pose_at(i - 1)) * truth;
      step.x *= 1.02;
      step.theta = step.theta + Angle::radians(0.004 * rng.normal());
      odom = odom * step;
    }
    Light now = light;
    now.lean = 0.004 * rng.normal();
    const auto picture = hall.picture(eye, truth, now, rng);
    const auto fix = localizer.see(picture.view(), odom);
    ++seen.pictures;
    if (!fix || fix->p_wrong > 0.01) continue;
    ++seen.sure;
    const double off = distance(fix->map_from_robot.position(), truth.position());
    if (seen.first_sure < 0.0) seen.first_sure = kStep * i;
    if (off > 0.5) ++seen.sure_and_wrong;
    if (off < 0.5) seen.worst = std::max(seen.worst, off);
    seen.worst_turn = std::max(seen.worst_turn, std::abs((fix->map_from_robot.theta - truth.theta).degrees()));
  }
  return seen;
}

TEST(CeilingLocalizer, FindsTheRobotFromAnywhere) {
  int found = 0, wrong = 0;
  double worst = 0.0, farthest = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Hall hall{.seed = seed};
    CeilingLocalizer localizer{mosaic_of(hall), camera()};
    const Drive seen = drive(localizer, hall, seed, {.gain = 0.9, .offset = 0.02, .noise = 0.02});
    found += seen.sure > seen.pictures / 2 ? 1 : 0;
    wrong += seen.sure_and_wrong;
    worst = std::max(worst, seen.worst);
    farthest = std::max(farthest, seen.first_sure);
  }
  EXPECT_EQ(found, 4);
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(worst, 0.1);
  EXPECT_LT(farthest, 3.0);
}

TEST(CeilingLocalizer, IsNeverSureUnderACeilingThatRepeatsItself) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Hall hall{.seed = seed, .period = 2.0};
    hall.size = {0.0, 0.0};
    CeilingLocalizer localizer{mosaic_of(hall), camera()};
    const Drive seen = drive(localizer, hall, seed, {.noise = 0.02});
    EXPECT_EQ(seen.sure_and_wrong, 0) << seed;
  }
}

TEST(CeilingLocalizer, IsNotSureOfWhatItDoesNotKnow) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Hall hall{.seed = seed};
    CeilingLocalizer dark{mosaic_of(hall), camera()};
    CeilingLocalizer elsewhere{mosaic_of({.seed = seed + 100}), camera()};
    EXPECT_EQ(drive(elsewhere, hall, seed, {.noise = 0.02}).sure, 0) << seed;
    hall.lamps_are_lit = false;
    EXPECT_EQ(drive(dark, hall, seed, {.gain = 0.5, .noise = 0.02}).sure_and_wrong, 0) << seed;
    hall.is_plain = true;
    CeilingLocalizer plain{mosaic_of(hall), camera()};
    EXPECT_EQ(drive(plain, hall, seed, {.noise = 0.02}).sure, 0) << seed;
  }
}

TEST(CeilingLocalizer, NoticesThatItWasCarriedOff) {
  const Hall hall{.seed = 5};
  CeilingLocalizer localizer{mosaic_of(hall), camera()};
  EXPECT_GT(drive(localizer, hall, 3, {.noise = 0.02}).sure, 10);
  const Drive after = drive(localizer, hall, 9, {.noise = 0.02});  // elsewhere, by odometry that jumps
  EXPECT_GT(after.sure, 10);
  EXPECT_LE(after.sure_and_wrong, 2) << "in the first moment";
}

}  // namespace
}  // namespace docent::vision::ceiling_localizer_test
