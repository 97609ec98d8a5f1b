#include "docent/interaction/speech/loudspeaker.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "docent/base/files.h"

namespace docent::interaction {
namespace {

/// A program that notes what it plays, plays for half a minute, and would note that it came to the end.
class LoudspeakerTest : public testing::Test {
 protected:
  LoudspeakerTest() : folder_{std::filesystem::temp_directory_path() / ("docent_loud_" + std::to_string(getpid()))} {
    std::filesystem::create_directories(folder_);
    const std::string notes = (folder_ / "notes").string();
    EXPECT_TRUE(write_file_atomically(folder_ / "player", "#!/bin/sh\necho $1 >> " + notes + "\nexec sleep 30\n"));
    std::filesystem::permissions(folder_ / "player", std::filesystem::perms::owner_all);
  }
  ~LoudspeakerTest() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] std::string program() const { return (folder_ / "player").string(); }
  /// What was played so far, once it is `expected` or a second has passed.
  [[nodiscard]] std::string played(const std::string& expected) const {
    std::string text;
    for (int i = 0; i < 200 && text != expected; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds{5});
      text = read_file(folder_ / "notes").value_or("");
    }
    return text;
  }
  std::filesystem::path folder_;
};

TEST_F(LoudspeakerTest, ALineReplacesTheOneBeforeAndTheHornSoundsBeside) {
  const auto begin = std::chrono::steady_clock::now();
  {
    Loudspeaker loudspeaker{program()};
    ASSERT_TRUE(loudspeaker.speak("one.wav"));
    EXPECT_EQ(played("one.wav\n"), "one.wav\n");
    ASSERT_TRUE(loudspeaker.honk("horn.wav"));
    ASSERT_TRUE(loudspeaker.honk("horn.wav")) << "it sounds already";
    EXPECT_EQ(played("one.wav\nhorn.wav\n"), "one.wav\nhorn.wav\n");
    ASSERT_TRUE(loudspeaker.speak("two.wav"));
    EXPECT_EQ(played("one.wav\nhorn.wav\ntwo.wav\n"), "one.wav\nhorn.wav\ntwo.wav\n");
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{5}) << "nothing is waited for";
}

TEST_F(LoudspeakerTest, WithoutAProgramItIsSilentAndAMissingOneIsNamed) {
  Loudspeaker silent{""};
  EXPECT_TRUE(silent.speak("one.wav"));
  EXPECT_TRUE(silent.honk("horn.wav"));
  Loudspeaker missing{"/nonexistent/player"};
  const auto result = missing.honk("horn.wav");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("/nonexistent/player"), std::string::npos);
}

}  // namespace
}  // namespace docent::interaction
