#include "docent/interaction/attract/trial_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace docent::interaction {
namespace {

AttractionTrial trial_of(double reward) {
  return {time_from_seconds(12.5),
          0.08,
          {GazeStrategy::nearest, Mood::happy, SpeechAct::ask},
          {0.5, 0.25, 0.125, 0.0625, 0.0625},
          reward};
}

class TrialMemoryFile : public testing::Test {
 protected:
  ~TrialMemoryFile() override { std::filesystem::remove(path); }
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("docent_trials_" + std::to_string(getpid()) + ".json");
};

TEST_F(TrialMemoryFile, WhatWasWrittenComesBack) {
  const auto none = load_trials(path);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty()) << "there is no file yet";
  const TrialMemory trials{trial_of(0.1 + 0.2), trial_of(-1.5)};
  ASSERT_TRUE(save_trials(path, trials));
  const auto read = load_trials(path);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ((*read)[0].reward, 0.1 + 0.2) << "to the last bit";
  EXPECT_EQ((*read)[1].reward, -1.5);
  EXPECT_EQ((*read)[0].begin, time_from_seconds(12.5));
  EXPECT_EQ((*read)[0].density, 0.08);
  EXPECT_EQ((*read)[0].action, trial_of(0.0).action);
  EXPECT_EQ((*read)[0].chances, trial_of(0.0).chances);
}

TEST_F(TrialMemoryFile, AnEmptyMemoryIsAFileToo) {
  ASSERT_TRUE(save_trials(path, {}));
  const auto read = load_trials(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->empty());
}

TEST_F(TrialMemoryFile, ADamagedFileIsNamed) {
  ASSERT_TRUE(save_trials(path, {trial_of(1.0), trial_of(2.0)}));
  const std::string good = read_file(path).value();
  for (const std::size_t length : {good.size() / 2, good.size() - 4, std::size_t{0}})
    EXPECT_FALSE(parse_trials(good.substr(0, length), "m.json")) << length;
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    const auto at = text.rfind(before);
    EXPECT_NE(at, std::string::npos) << before;
    text.replace(at, before.size(), after);
    return parse_trials(text, "m.json");
  };
  ASSERT_TRUE(with("0.25,", "0.25,")) << with("0.25,", "0.25,").error().message;
  for (const auto& [before, after] :
       std::vector<std::pair<std::string, std::string>>{{"\"ask\"", "\"sing\""},
                                                        {"0.25,", "0.26,"},
                                                        {"0.25,", "-0.25,"},
                                                        {"[0.5,0.25,", "[0.75,"},
                                                        {"\"reward\":2.0", "\"reward\":1e300"},
                                                        {"\"density\":0.08", "\"density\":-1"},
                                                        {"\"density\":0.08", "\"density\":null"},
                                                        {"\"face\":\"happy\"", "\"face\":1"}}) {
    const auto read = with(before, after);
    ASSERT_FALSE(read) << after;
    EXPECT_TRUE(read.error().message.starts_with("m.json: ")) << read.error().message;
  }
}

TEST_F(TrialMemoryFile, AStyleThatHadNoChanceIsRefused) {
  AttractionTrial impossible = trial_of(1.0);
  impossible.chances = {0.0, 0.75, 0.125, 0.0625, 0.0625};
  ASSERT_TRUE(save_trials(path, {impossible}));
  const auto read = load_trials(path);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("trial 1: the style had no chance"), std::string::npos) << read.error().message;
}

}  // namespace
}  // namespace docent::interaction
