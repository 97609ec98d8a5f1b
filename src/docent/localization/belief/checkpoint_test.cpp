#include "docent/localization/belief/checkpoint.h"

#include <gtest/gtest.h>

#include "docent/base/files.h"

namespace docent::localization {
namespace {

TEST(Checkpoint, ComesBackAsItWas) {
  const auto path = std::filesystem::path{::testing::TempDir()} / "docent_checkpoint_test.yaml";
  LocalizerCheckpoint checkpoint{"00ff00ff00ff00ff", Time{1234567890123456789}, {1.5, -2.25, Angle::degrees(30)}, {}};
  checkpoint.modes.push_back({{3.0, 4.0, Angle::degrees(-90)}, {0.01, 0, 0, 0, 0.02, 0, 0, 0, 0.003}, 0.875});
  ASSERT_TRUE(save_localizer_checkpoint(checkpoint, path).has_value());
  const auto loaded = load_localizer_checkpoint(path);
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  EXPECT_EQ(loaded->map_hash, checkpoint.map_hash);
  EXPECT_EQ(loaded->time, checkpoint.time);
  EXPECT_NEAR(loaded->odom_from_robot.y, -2.25, 1e-9);
  ASSERT_EQ(loaded->modes.size(), 1U);
  EXPECT_NEAR(loaded->modes[0].map_from_robot.theta.degrees(), -90.0, 1e-6);
  EXPECT_NEAR(loaded->modes[0].covariance[4], 0.02, 1e-9);
  EXPECT_NEAR(loaded->modes[0].mass, 0.875, 1e-6);
  std::filesystem::remove(path);
}

TEST(Checkpoint, TellsNothingOfAnotherMapOrAnotherTime) {
  const auto path = std::filesystem::path{::testing::TempDir()} / "docent_checkpoint_recent.yaml";
  EXPECT_FALSE(recent_checkpoint(path, "a", Time{}));
  const Time then = time_from_seconds(1000.0);
  ASSERT_TRUE(save_localizer_checkpoint({"a", then, {}, {{{1.0, 2.0, {}}, {}, 1.0}}}, path));
  ASSERT_TRUE(recent_checkpoint(path, "a", then));
  EXPECT_EQ(recent_checkpoint(path, "a", then + kCheckpointAge)->modes.front().map_from_robot.y, 2.0);
  EXPECT_FALSE(recent_checkpoint(path, "b", then));
  EXPECT_FALSE(recent_checkpoint(path, "a", then + kCheckpointAge + seconds(0.001)));
  EXPECT_FALSE(recent_checkpoint(path, "a", then - seconds(0.2)));
  EXPECT_TRUE(recent_checkpoint(path, "a", then - seconds(0.2), seconds(0.25)));
  EXPECT_FALSE(recent_checkpoint(path, "a", then - seconds(0.3), seconds(0.25)));
  std::filesystem::remove(path);
}

TEST(Checkpoint, RefusesWhatIsDamaged) {
  const auto path = std::filesystem::path{::testing::TempDir()} / "docent_checkpoint_broken.yaml";
  EXPECT_FALSE(load_localizer_checkpoint(path).has_value());
  for (const char* text :
       {"", "map_hash: x\n", "modes: [1, 2", "odometry: [1, 2, 3]\nmodes: [{pose: [1]}]\n",
        "odometry: [1, 2, 3]\nmodes: [{pose: [1, 2, 3], covariance: [1,0,0,0,1,0,0,0,1], mass: 7}]\n"}) {
    ASSERT_TRUE(write_file_atomically(path, text).has_value());
    EXPECT_FALSE(load_localizer_checkpoint(path).has_value()) << text;
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace docent::localization
