#include "docent/interaction/sound/melody.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/interaction/sound/levels_for_test.h"

namespace docent::interaction::melody_test {
namespace {

TEST(Melody, LastsEightBarsAndIsNeverSilent) {
  const Clip melody = melody_clip();
  EXPECT_NEAR(duration_s(melody), 32.0 * 60.0 / 112.0, 0.001);
  std::vector<std::int16_t> samples;
  for (const float sample : melody) samples.push_back(to_pcm(sample));
  for (double begin = 0.0; begin + 1.0 < duration_s(melody); begin += 1.0) {
    EXPECT_GT(level_db(part(samples, begin, begin + 1.0)), -35.0) << begin;
    EXPECT_LT(level_db(part(samples, begin, begin + 1.0)), -10.0) << begin;
  }
  EXPECT_EQ(melody, melody_clip());
}

TEST(Melody, CanBePlayedRoundAndRound) {
  const Clip melody = melody_clip();
  float most = 0.0F, step = 0.0F;
  for (std::size_t i = 1; i < melody.size(); ++i) {
    most = std::max(most, std::abs(melody[i]));
    step = std::max(step, std::abs(melody[i] - melody[i - 1]));
  }
  EXPECT_NEAR(most, 0.5, 1e-4);
  EXPECT_LE(std::abs(melody.front() - melody.back()), step) << "a click where it begins anew";
}

TEST(Melody, BeginsWithItsFirstNotes) {
  std::vector<std::int16_t> samples;
  for (const float sample : melody_clip()) samples.push_back(to_pcm(sample));
  const auto beginning = part(samples, 0.05, 0.45);
  const double voice = goertzel_db(beginning, 329.63);  // E4
  const double bass = goertzel_db(beginning, 130.81);   // C3
  for (const double other : {110.0, 146.83, 293.66, 311.13, 349.23, 440.0}) {
    EXPECT_LT(goertzel_db(beginning, other), std::min(voice, bass) - 10.0) << other;
  }
}

}  // namespace
}  // namespace docent::interaction::melody_test
