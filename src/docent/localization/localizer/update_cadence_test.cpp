#include "docent/localization/localizer/update_cadence.h"

#include <gtest/gtest.h>

namespace docent::localization {
namespace {

Time at(double s) { return Time{} + seconds(s); }
Motion straight(double way) { return Motion{{way, 0.0, Angle{}}}; }
Motion turned(double degrees) { return Motion{{0.0, 0.0, Angle::degrees(degrees)}}; }

UpdateCadence started(bool rounds_repeat = true) {
  UpdateCadence cadence{LocalizerParams{}, rounds_repeat};
  cadence.restart_at(at(100.0));
  cadence.begin({}, {5.0, 5.0}, at(100.0));
  return cadence;
}

TEST(UpdateCadence, AWayOrATurnIsWorthAWholeUpdate) {
  const LocalizerParams params;
  EXPECT_EQ(started().weight(straight(params.update_way), at(100.1)), 1.0);
  EXPECT_EQ(started().weight(turned(params.update_turn + 0.01), at(100.1)), 1.0);
  EXPECT_EQ(started().weight(straight(0.9 * params.update_way), at(100.1)), 0.0);
}

TEST(UpdateCadence, WhoCreepsOrStandsIsAskedLaterAndForLess) {
  const LocalizerParams params;
  EXPECT_EQ(started().weight(straight(0.1), at(100.0 + 0.9 * params.creeping_period)), 0.0);
  EXPECT_NEAR(started().weight(straight(0.1), at(100.0 + params.creeping_period)), 0.1 / params.update_way, 1e-12);
  EXPECT_EQ(started().weight({}, at(100.0 + 0.9 * params.standing_period)), 0.0);
  EXPECT_EQ(started().weight({}, at(100.0 + params.standing_period)), params.standing_weight);
}

TEST(UpdateCadence, WaitsUntilTheWorkOfTheLastUpdateIsPaidOff) {
  LocalizerParams params;
  UpdateCadence cadence = started();
  cadence.pay(2.0 * params.work_per_second);
  EXPECT_EQ(cadence.weight(straight(1.0), at(101.9)), 0.0);
  EXPECT_EQ(cadence.weight(straight(1.0), at(102.1)), 1.0);
}

TEST(UpdateCadence, ASecondRoundOnTheSpotIsNewsOnceInAWhile) {
  const auto after_a_round = [](bool rounds_repeat) {
    UpdateCadence cadence = started(rounds_repeat);
    for (int i = 1; i <= 37; ++i) cadence.begin(turned(10.0), {5.0, 5.0}, at(100.0 + i));
    return cadence;
  };
  EXPECT_EQ(after_a_round(true).weight(turned(10.1), at(138.0)), 0.0);
  EXPECT_EQ(after_a_round(true).weight(turned(10.1), at(140.0)), 1.0);
  EXPECT_EQ(after_a_round(true).weight(straight(0.3), at(138.0)), 1.0) << "it has left the spot";
  EXPECT_EQ(after_a_round(false).weight(turned(10.1), at(138.0)), 1.0);
  EXPECT_EQ(after_a_round(true).views(turned(40.0)), 1.0);
  EXPECT_GT(after_a_round(false).views(turned(40.0)), 1.0);
}

}  // namespace
}  // namespace docent::localization
