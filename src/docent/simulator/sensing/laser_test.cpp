#include "docent/simulator/sensing/laser.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::simulator {
namespace {

World room(double half) {
  World world;
  world.solids.push_back(
      {"room", SolidKind::wall, {{-half, -half}, {half, -half}, {half, half}, {-half, half}}, 0.0, 3.0, false});
  return world;
}

/// Range to the walls of a square room from its centre.
double expected_range(double bearing, double half) {
  return half / std::max(std::abs(std::cos(bearing)), std::abs(std::sin(bearing)));
}

TEST(Laser, ErrorsAreSmallUnbiasedAndQuantised) {
  const RayCaster walls{surfaces_at(room(4.0), 0.38)};
  LaserParams params;
  params.mount_heading = params.mount_offset = 0.0;
  LaserScanner scanner{params, Pose2{}, Rng{3}};
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  int outliers = 0;
  for (int scan = 0; scan < 200; ++scan) {
    const auto& sweep = scanner.sweep(walls, {}, Pose2{});
    ASSERT_EQ(sweep.ranges.size(), 180U);
    for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
      const double range = static_cast<double>(sweep.ranges[i]);
      EXPECT_NEAR(std::round(range * 100.0), range * 100.0, 1e-3);
      const double error =
          range - expected_range(params.first_bearing + static_cast<double>(i) * params.bearing_step, 4.0);
      if (std::abs(error) > 0.15) {
        ++outliers;
        continue;
      }
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 0.001);
  const double deviation = std::sqrt(squares / count);
  EXPECT_GT(deviation, 0.015);
  EXPECT_LT(deviation, 0.030);
  const double share = static_cast<double>(outliers) / (outliers + count);
  EXPECT_GT(share, 0.001);
  EXPECT_LT(share, 0.005);
}

TEST(Laser, MeetsPeopleAllRoundAndSaysWhom) {
  const RayCaster walls{surfaces_at(room(8.0), 0.38)};
  LaserParams params;
  params.mount_heading = params.mount_offset = params.lost = params.stray = params.mixed = 0.0;
  LaserScanner front{params, Pose2{}, Rng{3}};
  LaserScanner rear{params, Pose2{0.0, 0.0, Angle::degrees(180.0)}, Rng{4}};
  for (int degree = -180; degree < 180; degree += 7) {
    const Pose2 pose{0.5, -0.5, Angle::degrees(33.0)};
    const std::vector<Disc> people{{pose * (2.0 * unit(Angle::degrees(degree))), 0.25}};
    int met = 0;
    for (LaserScanner* scanner : {&front, &rear}) {
      const auto& sweep = scanner->sweep(walls, people, pose);
      for (std::size_t i = 0; i < sweep.discs.size(); ++i) {
        if (sweep.discs[i] < 0) continue;
        ++met;
        EXPECT_GT(sweep.ranges[i], 1.6F);
        EXPECT_LT(sweep.ranges[i], 2.1F);
      }
    }
    // 2 asin(0.25 / 2) is 14.4 degrees.
    EXPECT_GE(met, 13) << degree;
    EXPECT_LE(met, 15) << degree;
  }
}

TEST(Laser, NothingWithinRangeReadsAsMaximum) {
  const RayCaster walls{surfaces_at(room(30.0), 0.38)};
  LaserParams params;
  params.stray = 0.0;
  LaserScanner scanner{params, Pose2{}, Rng{3}};
  for (const float range : scanner.sweep(walls, {}, Pose2{}).ranges) EXPECT_EQ(range, 10.0F);
}

}  // namespace
}  // namespace docent::simulator
