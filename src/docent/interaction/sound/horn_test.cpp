#include "docent/interaction/sound/horn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/interaction/sound/levels_for_test.h"

namespace docent::interaction::horn_test {
namespace {

TEST(Horn, BeginsAndEndsSoftlyAndStartlesNobody) {
  const Clip horn = horn_clip();
  const auto louder = [](float a, float b) { return std::abs(a) < std::abs(b); };
  const float loudest = std::abs(*std::max_element(horn.begin(), horn.end(), louder));
  EXPECT_GT(loudest, 0.25F);
  EXPECT_LE(loudest, 0.5F) << "no louder than half of full scale";
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT(std::abs(horn[i]), 0.02F) << "a click at the beginning";
    EXPECT_LT(std::abs(horn[horn.size() - 1 - i]), 0.02F) << "a click at the end";
  }
  EXPECT_NEAR(duration_s(horn), 0.54, 0.001);
}

TEST(Horn, SoundsF4AndA4) {
  std::vector<std::int16_t> samples;
  for (const float sample : horn_clip()) samples.push_back(to_pcm(sample));
  const auto blast = part(samples, 0.02, 0.17);
  const double lower = goertzel_db(blast, 349.23), upper = goertzel_db(blast, 440.0);
  EXPECT_GT(lower, -25.0);
  EXPECT_GT(upper, -25.0);
  for (const double beside : {200.0, 300.0, 392.0, 520.0, 600.0}) {
    EXPECT_LT(goertzel_db(blast, beside), std::min(lower, upper) - 12.0) << beside;
  }
  EXPECT_LT(level_db(part(samples, 0.23, 0.31)), -60.0) << "two blasts with a gap";
}

TEST(Horn, EveryProcessKnowsItsName) {
  EXPECT_EQ(horn_sound().file, horn_sound().file);
  EXPECT_EQ(horn_sound().file.size(), 16U + 4U);
  EXPECT_DOUBLE_EQ(horn_sound().duration_s, duration_s(horn_clip()));
}

}  // namespace
}  // namespace docent::interaction::horn_test
