#include "docent/interaction/voice/voice_recognizer.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <filesystem>

#include "docent/base/random.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/child_process.h"

namespace docent::interaction {
namespace {

museum::Museum museum_that_listens() {
  museum::Museum museum;
  museum.languages = {"en"};
  for (const auto& [id, title] : {std::pair{"zuse", "Zuse's computer"}, std::pair{"airbus", "The wing of the Airbus"},
                                  std::pair{"zeolite", "The zeolite"}}) {
    museum.exhibits.emplace_back();
    museum.exhibits.back().id = id;
    museum.exhibits.back().title = {{"en", title}};
  }
  museum.tours = {{"small", {{"en", "Very small things"}}, {"zuse"}, {}, {}}};
  return museum;
}

class Voices : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("docent-voices-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    auto made = VoiceRecognizer::create(VoiceGrammar{museum_that_listens(), true});
    ASSERT_TRUE(made) << made.error().message;
    recognizer_ = std::make_unique<VoiceRecognizer>(std::move(*made));
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  HeardVoice heard(const std::string& voice, const std::string& text, double noise = 0.001) {
    const auto file = folder_ / "said.wav";
    const auto child = start_quietly({"espeak-ng", "-v", voice, "-s", "150", "-w", file.string(), "--", text});
    if (!child || waitpid(*child, nullptr, 0) < 0) throw std::runtime_error{"espeak-ng does not run"};
    Clip clip = read_clip(file).value();
    clip.insert(clip.begin(), kSampleRate / 3, 0.0F);
    clip.resize(clip.size() + kSampleRate / 3, 0.0F);
    Rng rng{1};
    for (float& sample : clip) sample += static_cast<float>(rng.normal(0.0, noise));
    return recognizer_->hear(clip).value();
  }
  std::filesystem::path folder_;
  std::unique_ptr<VoiceRecognizer> recognizer_;
};

TEST_F(Voices, CommandsAreUnderstood) {
  using Kind = VoiceCommand::Kind;
  for (const std::string voice : {"en-us", "en-gb"}) {
    EXPECT_EQ(heard(voice, "please take me to Zuse's computer").command, (VoiceCommand{Kind::exhibit, "zuse"}));
    EXPECT_EQ(heard(voice, "show me the zeolite").command, (VoiceCommand{Kind::exhibit, "zeolite"}));
    EXPECT_EQ(heard(voice, "start the tour very small things").command, (VoiceCommand{Kind::tour, "small"}));
    const HeardVoice more = heard(voice, "tell me more");
    EXPECT_EQ(more.command, (VoiceCommand{Kind::more, ""}));
    EXPECT_NE(more.verdict, HeardVoice::Verdict::nothing) << more.confidence;
  }
  const HeardVoice wing = heard("en-us", "drive to the wing of the Airbus");
  EXPECT_EQ(wing.verdict, HeardVoice::Verdict::understood) << wing.confidence;
  EXPECT_EQ(wing.words, "drive to the wing of the airbus");
}

TEST_F(Voices, WhatIsNoCommandIsNotActedUpon) {
  for (const std::string said : {"where is the bathroom", "the weather is wonderful today", "mum I am hungry"}) {
    const HeardVoice voice = heard("en-us", said);
    EXPECT_NE(voice.verdict, HeardVoice::Verdict::understood) << said << ": " << voice.words << voice.confidence;
  }
}

TEST_F(Voices, SilenceNoiseAndTooMuchAreNothing) {
  EXPECT_EQ(recognizer_->hear(Clip(kSampleRate, 0.0F)).value().verdict, HeardVoice::Verdict::nothing);
  EXPECT_EQ(recognizer_->hear({}).value().verdict, HeardVoice::Verdict::nothing);
  EXPECT_EQ(recognizer_->hear(Clip(std::size_t{60} * kSampleRate, 0.1F)).value().verdict, HeardVoice::Verdict::nothing);
  Clip noise(std::size_t{2} * kSampleRate);
  Rng rng{2};
  for (float& sample : noise) sample = static_cast<float>(rng.normal(0.0, 0.2));
  EXPECT_EQ(recognizer_->hear(noise).value().verdict, HeardVoice::Verdict::nothing);
}

TEST(VoiceRecognizer, SaysWhatIsNotInstalled) {
  VoiceParams params;
  params.model = "/nowhere";
  const auto made = VoiceRecognizer::create(VoiceGrammar{museum_that_listens(), true}, params);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("install pocketsphinx-en-us"), std::string::npos);
}

}  // namespace
}  // namespace docent::interaction
