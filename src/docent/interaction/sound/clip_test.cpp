#include "docent/interaction/sound/clip.h"

#include <gtest/gtest.h>

#include "docent/interaction/sound/levels_for_test.h"

namespace docent::interaction::clip_test {
namespace {

TEST(Clip, LevelsByHand) {
  EXPECT_DOUBLE_EQ(from_db(20.0), 10.0);
  EXPECT_DOUBLE_EQ(to_db(0.1), -20.0);
  EXPECT_DOUBLE_EQ(to_db(0.0), kSilence);
  EXPECT_DOUBLE_EQ(level_db(Clip{1.0F, -1.0F, 1.0F, -1.0F}), 0.0);
  EXPECT_DOUBLE_EQ(level_db(Clip{}), kSilence);
  EXPECT_NEAR(level_db(sine(440.0, -20.0, 1.0)), -20.0, 0.01);
  EXPECT_NEAR(duration_s(sine(440.0, -20.0, 1.5)), 1.5, 1e-4);
}

TEST(Clip, SixteenBits) {
  EXPECT_EQ(to_pcm(0.0), 0);
  EXPECT_EQ(to_pcm(1.0), 32767);
  EXPECT_EQ(to_pcm(-7.0), -32767);
  const std::vector<std::int16_t> square{32767, -32767};
  EXPECT_DOUBLE_EQ(level_db(square), 0.0);
}

TEST(Clip, PausesDoNotCountForItsLoudness) {
  Clip clip = sine(440.0, -20.0, 1.0);
  clip.insert(clip.end(), 3 * kSampleRate, 0.0F);
  EXPECT_NEAR(level_db(clip), -26.0, 0.1);
  EXPECT_NEAR(loudness_db(clip), -20.0, 0.1);
  EXPECT_DOUBLE_EQ(loudness_db(Clip(1000, 0.0F)), kSilence);
  EXPECT_DOUBLE_EQ(loudness_db(Clip{}), kSilence);
}

TEST(Clip, QuietAndLoudComeToOneLevel) {
  for (const double level : {-50.0, -20.0, -3.0}) {
    EXPECT_NEAR(loudness_db(levelled(sine(440.0, level, 1.0), -18.0)), -18.0, 0.1) << level;
  }
  EXPECT_DOUBLE_EQ(level_db(levelled(Clip(1000, 0.0F), -18.0)), kSilence);
}

}  // namespace
}  // namespace docent::interaction::clip_test
