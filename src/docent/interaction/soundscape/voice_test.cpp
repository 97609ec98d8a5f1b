#include "docent/interaction/soundscape/voice.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <future>

namespace docent::interaction {
namespace {

const SpokenLine kLine{"Hello.", "en", Mood::neutral};

LineRenderer renderer_with(const std::string& program) {
  return {program, 5.0, std::filesystem::temp_directory_path() / ("docent_voice_" + std::to_string(getpid())), {}};
}

TEST(LineVoice, WithoutAProgramAndRecordingsThereIsNone) {
  EXPECT_FALSE(PromptVoice{renderer_with("")}.can_render(kLine));
  EXPECT_FALSE((WorkerVoice{renderer_with(""), {}, false, [](const std::string&, const auto&) {}}.can_render(kLine)));
}

TEST(LineVoice, APromptOneAnswersAtOnce) {
  PromptVoice voice{renderer_with("docent-no-such-program")};
  ASSERT_TRUE(voice.can_render(kLine));
  const auto speech = voice.render("id", kLine);
  ASSERT_TRUE(speech);
  EXPECT_FALSE(*speech) << "there is no such program";
}

TEST(LineVoice, AWorkerAnswersLaterAndNamesTheLine) {
  std::promise<std::string> told;
  WorkerVoice voice{renderer_with("docent-no-such-program"), {}, false, [&](const std::string& id, const auto& speech) {
                      EXPECT_FALSE(speech);
                      told.set_value(id);
                    }};
  ASSERT_TRUE(voice.can_render(kLine));
  EXPECT_FALSE(voice.render("id-7", kLine));
  EXPECT_EQ(told.get_future().get(), "id-7");
}

}  // namespace
}  // namespace docent::interaction
