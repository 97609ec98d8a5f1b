#include "docent/simulator/sensing/scanner_kind.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::simulator::scanner_kind_test {
namespace {

TEST(ScannerKind, TheOrdinaryOneIsTheScannerThatAlwaysWas) {
  const LaserParams always;
  const LaserParams made = laser_of({});
  EXPECT_EQ(made.beams, always.beams);
  EXPECT_EQ(made.bearing_step, always.bearing_step);
  EXPECT_EQ(made.max_range, always.max_range);
  EXPECT_EQ(made.noise_far, always.noise_far);
}

TEST(ScannerKind, BeamsAreSpreadOverTheFieldAndNoiseStaysWithinReason) {
  const LaserParams made = laser_of({.field = 2.0 * std::numbers::pi, .beams = 2880, .max_range = 80.0});
  EXPECT_EQ(made.beams, 2880);
  EXPECT_NEAR(made.beams * made.bearing_step, 2.0 * std::numbers::pi, 1e-12);
  EXPECT_EQ(made.max_range, 80.0);
  EXPECT_EQ(made.noise_far, 0.05);
  const LaserParams near = laser_of({.max_range = 4.0});
  EXPECT_NEAR(near.noise_far, 0.021, 1e-9) << "noise at 4 m is that of a scanner of 10 m at 4 m";
}

/// Where the reading `nearest` of a written sweep lies when one mounts the scanner back as it hangs.
double bearing_of_nearest(const ScannerKind& kind, const WrittenSweep& written) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < written.ranges.size(); ++i)
    if (written.ranges[i] < written.ranges[nearest]) nearest = i;
  const double bearing = written.angle_min + static_cast<double>(nearest) * written.angle_increment;
  return kind.is_upside_down ? -bearing : bearing;
}

TEST(ScannerKind, HoweverItIsWrittenTheNearestThingIsWhereItIs) {
  for (const bool is_clockwise : {false, true}) {
    for (const bool is_upside_down : {false, true}) {
      const ScannerKind kind{.beams = 90, .is_clockwise = is_clockwise, .is_upside_down = is_upside_down};
      const LaserParams params = laser_of(kind);
      std::vector<float> ranges(90, 5.0F);
      ranges[20] = 1.0F;
      const WrittenSweep written = as_written(kind, params, ranges);
      EXPECT_EQ(written.angle_increment < 0.0, is_clockwise);
      EXPECT_NEAR(bearing_of_nearest(kind, written), params.first_bearing + 20 * params.bearing_step, 1e-9);
    }
  }
}

TEST(ScannerKind, NothingIsWrittenAsTheDriverDoes) {
  const std::vector<float> ranges{1.0F, 10.0F};
  LaserParams params;
  params.beams = 2;
  EXPECT_EQ(as_written({.no_return = NoReturn::greatest}, params, ranges).ranges[1], 10.0F);
  EXPECT_EQ(as_written({.no_return = NoReturn::zero}, params, ranges).ranges[1], 0.0F);
  const auto written = as_written({.no_return = NoReturn::infinity}, params, ranges);
  EXPECT_TRUE(std::isinf(written.ranges[1]));
  EXPECT_EQ(written.ranges[0], 1.0F);
}

TEST(ScannerKind, SweepsComeAtTheirRate) {
  for (const double rate : {5.0, 5.5, 10.0, 25.0, 40.0}) {
    int sweeps = 0;
    for (std::size_t step = 0; step < 10000; ++step) sweeps += is_due(step, rate) ? 1 : 0;
    EXPECT_NEAR(sweeps, 100.0 * rate, 1.0) << rate;
  }
  for (std::size_t step = 0; step < 100; ++step) EXPECT_EQ(is_due(step, 10.0), step % 10 == 0) << step;
}

}  // namespace
}  // namespace docent::simulator::scanner_kind_test
