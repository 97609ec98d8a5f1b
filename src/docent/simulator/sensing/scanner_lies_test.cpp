#include "docent/simulator/sensing/scanner_lies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace docent::simulator {
namespace {

/// A scan of seven beams, 30 degrees apart, that measures 0.4 to 1.0 m and, with the last beam, nothing.
struct Driver {
  ScannerLies lies;
  std::vector<float> ranges;
  float range_min = 0.05F;
  float range_max = 10.0F;

  const std::vector<float>& scan(double time, float more = 0.0F) {
    ranges = {0.4F, 0.5F, 0.6F, 0.7F, 0.8F, 1.0F, 10.0F};
    for (std::size_t i = 0; i < 6; ++i) ranges[i] += more;
    range_min = 0.05F;
    range_max = 10.0F;
    lies.tell(time_from_seconds(time), {ranges, range_min, range_max, -1.5707963F, 0.52359878F});
    return ranges;
  }
  const std::vector<float>& scan_with(const ScannerLie& lie) {
    lies.begin(lie, time_from_seconds(1.0));
    return scan(1.0);
  }
};

TEST(ScannerLies, WithoutALieNothingChanges) {
  Driver driver;
  EXPECT_EQ(driver.scan(1.0), (std::vector<float>{0.4F, 0.5F, 0.6F, 0.7F, 0.8F, 1.0F, 10.0F}));
}

TEST(ScannerLies, ChangeWhatCameBack) {
  EXPECT_EQ(Driver{}.scan_with({.lie = Lie::units})[1], 500.0F);
  EXPECT_EQ(Driver{}.scan_with({.lie = Lie::units})[6], 10.0F);
  EXPECT_EQ(Driver{}.scan_with({.lie = Lie::offset, .amount = 0.25})[1], 0.75F);
  EXPECT_EQ(Driver{}.scan_with({.lie = Lie::offset, .amount = -0.45})[0], 0.0F);
  Driver twice;
  EXPECT_EQ(twice.scan_with({.lie = Lie::scaled})[5], 2.0F);
  EXPECT_EQ(twice.range_max, 20.0F);
  Driver silent;
  for (const float range : silent.scan_with({.lie = Lie::silent})) EXPECT_TRUE(std::isinf(range));
}

TEST(ScannerLies, HideASectorAndWhatIsNear) {
  Driver sector;
  sector.scan_with({.lie = Lie::sector, .amount = 70.0, .bearing = 0.0});
  EXPECT_FALSE(std::isinf(sector.ranges[1]));
  for (const std::size_t i : {2U, 3U, 4U}) EXPECT_TRUE(std::isinf(sector.ranges[i])) << i;
  EXPECT_FALSE(std::isinf(sector.ranges[5]));
  Driver near;
  near.scan_with({.lie = Lie::too_near});
  EXPECT_TRUE(std::isinf(near.ranges[1]));
  EXPECT_EQ(near.ranges[3], 0.7F);
  EXPECT_EQ(near.range_min, 0.6F);
  EXPECT_NEAR(near.lies.left_out(), 2 * 0.52359878, 1e-6);
  near.scan(1.1, 0.5F);
  EXPECT_EQ(near.lies.left_out(), 0.0);
  Driver unsaid;
  unsaid.scan_with({.lie = Lie::blind_near});
  EXPECT_TRUE(std::isinf(unsaid.ranges[1]));
  EXPECT_EQ(unsaid.range_min, 0.05F);
}

TEST(ScannerLies, RepeatOldSweeps) {
  for (const Lie lie : {Lie::stale, Lie::looped}) {
    Driver driver;
    for (int i = 0; i < 50; ++i) driver.scan(0.1 * i, 0.01F * static_cast<float>(i));
    driver.lies.begin({.lie = lie, .amount = 1.0}, time_from_seconds(5.0));
    EXPECT_NEAR(driver.scan(5.0, 0.5F)[0], 0.8, 0.011);
    EXPECT_NEAR(driver.scan(5.5, 0.55F)[0], 0.85, 0.011);
    driver.scan(5.9, 0.59F);
    EXPECT_NEAR(driver.scan(6.5, 0.65F)[0], lie == Lie::stale ? 0.95 : 0.85, 0.011);
  }
}

TEST(ScannerLies, ALoopFromTheStartRepeatsWhatItSaidFirst) {
  Driver driver;
  driver.lies.begin({.lie = Lie::looped, .amount = 1.0}, time_from_seconds(0.0));
  for (int i = 0; i <= 10; ++i) {
    const float true_range = 0.01F * static_cast<float>(i);
    EXPECT_EQ(driver.scan(0.1 * i, true_range)[0], 0.4F + true_range);
  }
  for (int i = 11; i < 35; ++i) EXPECT_LT(driver.scan(0.1 * i, 0.01F * static_cast<float>(i))[0], 0.51F) << i;
}

TEST(ScannerLies, EndAfterAWhile) {
  Driver driver;
  driver.scan_with({.lie = Lie::silent, .duration = 2.0});
  EXPECT_TRUE(std::isinf(driver.scan(2.9)[0]));
  EXPECT_EQ(driver.scan(3.0)[0], 0.4F);
}

}  // namespace
}  // namespace docent::simulator
