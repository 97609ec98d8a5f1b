#include "docent/interaction/sound/sound_card.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "docent/base/files.h"

namespace docent::interaction::sound_card_test {
namespace {

bool waited_for(const std::function<bool()>& what) {
  for (int i = 0; i < 1000; ++i) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
  return what();
}

TEST(SoundCard, AMissingOneIsNamed) {
  const auto card = SoundCard::open("hw:77", [](std::span<std::int16_t>) {});
  ASSERT_FALSE(card);
  EXPECT_NE(card.error().message.find("hw:77"), std::string::npos);
}

// ALSA's own plug-ins stand for a card: what is played goes into a file.
TEST(SoundCard, PlaysWhatItIsGiven) {
  const auto file = std::filesystem::temp_directory_path() / ("docent_card_" + std::to_string(getpid()) + ".raw");
  std::atomic<int> samples{0};
  {
    const auto card = SoundCard::open("tee:null," + file.string() + ",raw", [&](std::span<std::int16_t> out) {
      for (std::int16_t& sample : out) sample = static_cast<std::int16_t>(++samples % 1000);
    });
    ASSERT_TRUE(card) << card.error().message;
    EXPECT_TRUE(waited_for([&] { return samples > 10'000; })) << "it asks for samples";
    EXPECT_EQ((*card)->fault(), "");
  }
  const std::string bytes = read_file(file).value_or("");
  std::filesystem::remove(file);
  ASSERT_GT(bytes.size(), 10'000U);
  int expected = 0;
  for (std::size_t i = 0; i + 1 < 10'000; i += 2) {
    const int sample = static_cast<unsigned char>(bytes[i]) | static_cast<unsigned char>(bytes[i + 1]) << 8;
    ASSERT_EQ(sample, ++expected % 1000) << i;
  }
}

TEST(SoundCard, EndsAtOnce) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) {
    const auto card = SoundCard::open("null", [](std::span<std::int16_t>) {});
    ASSERT_TRUE(card) << card.error().message;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{2});
}

}  // namespace
}  // namespace docent::interaction::sound_card_test
