#include "docent/interaction/soundscape/background_music.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "docent/base/files.h"
#include "docent/interaction/sound/levels_for_test.h"
#include "docent/interaction/sound/sound_file.h"

namespace docent::interaction {
namespace {

class BackgroundMusicTest : public testing::Test {
 protected:
  BackgroundMusicTest()
      : folder_{std::filesystem::temp_directory_path() / ("docent_music_" + std::to_string(getpid()))} {
    std::filesystem::create_directories(folder_);
  }
  ~BackgroundMusicTest() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(BackgroundMusicTest, InVirtualTimeItPlaysAtOnce) {
  BackgroundMusic music{std::nullopt, folder_ / "audio", true};
  EXPECT_FALSE(music.play(false, time_from_seconds(1.0)));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "audio")) << "nobody wants music yet";
  EXPECT_TRUE(music.play(true, time_from_seconds(2.0)));
  EXPECT_TRUE(music.is_playing());
  EXPECT_EQ(music.start(), time_from_seconds(2.0));
  EXPECT_FALSE(music.play(true, time_from_seconds(3.0))) << "it plays already";
  EXPECT_EQ(music.start(), time_from_seconds(2.0));
  EXPECT_NEAR(sound_duration(folder_ / "audio" / music.file()).value_or(0.0), duration_s(*music.clip()), 1e-3);
  EXPECT_TRUE(music.play(false, time_from_seconds(4.0)));
  EXPECT_FALSE(music.is_playing());
}

TEST_F(BackgroundMusicTest, InWallTimeNobodyWaitsForIt) {
  BackgroundMusic music{std::nullopt, folder_ / "audio", false};
  bool has_begun = false;
  for (int i = 0; i < 2000 && !has_begun; ++i) {
    has_begun = music.play(true, time_from_seconds(i));
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
  EXPECT_TRUE(has_begun);
  EXPECT_TRUE(music.is_playing());
}

TEST_F(BackgroundMusicTest, TheMuseumsOwnMusicPlays) {
  const SharedSound tune = shared_sound(sine(1000.0, -20.0, 1.0));
  ASSERT_TRUE(write_file_atomically(folder_ / "tune.wav", tune.content));
  BackgroundMusic music{folder_ / "tune.wav", folder_ / "audio", true};
  EXPECT_TRUE(music.play(true, {}));
  EXPECT_EQ(music.file(), tune.file);
  EXPECT_NEAR(music.loudness_db(), -20.0, 0.1);
  EXPECT_EQ(music.fault(), "");
}

TEST_F(BackgroundMusicTest, WhatCannotBePlayedIsNamed) {
  BackgroundMusic music{folder_ / "absent.ogg", folder_ / "audio", true};
  EXPECT_FALSE(music.play(true, {}));
  EXPECT_FALSE(music.is_playing());
  EXPECT_NE(music.fault().find("absent.ogg"), std::string::npos);
  EXPECT_FALSE(music.play(false, {}));
}

}  // namespace
}  // namespace docent::interaction
