#include "docent/pictures/ticks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::pictures {
namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> texts;
  for (const Tick& tick : ticks) texts.push_back(tick.label);
  return texts;
}
using Labels = std::vector<std::string>;

TEST(RoundTicks, AreRoundAndWithinTheRange) {
  EXPECT_EQ(labels(round_ticks(0.0, 10.0, 6)), (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(round_ticks(0.0, 10.0, 5)), (Labels{"0", "5", "10"}));
  EXPECT_EQ(labels(round_ticks(-0.73, 1.12, 4)), (Labels{"-0.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(labels(round_ticks(0.1, 0.3, 3)), (Labels{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(labels(round_ticks(1234.0, 98765.0, 5)), (Labels{"20000", "40000", "60000", "80000"}));
}

TEST(RoundTicks, KeepTheirPromisesOverManyRanges) {
  for (const double low : {-1e3, -7.3, -0.02, 0.0, 0.4, 55.5, 1e6}) {
    for (const double span : {1e-3, 0.37, 1.0, 9.99, 64.0, 12345.0}) {
      for (const int most : {2, 3, 5, 10}) {
        const auto ticks = round_ticks(low, low + span, most);
        ASSERT_LE(ticks.size(), static_cast<std::size_t>(most)) << low << " " << span;
        // Steps of the three kinds are at most 2.5 times apart, and a range holds one tick less than it has steps.
        ASSERT_GE(ticks.size() + 1, static_cast<std::size_t>(std::floor(most / 2.5))) << low << " " << span;
        for (std::size_t i = 0; i < ticks.size(); ++i) {
          EXPECT_GE(ticks[i].at, low - 1e-5 * span);
          EXPECT_LE(ticks[i].at, low + span + 1e-5 * span);
          EXPECT_NEAR(std::stod(ticks[i].label), ticks[i].at, 1e-9 * std::max(1.0, std::abs(low))) << "label";
          if (i < 2) continue;
          const double step = ticks[i].at - ticks[i - 1].at;
          EXPECT_NEAR(step, ticks[1].at - ticks[0].at, 1e-6 * step + 1e-9);
        }
      }
    }
  }
}

TEST(PowerTicks, AreThePowersWithin) {
  const auto ticks = power_ticks(2e-3, 1.0);
  EXPECT_EQ(labels(ticks), (Labels{"10⁻²", "10⁻¹", "10⁰"}));
  EXPECT_DOUBLE_EQ(ticks[0].at, 0.01);
  EXPECT_EQ(labels(power_ticks(1e10, 2e11)), (Labels{"10¹⁰", "10¹¹"}));
  EXPECT_TRUE(power_ticks(2.0, 9.0).empty());
}

}  // namespace
}  // namespace docent::pictures
