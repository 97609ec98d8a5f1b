#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace docent::collision_avoidance::sweep_geometry_test {
namespace {

TEST(SweepGeometry, FindsTheBeamAlsoBeyondHalfATurn) {
  const double degree = Angle::degrees(1).radians();
  EXPECT_EQ(beam_to({1.0, 0.0}, -90.0 * degree, degree), 90);
  EXPECT_EQ(beam_to({0.0, -1.0}, -90.0 * degree, degree), 0);
  EXPECT_EQ(beam_to(unit(Angle::degrees(170)), -135.0 * degree, degree), 305) << "out of a field of 270 degrees";
  EXPECT_EQ(beam_to(unit(Angle::degrees(-90.4)), -90.0 * degree, degree), 0) << "nearest to the first";
}

TEST(SweepGeometry, TheRoughBearingIsNearlyTheBearing) {
  double most = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const double bearing = 2.0 * std::numbers::pi * (i + 0.5) / 100'000 - std::numbers::pi;
    most = std::max(most, std::abs(rough_bearing(3.0 * unit(Angle::radians(bearing))) - bearing));
  }
  EXPECT_LT(most, kRoughBearing);
  EXPECT_EQ(rough_bearing({}), 0.0);
}

TEST(SweepGeometry, FindsTheBeamOfTheExactBearing) {
  for (const auto& [first, step] : {std::pair{-90.0, 1.0}, {-135.0, 0.5}, {-180.0, 360.0 / 511.0}, {0.0, 2.7}}) {
    const double first_bearing = first * kDegree;
    const double bearing_step = step * kDegree;
    const auto expect_exact = [&](double bearing) {
      const Point2 at = 2.0 * unit(Angle::radians(bearing));
      const double turn = Angle::radians(std::atan2(at.y, at.x) - first_bearing).radians();
      const double unwrapped = turn < -0.5 * bearing_step ? turn + 2.0 * std::numbers::pi : turn;
      EXPECT_EQ(beam_to(at, first_bearing, bearing_step), std::lround(unwrapped / bearing_step)) << bearing;
    };
    for (int half = -3; half < 2 * 360; ++half)  // on the beams, half-way between them, and a hair beside
      for (const double beside : {-1e-4, -1e-5, -1e-6, 0.0, 1e-6, 1e-5, 1e-4})
        expect_exact(first_bearing + 0.5 * half * bearing_step + beside);
  }
}

TEST(SweepGeometry, NeighboursMayBeFartherApartFarAway) {
  EXPECT_NEAR(spacing_of(0.0, 5.0, 0.01), 0.15, 1e-12);
  EXPECT_NEAR(spacing_of(4.0, 5.0, 0.01), 0.25, 1e-12);
}

}  // namespace
}  // namespace docent::collision_avoidance::sweep_geometry_test
