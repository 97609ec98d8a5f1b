#include "docent/interaction/speech/render_worker.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

#include "docent/base/files.h"
#include "docent/interaction/sound/sound_file.h"

namespace docent::interaction::render_worker_test {
namespace {

class RenderWorkerTest : public testing::Test {
 protected:
  RenderWorkerTest() : folder_{std::filesystem::temp_directory_path() / ("docent_worker_" + std::to_string(getpid()))} {
    std::filesystem::create_directories(folder_);
  }
  ~RenderWorkerTest() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] LineRenderer renderer(const std::string& program) const {
    return {program, 20.0, folder_ / "audio", {}};
  }
  [[nodiscard]] std::string script(const std::string& body) const {
    EXPECT_TRUE(write_file_atomically(folder_ / "voice", "#!/bin/sh\n" + body + "\n"));
    std::filesystem::permissions(folder_ / "voice", std::filesystem::perms::owner_all);
    return folder_ / "voice";
  }
  RenderWorker::Done note() {
    return [this](std::string id, Result<RenderedSpeech> speech) {
      const std::scoped_lock lock{mutex_};
      done_.emplace_back(std::move(id), std::move(speech));
    };
  }
  bool wait(const std::function<bool()>& what) {
    for (int i = 0; i < 2000; ++i) {
      {
        const std::scoped_lock lock{mutex_};
        if (what()) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    return false;
  }
  [[nodiscard]] bool is_rendered(const SpokenLine& line) const {
    return std::filesystem::exists(folder_ / "audio" / audio_file_name(line));
  }

  std::filesystem::path folder_;
  std::mutex mutex_;
  std::vector<std::pair<std::string, Result<RenderedSpeech>>> done_;
};

const SpokenLine kHello{"Hello.", "en", Mood::happy};
const SpokenLine kBye{"Goodbye.", "en", Mood::sad};

TEST_F(RenderWorkerTest, RendersWhatIsOrderedWithItsClip) {
  RenderWorker worker{renderer("espeak-ng"), {}, true, note()};
  worker.render("one", kHello);
  ASSERT_TRUE(wait([&] { return !done_.empty(); }));
  EXPECT_EQ(done_[0].first, "one");
  ASSERT_TRUE(done_[0].second) << done_[0].second.error().message;
  ASSERT_NE(done_[0].second->clip, nullptr);
  EXPECT_NEAR(duration_s(*done_[0].second->clip), done_[0].second->line.duration_s, 0.01);
  EXPECT_GT(loudness_db(*done_[0].second->clip), -40.0);
}

TEST_F(RenderWorkerTest, RendersAheadWhileNothingIsOrdered) {
  RenderWorker worker{renderer("espeak-ng"), {{"a", kHello}, {"b", kBye}}, false, note()};
  EXPECT_TRUE(wait([&] { return is_rendered(kHello) && is_rendered(kBye); }));
  EXPECT_TRUE(done_.empty()) << "nobody waits for these";
}

TEST_F(RenderWorkerTest, AnOrderDoesNotWaitForWhatIsRenderedAhead) {
  // The voice needs half a minute for everything but the order.
  const auto voice =
      script("grep -q Goodbye - && exec espeak-ng \"$@\" < " + (folder_ / "bye").string() + "\nexec sleep 30");
  ASSERT_TRUE(write_file_atomically(folder_ / "bye", "Goodbye."));
  RenderWorker worker{renderer(voice), {{"a", kHello}}, false, note()};
  std::this_thread::sleep_for(std::chrono::milliseconds{100});
  const auto begin = std::chrono::steady_clock::now();
  worker.render("bye", kBye);
  ASSERT_TRUE(wait([&] { return !done_.empty(); }));
  EXPECT_EQ(done_[0].first, "bye");
  EXPECT_TRUE(done_[0].second) << done_[0].second.error().message;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{5});
}

TEST_F(RenderWorkerTest, SaysOnceWhyItRendersAheadNoLonger) {
  RenderWorker worker{renderer("/nonexistent/voice"), {{"a", kHello}, {"b", kBye}}, false, note()};
  ASSERT_TRUE(wait([&] { return !done_.empty(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds{50});
  ASSERT_EQ(done_.size(), 1U);
  EXPECT_EQ(done_[0].first, "");
  ASSERT_FALSE(done_[0].second);
  EXPECT_NE(done_[0].second.error().message.find("/nonexistent/voice"), std::string::npos);
}

TEST_F(RenderWorkerTest, ARecordingIsHeardInsteadOfTheVoice) {
  const auto recording = folder_ / "museum/content/audio/en/hello.happy.1.wav";
  std::filesystem::create_directories(recording.parent_path());
  const SharedSound sound = shared_sound(Clip(kSampleRate / 2, 0.25F));
  ASSERT_TRUE(write_file_atomically(recording, sound.content));
  const Recordings recordings{folder_ / "museum", {{"hello.happy.1", kHello}}};
  const LineRenderer without_voice{"", 20.0, folder_ / "audio", recordings};
  const std::atomic<bool> go_on{false};
  ASSERT_TRUE(without_voice.can_render(kHello));
  EXPECT_FALSE(without_voice.can_render(kBye));
  const auto speech = without_voice.render(kHello, true, go_on);
  ASSERT_TRUE(speech) << speech.error().message;
  EXPECT_EQ(speech->line.file, sound.file);
  EXPECT_DOUBLE_EQ(speech->line.duration_s, 0.5);
  EXPECT_EQ(speech->fault, "");

  ASSERT_TRUE(write_file_atomically(recording, "this is no sound at all"));
  const LineRenderer with_voice{"espeak-ng", 20.0, folder_ / "audio", recordings};
  const auto spoken = with_voice.render(kHello, false, go_on);
  ASSERT_TRUE(spoken) << spoken.error().message;
  EXPECT_EQ(spoken->line.file, audio_file_name(kHello)) << "the voice speaks instead";
  EXPECT_NE(spoken->fault.find("hello.happy.1.wav"), std::string::npos);
  EXPECT_EQ(spoken->clip, nullptr);
}

TEST_F(RenderWorkerTest, EndsAtOnce) {
  const auto begin = std::chrono::steady_clock::now();
  {
    RenderWorker worker{renderer(script("exec sleep 30")), {{"a", kHello}}, false, note()};
    worker.render("one", kBye);
    std::this_thread::sleep_for(std::chrono::milliseconds{50});
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{2});
}

}  // namespace
}  // namespace docent::interaction::render_worker_test
