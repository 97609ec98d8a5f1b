#include "docent/interaction/attract/style_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::interaction {
namespace {

AttractionTrial trial_of(Mood face, SpeechAct speech, double reward, double density) {
  return {Time{}, density, {GazeStrategy::nearest, face, speech}, {0.2, 0.2, 0.2, 0.2, 0.2}, reward};
}

const RewardStatistic& of(const StyleStatistics& statistics, Style style) {
  return statistics.at(static_cast<std::size_t>(style));
}

TEST(StyleStatistics, MeansAndIntervalsByHand) {
  const TrialMemory trials{
      trial_of(Mood::happy, SpeechAct::invite, 1.0, 0.02), trial_of(Mood::happy, SpeechAct::ask, 2.0, 0.08),
      trial_of(Mood::happy, SpeechAct::ask, 3.0, 0.08), trial_of(Mood::angry, SpeechAct::demand, -1.0, 0.08)};
  const StyleStatistics all = style_statistics(trials, std::nullopt, {});
  EXPECT_EQ(of(all, Style::friendly).count, 3);
  EXPECT_DOUBLE_EQ(of(all, Style::friendly).mean, 2.0);
  // Student's t of 2 degrees of freedom at 97.5 % is 4.3027.
  EXPECT_NEAR(of(all, Style::friendly).half_width.value_or(0.0), 4.3027 / std::sqrt(3.0), 1e-3);
  EXPECT_EQ(of(all, Style::upset).count, 1);
  EXPECT_FALSE(of(all, Style::upset).half_width) << "one trial has no spread";
  EXPECT_EQ(of(all, Style::even).count, 0);
  const StyleStatistics busy = style_statistics(trials, CrowdClass::busy, {});
  EXPECT_EQ(of(busy, Style::friendly).count, 2);
  EXPECT_DOUBLE_EQ(of(busy, Style::friendly).mean, 2.5);
  EXPECT_EQ(of(style_statistics(trials, CrowdClass::packed, {}), Style::friendly).count, 0);
}

}  // namespace
}  // namespace docent::interaction
