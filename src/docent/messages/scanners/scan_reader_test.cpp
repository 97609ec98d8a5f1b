#include "docent/messages/scanners/scan_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace docent {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// Where a reading's end lies, seen from the scanner.
Point2 end_of(const DriverScan& scan, std::size_t beam) {
  return static_cast<double>(scan.ranges[beam]) *
         unit(Angle::radians(scan.first_bearing + static_cast<double>(beam) * scan.bearing_step));
}

TEST(ScanReader, TheSameWorldIsReadHoweverItIsWritten) {
  // 1 m ahead, 2 m to the left, 3 m to the right, as four scanners write it.
  const std::vector<float> from_right{3.0F, 1.0F, 2.0F}, from_left{2.0F, 1.0F, 3.0F};
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  struct Case {
    bool is_upside_down;
    DriverScan written;
  };
  for (const Case& one : {Case{false, {from_right, -kQuarter, kQuarter, 0.1, 10.0}},
                          Case{false, {from_left, kQuarter, -kQuarter, 0.1, 10.0}},
                          Case{true, {from_left, -kQuarter, kQuarter, 0.1, 10.0}},
                          Case{true, {from_right, kQuarter, -kQuarter, 0.1, 10.0}}}) {
    ScanReader reader{{.is_upside_down = one.is_upside_down}};
    const DriverScan& scan = reader.read(one.written);
    EXPECT_GT(scan.bearing_step, 0.0);
    ASSERT_EQ(scan.ranges.size(), 3U);
    EXPECT_NEAR(end_of(scan, 0).y, -3.0, 1e-6);
    EXPECT_NEAR(end_of(scan, 1).x, 1.0, 1e-6);
    EXPECT_NEAR(end_of(scan, 2).y, 2.0, 1e-6);
  }
}

TEST(ScanReader, NothingIsTheGreatestRangeAndNoReadingNaN) {
  ScanReader reader{{}};
  const std::vector<float> ranges{kInf, 12.5F, 12.0F, 11.9F, 0.0F, -kInf, -1.0F, std::nanf("")};
  const DriverScan& scan = reader.read({ranges, 0.0, 0.1, 0.1, 12.0});
  for (const std::size_t beam : {0U, 1U, 2U}) EXPECT_EQ(scan.ranges[beam], 12.0F);
  EXPECT_EQ(scan.ranges[3], 11.9F);
  for (const std::size_t beam : {4U, 5U, 6U, 7U}) EXPECT_TRUE(std::isnan(scan.ranges[beam])) << beam;
}

TEST(ScanReader, ItsOwnerKnowsBetterHowFarItLooksAndWhatZeroMeans) {
  ScanReader reader{{.max_range = 6.0, .zero = ZeroMeans::nothing}};
  const std::vector<float> ranges{0.0F, kInf, 5.0F, 7.0F};
  const DriverScan& scan = reader.read({ranges, 0.0, 0.1, 0.1, 64.0});
  EXPECT_EQ(scan.max_range, 6.0);
  EXPECT_EQ(scan.ranges[0], 6.0F);
  EXPECT_EQ(scan.ranges[1], 6.0F);
  EXPECT_EQ(scan.ranges[2], 5.0F);
  EXPECT_EQ(scan.ranges[3], 6.0F);
  ASSERT_EQ(reader.notes().size(), 1U) << "64 m are not 6 m";
  EXPECT_NE(reader.notes()[0].find("64.0 m"), std::string::npos);
  ScanReader fitting{{.max_range = 64.0}};
  (void)fitting.read({ranges, 0.0, 0.1, 0.1, 64.0});
  EXPECT_TRUE(fitting.notes().empty());
}

TEST(ScanReader, AnUprightScannerThatFailsNowAndThenIsReadAsItStands) {
  ScanReader reader{{}};
  std::vector<float> ranges(180, 3.0F);
  ranges[20] = 0.0F;
  for (int sweep = 0; sweep < 30; ++sweep)
    EXPECT_TRUE(std::isnan(reader.read({ranges, -1.5, 0.017, 0.1, 10.0}).ranges[20]));
  EXPECT_EQ(reader.zero(), ZeroMeans::find_out);
}

TEST(ScanReader, SaysWhenItMeetsHardlyAnything) {
  ScanReader reader{{}};
  std::vector<float> ranges(180, kInf);
  std::fill_n(ranges.begin(), 90, 2.0F);
  std::fill_n(ranges.begin(), 20, std::nanf(""));
  for (int sweep = 0; sweep < 100; ++sweep) (void)reader.read({ranges, -1.5, 0.017, 0.1, 4.0});
  EXPECT_EQ(reader.hindrance(), "") << "70 of 160";
  std::fill_n(ranges.begin() + 36, 54, kInf);
  for (int sweep = 0; sweep < 100; ++sweep) (void)reader.read({ranges, -1.5, 0.017, 0.1, 4.0});
  EXPECT_EQ(reader.hindrance(), "meets something in 10 % of its directions only: little stands within its 4.0 m");
  EXPECT_TRUE(reader.notes().empty()) << "a large hall is no fault";
}

}  // namespace
}  // namespace docent
