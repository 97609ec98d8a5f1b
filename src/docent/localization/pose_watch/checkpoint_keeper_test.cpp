#include "docent/localization/pose_watch/checkpoint_keeper.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace docent::localization::checkpoint_keeper_test {
namespace {

class CheckpointKeeper : public ::testing::Test {
 protected:
  ~CheckpointKeeper() override { std::filesystem::remove(path); }

  std::filesystem::path path =
      std::filesystem::path{::testing::TempDir()} / ("docent_keeper_" + std::to_string(getpid()) + ".yaml");
  localization::CheckpointKeeper keeper{path, "abc"};
  std::vector<BeliefMode> modes{{{4.0, 5.0, {}}, {}, 1.0}};
  Time now = time_from_seconds(1000.0);
};

TEST_F(CheckpointKeeper, WritesOnceASecond) {
  keeper.keep(now, {1.0, 2.0, {}}, modes, now);
  keeper.keep(now + seconds(0.9), {9.0, 2.0, {}}, modes, now + seconds(0.9));
  const auto first = load_localizer_checkpoint(path);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(first->map_hash, "abc");
  EXPECT_EQ(first->time, now);
  EXPECT_EQ(first->odom_from_robot.x, 1.0);
  keeper.keep(now + seconds(0.95), {3.0, 2.0, {}}, modes, now + seconds(1.0));
  EXPECT_EQ(load_localizer_checkpoint(path)->odom_from_robot.x, 3.0);
  EXPECT_EQ(load_localizer_checkpoint(path)->time, now + seconds(0.95)) << "of the scan";
}

TEST_F(CheckpointKeeper, RestoresWhatIsOfThisMapAndOfTheLastMinute) {
  EXPECT_FALSE(keeper.restore(now));
  keeper.keep(now, {}, modes, now);
  const auto restored = localization::CheckpointKeeper(path, "abc").restore(now + seconds(59.0));
  ASSERT_TRUE(restored);
  EXPECT_EQ(restored->modes.front().map_from_robot.y, 5.0);
  EXPECT_FALSE(localization::CheckpointKeeper(path, "abc").restore(now + seconds(61.0)));
  EXPECT_FALSE(localization::CheckpointKeeper(path, "other").restore(now));
  EXPECT_TRUE(localization::CheckpointKeeper(path, "abc").restore(now - seconds(0.2)))
      << "the scanner's clock is ahead";
  EXPECT_FALSE(localization::CheckpointKeeper(path, "abc").restore(now - seconds(0.3)));
}

TEST_F(CheckpointKeeper, OdometryContradictsOnceAndOnlyWhatWasRestored) {
  EXPECT_FALSE(keeper.is_contradicted_by({100.0, 0.0, {}})) << "nothing was restored";
  keeper.keep(now, {1.0, 2.0, {}}, modes, now);
  ASSERT_TRUE(keeper.restore(now));
  EXPECT_FALSE(keeper.is_contradicted_by({5.9, 2.0, {}})) << "it may have driven on";
  EXPECT_FALSE(keeper.is_contradicted_by({100.0, 2.0, {}})) << "the first word decides";
  ASSERT_TRUE(keeper.restore(now));
  EXPECT_TRUE(keeper.is_contradicted_by({6.1, 2.0, {}}));
  ASSERT_TRUE(keeper.restore(now));
  keeper.forget_restored();
  EXPECT_FALSE(keeper.is_contradicted_by({6.1, 2.0, {}}));
}

}  // namespace
}  // namespace docent::localization::checkpoint_keeper_test
