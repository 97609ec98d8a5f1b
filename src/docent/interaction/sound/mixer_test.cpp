#include "docent/interaction/sound/mixer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "docent/interaction/sound/horn.h"
#include "docent/interaction/sound/levels_for_test.h"
#include "docent/interaction/sound/melody.h"

namespace docent::interaction::mixer_test {
namespace {

using Samples = std::vector<std::int16_t>;

Samples mixed(Mixer& mixer, double duration_s) {
  Samples samples(static_cast<std::size_t>(duration_s * kSampleRate));
  // In uneven pieces, as a card asks for them.
  for (std::size_t at = 0; at < samples.size(); at += 997)
    mixer.mix(std::span{samples}.subspan(at, std::min<std::size_t>(997, samples.size() - at)));
  return samples;
}

SharedClip shared(Clip clip) { return std::make_shared<const Clip>(std::move(clip)); }

const SharedClip kLine = shared(sine(200.0, -9.0, 3.0));    // stands for speech
const SharedClip kMusic = shared(sine(1000.0, -3.0, 0.5));  // played round and round
const SharedClip kHorn = shared(horn_clip());
const MixerParams kParams;

TEST(Mixer, SilenceIsSilence) {
  Mixer mixer{kParams};
  EXPECT_EQ(mixed(mixer, 1.0), Samples(kSampleRate, 0));
  mixer.speak(shared(Clip(1000, 0.0F)));
  mixer.speak(shared(Clip{}));
  mixer.play_music(shared(Clip{}));
  mixer.play_music(nullptr);
  mixer.hush();
  EXPECT_EQ(mixed(mixer, 1.0), Samples(kSampleRate, 0));
}

TEST(Mixer, EverythingComesToItsLevelHoweverLoudItWas) {
  for (const double level : {-40.0, -20.0, -3.1}) {
    Mixer line{kParams}, horn{kParams}, music{kParams};
    line.speak(shared(sine(200.0, level, 1.0)));
    EXPECT_NEAR(level_db(part(mixed(line, 1.0), 0.1, 0.9)), kParams.speech_db, 0.1) << level;
    horn.honk(shared(sine(440.0, level, 1.0)));
    EXPECT_NEAR(level_db(part(mixed(horn, 1.0), 0.1, 0.9)), kParams.horn_db, 0.1) << level;
    music.play_music(shared(sine(1000.0, level, 1.0)));
    EXPECT_NEAR(level_db(part(mixed(music, 4.0), 2.0, 4.0)), kParams.music_db, 0.1) << level;
  }
}

TEST(Mixer, MusicComesAndGoesSoftlyAndPlaysRoundAndRound) {
  Mixer mixer{kParams};
  mixer.play_music(kMusic);
  const Samples begun = mixed(mixer, 5.0);
  EXPECT_LT(level_db(part(begun, 0.0, 0.1)), kParams.music_db - 20.0);
  EXPECT_LT(level_db(part(begun, 0.4, 0.6)), kParams.music_db - 6.0);
  EXPECT_NEAR(level_db(part(begun, 4.0, 5.0)), kParams.music_db, 0.1) << "ten times as long as the clip";
  mixer.play_music(kMusic);
  EXPECT_NEAR(level_db(mixed(mixer, 0.5)), kParams.music_db, 0.2) << "the same again goes on";
  mixer.play_music(nullptr);
  const Samples over = mixed(mixer, 2.0);
  EXPECT_GT(level_db(part(over, 0.0, 0.1)), kParams.music_db - 1.0) << "it does not break off";
  EXPECT_EQ(level_db(part(over, 1.6, 2.0)), kSilence);
}

TEST(Mixer, MusicSinksUnderSpeechAndComesBack) {
  Mixer mixer{kParams};
  mixer.play_music(kMusic);
  mixed(mixer, 2.0);
  mixer.speak(kLine);
  const Samples samples = mixed(mixer, 5.0);
  const double speech = goertzel_db(part(samples, 0.5, 2.5), 200.0);
  const double ducked = goertzel_db(part(samples, 0.5, 2.5), 1000.0);
  EXPECT_NEAR(speech, kParams.speech_db, 0.2);
  EXPECT_GE(speech - ducked, 20.0) << "WCAG 1.4.7";
  EXPECT_GT(ducked, -60.0) << "it plays on";
  EXPECT_LT(goertzel_db(part(samples, 3.1, 3.3), 1000.0), kParams.music_db - 3.0) << "not at once";
  EXPECT_NEAR(goertzel_db(part(samples, 4.2, 5.0), 1000.0), kParams.music_db, 0.3);
}

TEST(Mixer, TheHornIsHeardOverMusicAndSpeech) {
  const auto music = shared(melody_clip());
  Mixer with{kParams}, without{kParams};
  for (Mixer* mixer : {&with, &without}) {
    mixer->play_music(music);
    mixed(*mixer, 3.0);
    mixer->speak(kLine);
  }
  mixed(with, 1.0);
  mixed(without, 1.0);
  with.honk(kHorn);
  const Samples loud = mixed(with, 0.5), soft = mixed(without, 0.5);
  for (const double pitch : {349.23, 440.0}) {
    EXPECT_GT(goertzel_db(part(loud, 0.02, 0.17), pitch), goertzel_db(part(soft, 0.02, 0.17), pitch) + 15.0) << pitch;
  }
  EXPECT_GT(level_db(part(loud, 0.02, 0.17)), level_db(part(soft, 0.02, 0.17)) + 5.0);
}

TEST(Mixer, TheHornIsNotBegunAgainWhileItSounds) {
  Mixer once{kParams}, twice{kParams};
  once.honk(kHorn);
  twice.honk(kHorn);
  mixed(once, 0.1);
  mixed(twice, 0.1);
  twice.honk(kHorn);
  EXPECT_EQ(mixed(once, 1.0), mixed(twice, 1.0));
  twice.honk(kHorn);
  EXPECT_GT(level_db(part(mixed(twice, 0.5), 0.02, 0.2)), -20.0) << "afterwards it sounds again";
}

TEST(Mixer, ANewerLineBreaksTheOlderOff) {
  Mixer mixer{kParams};
  mixer.speak(kLine);
  mixed(mixer, 0.5);
  mixer.speak(shared(sine(3000.0, -9.0, 1.0)));
  const Samples samples = mixed(mixer, 2.0);
  EXPECT_LT(goertzel_db(part(samples, 0.05, 0.9), 200.0), kParams.speech_db - 40.0);
  EXPECT_NEAR(goertzel_db(part(samples, 0.05, 0.9), 3000.0), kParams.speech_db, 0.2);
  mixer.speak(kLine);
  mixed(mixer, 0.5);
  mixer.hush();
  EXPECT_EQ(level_db(part(mixed(mixer, 1.0), 0.05, 1.0)), kSilence);
}

TEST(Mixer, ALineMayGoOnInTheMiddle) {
  Mixer mixer{kParams};
  mixer.speak(kLine, 2.5);
  const Samples samples = mixed(mixer, 1.0);
  EXPECT_NEAR(level_db(part(samples, 0.1, 0.4)), kParams.speech_db, 0.1);
  EXPECT_EQ(level_db(part(samples, 0.55, 1.0)), kSilence);
  mixer.speak(kLine, 1e9);
  EXPECT_EQ(level_db(mixed(mixer, 0.5)), kSilence);
}

TEST(Mixer, TheVolumeChangesEverythingAlike) {
  Mixer full{kParams}, half{kParams};
  half.set_volume(0.5);
  for (Mixer* mixer : {&full, &half}) {
    mixed(*mixer, 0.2);
    mixer->play_music(kMusic);
    mixer->speak(kLine);
  }
  const Samples loud = mixed(full, 3.0), soft = mixed(half, 3.0);
  for (const double pitch : {200.0, 1000.0}) {
    const double by = goertzel_db(part(loud, 1.0, 2.5), pitch) - goertzel_db(part(soft, 1.0, 2.5), pitch);
    EXPECT_NEAR(by, 6.02, 0.3) << pitch;
  }
  half.set_volume(0.0);
  mixed(half, 0.2);
  half.honk(kHorn);
  EXPECT_EQ(level_db(mixed(half, 1.0)), kSilence) << "muted";
}

TEST(Mixer, WhatIsTooLoudIsBentAndNotCut) {
  MixerParams loud;
  loud.speech_db = loud.horn_db = loud.music_db = -10.0;
  loud.duck_db = 0.0;
  Mixer mixer{loud};
  mixer.play_music(kMusic);
  mixed(mixer, 2.0);
  mixer.speak(kLine);
  mixer.honk(shared(sine(440.0, -3.0, 1.0)));
  const Samples samples = mixed(mixer, 0.9);
  ASSERT_GT(3.0 * std::numbers::sqrt2 * from_db(-10.0), 1.3) << "three sines that are too much together";
  std::vector<int> sizes;
  for (const std::int16_t sample : samples) sizes.push_back(std::abs(static_cast<int>(sample)));
  std::sort(sizes.begin(), sizes.end());
  EXPECT_LT(sizes.back(), 32767) << "it never reaches full scale";
  EXPECT_GT(sizes.back(), 31000);
  const auto flat = sizes.end() - std::lower_bound(sizes.begin(), sizes.end(), sizes.back() - 1);
  EXPECT_LT(static_cast<double>(flat) / static_cast<double>(sizes.size()), 0.005) << "flat tops are clipping";
}

TEST(Mixer, EvenTheLoudestKeepsItsSign) {
  MixerParams loud;
  loud.speech_db = loud.horn_db = 0.0;
  Mixer mixer{loud};
  const auto square = shared(Clip(kSampleRate, 1.0F));
  mixer.speak(square);
  mixer.honk(square);
  for (const std::int16_t sample : mixed(mixer, 0.9)) ASSERT_GT(sample, 32000);
}

TEST(Mixer, QuietSoundPassesTheLimiterUnchanged) {
  Mixer mixer{kParams};
  mixer.speak(kLine);
  const Samples samples = mixed(mixer, 1.0);
  const double gain = from_db(kParams.speech_db - loudness_db(*kLine));
  for (std::size_t i = 0; i < samples.size(); i += 101)
    ASSERT_NEAR(samples[i], 32767.0 * gain * static_cast<double>((*kLine)[i]), 1.0) << i;
}

TEST(Mixer, RefusesParametersOfNoUse) {
  const auto fault = [](auto change) {
    MixerParams params;
    change(params);
    const auto valid = params.validate();
    return valid ? std::string{} : valid.error().message;
  };
  EXPECT_EQ(fault([](MixerParams&) {}), "");
  EXPECT_NE(fault([](MixerParams& p) { p.speech_db = 3.0; }).find("speech_db"), std::string::npos);
  EXPECT_NE(fault([](MixerParams& p) { p.horn_db = std::nan(""); }).find("horn_db"), std::string::npos);
  EXPECT_NE(fault([](MixerParams& p) { p.music_db = -90.0; }).find("music_db"), std::string::npos);
  EXPECT_NE(fault([](MixerParams& p) { p.duck_db = -1.0; }).find("duck_db"), std::string::npos);
  EXPECT_NE(fault([](MixerParams& p) { p.fade_s = 0.0; }).find("fade_s"), std::string::npos);
  EXPECT_NE(fault([](MixerParams& p) { p.duck_s = 0.0; }).find("duck_s"), std::string::npos);
  EXPECT_NE(fault([](MixerParams& p) { p.release_s = 0.0; }).find("release_s"), std::string::npos);
  EXPECT_NE(fault([](MixerParams& p) { p.limiter_knee = 0.0; }).find("limiter_knee"), std::string::npos);
}

}  // namespace
}  // namespace docent::interaction::mixer_test
