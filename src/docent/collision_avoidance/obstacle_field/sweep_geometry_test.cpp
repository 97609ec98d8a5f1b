#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance::sweep_geometry_test {
namespace {

TEST(SweepGeometry, FindsTheBeamAlsoBeyondHalfATurn) {
  const double degree = Angle::degrees(1).radians();
  EXPECT_EQ(beam_to({1.0, 0.0}, -90.0 * degree, degree), 90);
  EXPECT_EQ(beam_to({0.0, -1.0}, -90.0 * degree, degree), 0);
  EXPECT_EQ(beam_to(unit(Angle::degrees(170)), -135.0 * degree, degree), 305) << "out of a field of 270 degrees";
  EXPECT_EQ(beam_to(unit(Angle::degrees(-90.4)), -90.0 * degree, degree), 0) << "nearest to the first";
}

TEST(SweepGeometry, NeighboursMayBeFartherApartFarAway) {
  EXPECT_NEAR(spacing_of(0.0, 5.0, 0.01), 0.15, 1e-12);
  EXPECT_NEAR(spacing_of(4.0, 5.0, 0.01), 0.25, 1e-12);
}

}  // namespace
}  // namespace docent::collision_avoidance::sweep_geometry_test
