#include "docent/interaction/soundscape/soundscape.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/interaction/sound/horn.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::interaction {
namespace {

const Say kHello{"s1", "Hello, dear visitors.", "en", Mood::neutral};
const Say kMore{"s2", "There is more to tell.", "en", Mood::neutral};

/// Renders what it is told to; the test says how that goes.
class FakeVoice final : public LineVoice {
 public:
  [[nodiscard]] bool can_render(const SpokenLine& /*line*/) const override { return true; }
  [[nodiscard]] std::optional<Result<RenderedSpeech>> render(const std::string& id, SpokenLine /*line*/) override {
    ordered.push_back(id);
    return answer;
  }
  std::vector<std::string> ordered;
  std::optional<Result<RenderedSpeech>> answer;
};

Result<RenderedSpeech> speech_of(double duration_s) { return RenderedSpeech{{"00ff.wav", duration_s}, nullptr, ""}; }

class SoundscapeTest : public testing::Test {
 protected:
  SoundscapeTest()
      : folder_{std::filesystem::temp_directory_path() / ("docent_soundscape_" + std::to_string(getpid()))} {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~SoundscapeTest() override {
    sound_.reset();
    std::filesystem::remove_all(folder_);
  }
  SoundNews start(bool makes_sound = true, std::optional<std::filesystem::path> music = std::nullopt) {
    SoundscapeParts parts;
    parts.checkpoint = folder_ / "sound.json";
    parts.audio = folder_ / "audio";
    parts.survives = Survives::process_death;
    parts.makes_sound = makes_sound;
    parts.music = std::move(music);
    parts.is_virtual_time = true;
    auto memory = load_speaker_checkpoint(parts.checkpoint).value_or(SpeakerMemory{});
    sound_ = std::make_unique<Soundscape>(std::move(parts), std::move(memory), now_);
    auto voice = std::make_unique<FakeVoice>();
    voice_ = voice.get();
    sound_->set_voice(std::move(voice));
    return sound_->begin(1.0, now_);
  }
  SoundNews step(double passed_s = 0.1, double volume = 1.0) {
    now_ = now_ + seconds(passed_s);
    return sound_->step(volume, now_);
  }

  std::filesystem::path folder_;
  Time now_ = time_from_seconds(100.0);
  std::unique_ptr<Soundscape> sound_;
  FakeVoice* voice_ = nullptr;
};

TEST_F(SoundscapeTest, AtTheStartTheVolumeIsToldAndNothingWasSaid) {
  const SoundNews news = start();
  EXPECT_TRUE(news.lines.empty());
  ASSERT_TRUE(news.sound);
  EXPECT_EQ(news.sound->volume, 1.0);
  EXPECT_EQ(news.sound->music, "");
  EXPECT_FALSE(step().sound) << "nothing is new";
}

TEST_F(SoundscapeTest, ALineBeginsWhenItsVoiceIsThere) {
  start();
  EXPECT_TRUE(sound_->say(kHello, now_).lines.empty()) << "it is being rendered";
  EXPECT_TRUE(sound_->say(kHello, now_).lines.empty()) << "still";
  EXPECT_EQ(voice_->ordered, std::vector<std::string>{"s1"});
  EXPECT_TRUE(sound_->rendered("another", speech_of(9.0), now_).lines.empty()) << "nobody waits for that";
  now_ = now_ + seconds(0.5);
  const SoundNews news = sound_->rendered("s1", speech_of(2.0), now_);
  ASSERT_EQ(news.lines.size(), 1U);
  EXPECT_TRUE(news.lines[0].is_speaking);
  EXPECT_EQ(news.lines[0].start, now_);
  EXPECT_EQ(news.lines[0].duration_s, 2.0);
  EXPECT_EQ(news.lines[0].audio, "00ff.wav");
  EXPECT_TRUE(step(1.9).lines.empty());
  const SoundNews end = step(0.2);
  ASSERT_EQ(end.lines.size(), 1U);
  EXPECT_EQ(end.lines[0].id, "s1");
  EXPECT_FALSE(end.lines[0].is_speaking);
}

TEST_F(SoundscapeTest, AVoiceThatIsPromptIsHeardAtOnce) {
  start();
  voice_->answer = speech_of(3.0);
  const SoundNews news = sound_->say(kHello, now_);
  ASSERT_EQ(news.lines.size(), 1U);
  EXPECT_EQ(news.lines[0].duration_s, 3.0);
}

TEST_F(SoundscapeTest, WhoOrdersALineAgainHearsHowItGoes) {
  start();
  voice_->answer = speech_of(2.0);
  (void)sound_->say(kHello, now_);
  SoundNews news = sound_->say(kHello, now_);
  ASSERT_EQ(news.lines.size(), 1U);
  EXPECT_TRUE(news.lines[0].is_speaking);
  (void)sound_->say(kMore, now_);
  news = sound_->say(kHello, now_);
  ASSERT_EQ(news.lines.size(), 2U) << "that it is over, and then again the newest";
  EXPECT_EQ(news.lines[0].id, "s1");
  EXPECT_FALSE(news.lines[0].is_speaking);
  EXPECT_EQ(news.lines[1].id, "s2");
  EXPECT_TRUE(news.lines[1].is_speaking);
  EXPECT_EQ(voice_->ordered, (std::vector<std::string>{"s1", "s2"}));
  (void)step(2.5);
  news = sound_->say(kMore, now_);
  ASSERT_EQ(news.lines.size(), 1U);
  EXPECT_FALSE(news.lines[0].is_speaking);
}

TEST_F(SoundscapeTest, WithoutAVoiceTheWordsRemain) {
  start();
  voice_->answer = fail("no such program");
  const SoundNews news = sound_->say(kHello, now_);
  ASSERT_EQ(news.lines.size(), 1U);
  EXPECT_EQ(news.lines[0].audio, "");
  EXPECT_NEAR(news.lines[0].duration_s, speech_duration(kHello.text, "en", Mood::neutral), 1e-9);
  EXPECT_EQ(sound_->fault(), "no voice: no such program");
  voice_->answer = speech_of(2.0);
  (void)sound_->say(kMore, now_);
  EXPECT_EQ(sound_->fault(), "");
  sound_->set_voice(nullptr);
  EXPECT_EQ(sound_->say({"s3", "Hm.", "en", Mood::neutral}, now_).lines.at(0).audio, "");
}

TEST_F(SoundscapeTest, MutedItOrdersNoVoice) {
  start();
  (void)step(0.1, 0.0);
  EXPECT_EQ(sound_->say(kHello, now_).lines.at(0).audio, "");
  EXPECT_TRUE(voice_->ordered.empty());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "audio"));
}

TEST_F(SoundscapeTest, ARestartSpeaksOnToTheEnd) {
  start();
  voice_->answer = speech_of(10.0);
  (void)sound_->say(kHello, now_);
  now_ = now_ + seconds(4.0);
  const SoundNews news = start();
  ASSERT_EQ(news.lines.size(), 1U);
  EXPECT_EQ(news.lines[0].id, "s1");
  EXPECT_TRUE(news.lines[0].is_speaking);
  EXPECT_TRUE(step(5.9).lines.empty());
  EXPECT_EQ(step(0.2).lines.size(), 1U);
}

TEST_F(SoundscapeTest, TheHornLiesReadyBeforeItIsNeeded) {
  start();
  (void)step();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "audio" / horn_sound().file));
  sound_->honk(now_);
  EXPECT_EQ(sound_->fault(), "");
}

TEST_F(SoundscapeTest, AHornThatCannotBeWrittenIsToldAndTriedAgain) {
  std::filesystem::create_symlink("/dev/null", folder_ / "audio");  // no folder can be made there
  start();
  (void)step();
  EXPECT_NE(sound_->fault().find("no horn"), std::string::npos) << sound_->fault();
  std::filesystem::remove(folder_ / "audio");
  (void)step(4.0);
  EXPECT_NE(sound_->fault(), "") << "not so soon";
  (void)step(2.0);
  EXPECT_EQ(sound_->fault(), "");
}

TEST_F(SoundscapeTest, MusicPlaysOnTheWayUnlessItIsOrdered) {
  start();
  EXPECT_FALSE(step().sound);
  sound_->drive(true);
  const SoundNews driving = step();
  ASSERT_TRUE(driving.sound);
  EXPECT_NE(driving.sound->music, "");
  EXPECT_EQ(driving.sound->music_start, now_);
  EXPECT_GT(driving.sound->music_volume, 0.0);
  voice_->answer = speech_of(2.0);
  const SoundNews speaking = sound_->say(kHello, now_);
  ASSERT_TRUE(speaking.sound) << "it is lower under speech";
  EXPECT_LT(speaking.sound->music_volume, driving.sound->music_volume);
  sound_->order_music(false);
  EXPECT_EQ(step().sound.value().music, "");
  sound_->drive(false);
  sound_->order_music(true);
  EXPECT_NE(step().sound.value().music, "");
}

TEST_F(SoundscapeTest, WithoutSoundThereAreOnlyWords) {
  start(false);
  sound_->set_voice(nullptr);
  sound_->drive(true);
  EXPECT_FALSE(step().sound);
  sound_->honk(now_);
  EXPECT_EQ(sound_->say(kHello, now_).lines.size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "audio"));
}

TEST_F(SoundscapeTest, MusicThatCannotBePlayedIsTold) {
  start(true, folder_ / "absent.ogg");
  sound_->drive(true);
  EXPECT_FALSE(step().sound);
  EXPECT_NE(sound_->fault().find("no music: "), std::string::npos) << sound_->fault();
}

}  // namespace
}  // namespace docent::interaction
