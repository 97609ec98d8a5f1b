#include "docent/interaction/speech/renderer.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "docent/base/files.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::interaction::renderer_test {
namespace {

class Renderer : public testing::Test {
 protected:
  Renderer() : folder_{std::filesystem::temp_directory_path() / ("docent_speech_" + std::to_string(getpid()))} {
    std::filesystem::create_directories(folder_);
  }
  ~Renderer() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::size_t count_files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator{folder_}, {}));
  }
  [[nodiscard]] std::string script(const std::string& name, const std::string& body) const {
    const auto path = folder_ / name;
    EXPECT_TRUE(write_file_atomically(path, "#!/bin/sh\n" + body + "\n"));
    chmod(path.c_str(), 0755);
    return path;
  }

  std::filesystem::path folder_;
  std::atomic<bool> stop_{false};
};

const std::string kEnglish =
    "This is the Cyclotron. Charged particles are accelerated on a spiral path, again and again, until they reach very "
    "high energies. Physicists then shoot them at a target, and look at what comes out.";
const std::string kGerman =
    "Sputnik war der erste künstliche Satellit der Erde. Die Sowjetunion startete ihn im Oktober, und er sendete drei "
    "Wochen lang Funksignale. Menschen auf der ganzen Welt hörten sein Piepen.";

TEST_F(Renderer, SpeaksAndTheModelForetellsTheDuration) {
  for (const auto& [language, text] : {std::pair{"en", kEnglish}, std::pair{"de", kGerman}}) {
    for (const Mood mood : {Mood::neutral, Mood::happy, Mood::sad, Mood::angry}) {
      const auto line = render_speech({text, language, mood}, folder_, "espeak-ng", 20.0, stop_);
      ASSERT_TRUE(line) << line.error().message;
      EXPECT_NEAR(line->duration_s / speech_duration(text, language, mood), 1.0, 0.15)
          << language << ' ' << to_text(mood);
      EXPECT_EQ(*sound_duration(folder_ / line->file), line->duration_s);
    }
  }
  EXPECT_EQ(count_files(), 8U) << "no half file may stay behind";
}

TEST_F(Renderer, DoesNotSpeakTheSameTwice) {
  const SpokenLine line{kEnglish, "en", Mood::neutral};
  ASSERT_TRUE(render_speech(line, folder_, "espeak-ng", 20.0, stop_));
  EXPECT_TRUE(render_speech(line, folder_, "/nonexistent/espeak", 20.0, stop_)) << "it lies there already";
}

TEST_F(Renderer, NamesDependOnAllThatIsHeard) {
  const SpokenLine line{kEnglish, "en", Mood::neutral};
  const std::string name = audio_file_name(line);
  EXPECT_EQ(audio_file_name(line), name);
  EXPECT_NE(audio_file_name({kGerman, "en", Mood::neutral}), name);
  EXPECT_NE(audio_file_name({kEnglish, "de", Mood::neutral}), name);
  EXPECT_NE(audio_file_name({kEnglish, "en", Mood::sad}), name);
}

TEST_F(Renderer, SaysWhatIsWrong) {
  const SpokenLine line{"Hello.", "en", Mood::neutral};
  EXPECT_FALSE(render_speech(line, folder_, "/nonexistent/espeak", 5.0, stop_));
  EXPECT_FALSE(render_speech({"Hello.", "-w/tmp/x", Mood::neutral}, folder_, "espeak-ng", 5.0, stop_));
  const auto silent = render_speech(line, folder_, script("silent", "exit 0"), 5.0, stop_);
  EXPECT_FALSE(silent) << "an exit status of 0 without a file is a failure";
  const auto failing = render_speech(line, folder_, script("failing", "exit 3"), 5.0, stop_);
  ASSERT_FALSE(failing);
  EXPECT_NE(failing.error().message.find("status 3"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / audio_file_name(line)));
}

TEST_F(Renderer, DoesNotWaitForEver) {
  const auto begin = std::chrono::steady_clock::now();
  const auto slow =
      render_speech({"Hello.", "en", Mood::neutral}, folder_, script("slow", "exec sleep 30"), 0.2, stop_);
  ASSERT_FALSE(slow);
  EXPECT_NE(slow.error().message.find("too long"), std::string::npos);
  stop_ = true;
  EXPECT_FALSE(render_speech({"Hello.", "en", Mood::neutral}, folder_, script("slow", "exec sleep 30"), 30.0, stop_));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(Renderer, SpeaksADamagedFileAnew) {
  const SpokenLine line{"Hello.", "en", Mood::neutral};
  const auto first = render_speech(line, folder_, "espeak-ng", 20.0, stop_);
  ASSERT_TRUE(first) << first.error().message;
  ASSERT_TRUE(write_file_atomically(folder_ / first->file, "this is no sound at all"));
  const auto again = render_speech(line, folder_, "espeak-ng", 20.0, stop_);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->duration_s, first->duration_s);
  EXPECT_TRUE(sound_duration(folder_ / again->file));
}

TEST_F(Renderer, TakesARecordingAsItIs) {
  const SharedSound sound = shared_sound(Clip(kSampleRate, 0.25F));
  ASSERT_TRUE(write_file_atomically(folder_ / "trap.short.WAV", sound.content));
  const auto line = take_recording(folder_ / "trap.short.WAV", folder_ / "audio");
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_EQ(line->file, sound.file) << "it is named by its content";
  EXPECT_DOUBLE_EQ(line->duration_s, 1.0);
  EXPECT_EQ(read_file(folder_ / "audio" / line->file).value_or(""), sound.content);
  EXPECT_TRUE(take_recording(folder_ / "trap.short.WAV", folder_ / "audio")) << "it lies there already";
  ASSERT_TRUE(write_file_atomically(folder_ / "text.ogg", "this is no sound at all"));
  for (const char* name : {"absent.wav", "text.ogg"}) {
    const auto refused = take_recording(folder_ / name, folder_ / "audio");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace docent::interaction::renderer_test
