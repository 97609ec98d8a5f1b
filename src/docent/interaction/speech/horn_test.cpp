#include "docent/interaction/speech/horn.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "docent/base/files.h"
#include "docent/interaction/speech/renderer.h"

namespace docent::interaction {
namespace {

constexpr std::size_t kHead = 44;  // [bytes] before the samples

int sample(const HornSound& horn, std::size_t i) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(horn.content[kHead + at]); };
  return static_cast<std::int16_t>(byte(2 * i) | byte(2 * i + 1) << 8);
}
int loudest(const HornSound& horn) {
  int most = 0;
  for (std::size_t i = 0; i < (horn.content.size() - kHead) / 2; ++i) most = std::max(most, std::abs(sample(horn, i)));
  return most;
}

TEST(Horn, IsAWavFileThatBeginsAndEndsSoftly) {
  const auto folder = std::filesystem::temp_directory_path() / ("docent_horn_" + std::to_string(getpid()));
  const HornSound horn = horn_sound(1.0);
  ASSERT_TRUE(write_horn_sound(horn, folder / "audio"));
  ASSERT_TRUE(write_horn_sound(horn, folder / "audio")) << "writing it again changes nothing";
  const auto duration = wav_duration(folder / "audio" / horn.file);
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(duration) << duration.error().message;
  EXPECT_NEAR(*duration, horn.duration_s, 0.001);
  EXPECT_GT(loudest(horn), 8000);
  EXPECT_LT(loudest(horn), 17000) << "no louder than half of full scale";
  const std::size_t count = (horn.content.size() - kHead) / 2;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT(std::abs(sample(horn, i)), 700) << "a click at the beginning";
    EXPECT_LT(std::abs(sample(horn, count - 1 - i)), 700) << "a click at the end";
  }
}

TEST(Horn, ItsNameFollowsItsVolume) {
  EXPECT_EQ(horn_sound(0.5).file, horn_sound(0.5).file);
  EXPECT_EQ(horn_sound(0.52).file, horn_sound(0.5).file);
  EXPECT_NE(horn_sound(0.5).file, horn_sound(1.0).file);
  EXPECT_NEAR(loudest(horn_sound(0.5)), 0.5 * loudest(horn_sound(1.0)), 2.0);
  EXPECT_EQ(loudest(horn_sound(0.0)), 0);
  EXPECT_EQ(horn_sound(7.0).file, horn_sound(1.0).file);
}

TEST(Horn, NamesAFolderThatCannotBeWritten) {
  const auto written = write_horn_sound(horn_sound(1.0), "/proc/nowhere");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("/proc/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace docent::interaction
