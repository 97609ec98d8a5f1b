#include "docent/interaction/sound/loudspeaker.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/interaction/sound/levels_for_test.h"

namespace docent::interaction::loudspeaker_test {
namespace {

const auto kLine = std::make_shared<const Clip>(sine(200.0, -9.0, 1.0));
const MixerParams kParams;

class LoudspeakerTest : public testing::Test {
 protected:
  LoudspeakerTest()
      : file_{std::filesystem::temp_directory_path() / ("docent_loud_" + std::to_string(getpid()) + ".wav")} {}
  ~LoudspeakerTest() override { std::filesystem::remove(file_); }
  [[nodiscard]] std::vector<std::int16_t> written() const {
    std::vector<std::int16_t> samples;
    const auto clip = read_clip(file_);
    EXPECT_TRUE(clip) << clip.error().message;
    if (clip) {
      for (const float sample : *clip) samples.push_back(to_pcm(sample));
    }
    return samples;
  }
  std::filesystem::path file_;
};

TEST_F(LoudspeakerTest, TheFileHoldsTheMixInTheTimeItIsTold) {
  const Time begin = time_from_seconds(1000.0);
  {
    Loudspeaker loudspeaker{SoundOutput::file, file_.string(), kParams, begin};
    EXPECT_TRUE(loudspeaker.is_there());
    loudspeaker.advance(begin + seconds(1.0));
    loudspeaker.speak(kLine);
    for (int i = 1; i <= 20; ++i) loudspeaker.advance(begin + seconds(1.0 + 0.1 * i));
    EXPECT_EQ(loudspeaker.fault(), "");
  }
  const auto samples = written();
  EXPECT_NEAR(static_cast<double>(samples.size()) / kSampleRate, 3.0, 1e-3);
  EXPECT_EQ(level_db(part(samples, 0.0, 0.99)), kSilence);
  EXPECT_NEAR(level_db(part(samples, 1.01, 1.99)), kParams.speech_db, 0.1);
  EXPECT_EQ(level_db(part(samples, 2.01, 2.9)), kSilence);
}

TEST_F(LoudspeakerTest, AClockThatGoesBackOrJumpsWritesNoHours) {
  const Time begin = time_from_seconds(1000.0);
  {
    Loudspeaker loudspeaker{SoundOutput::file, file_.string(), kParams, begin};
    loudspeaker.advance(begin - seconds(500.0));
    loudspeaker.advance(begin + seconds(1e6));
    EXPECT_EQ(loudspeaker.fault(), "");
  }
  EXPECT_NEAR(static_cast<double>(written().size()) / kSampleRate, 60.0, 1e-3);
}

TEST_F(LoudspeakerTest, WithoutAnOutputItIsSilentAndContent) {
  Loudspeaker silent{SoundOutput::none, "", kParams, Time{}};
  EXPECT_FALSE(silent.is_there());
  silent.speak(kLine);
  silent.honk(kLine);
  silent.play_music(kLine);
  silent.advance(time_from_seconds(10.0));
  EXPECT_EQ(silent.fault(), "");
}

TEST_F(LoudspeakerTest, WhatIsMissingIsNamedAndSoughtAgain) {
  Loudspeaker missing{SoundOutput::card, "hw:77", kParams, Time{}};
  EXPECT_NE(missing.fault().find("hw:77"), std::string::npos);
  missing.speak(kLine);
  missing.advance(time_from_seconds(6.0));
  EXPECT_NE(missing.fault().find("hw:77"), std::string::npos);
  Loudspeaker unwritable{SoundOutput::file, "/proc/nowhere/mix.wav", kParams, Time{}};
  EXPECT_NE(unwritable.fault().find("/proc/nowhere"), std::string::npos);
  unwritable.advance(time_from_seconds(6.0));
  Loudspeaker there{SoundOutput::card, "null", kParams, Time{}};
  EXPECT_EQ(there.fault(), "");
}

}  // namespace
}  // namespace docent::interaction::loudspeaker_test
