#include "docent/planning/survey/survey_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "docent/base/files.h"

namespace docent::planning::survey_store_test {
namespace {

class SurveyStore : public ::testing::Test {
 protected:
  SurveyStore() { std::filesystem::create_directories(state); }
  ~SurveyStore() override { std::filesystem::remove_all(state); }

  std::filesystem::path state =
      std::filesystem::path{::testing::TempDir()} / ("docent_survey_store_" + std::to_string(getpid()));
  planning::SurveyStore store{state};
  localization::BeliefMode mode{{4.0, 5.0, Angle::degrees(30.0)}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.001}, 1.0};
  Time now = time_from_seconds(1000.0);
};

OccupancyGrid small_map() {
  OccupancyGrid map;
  map.frame = {3, 2, 0.05, {1.0, 2.0}};
  map.cells = {0, 100, -1, 0, 0, 100};
  return map;
}

TEST_F(SurveyStore, APlaceHoldsForAMinute) {
  EXPECT_FALSE(store.restored(now)) << "there is none yet";
  store.keep_place(mode, {1.0, 2.0, {}}, now);
  const auto restored = planning::SurveyStore{state}.restored(now + seconds(60.0));
  ASSERT_TRUE(restored);
  EXPECT_NEAR(restored->modes.front().map_from_robot.x, 4.0, 1e-9);
  EXPECT_NEAR(restored->odom_from_robot.y, 2.0, 1e-9);
  EXPECT_FALSE(store.restored(now + seconds(60.1))) << "it may have been put away";
  EXPECT_FALSE(store.restored(now - seconds(0.1))) << "of a clock that was set";
}

TEST_F(SurveyStore, APlaceInAnotherMapIsNone) {
  ASSERT_TRUE(localization::save_localizer_checkpoint({"00ff00ff00ff00ff", now, {}, {mode}}, state / "explore.yaml"));
  EXPECT_FALSE(store.restored(now));
}

TEST_F(SurveyStore, TheMapComesBackAndLocalizeGoesOnInIt) {
  store.keep_place(mode, {}, now);
  EXPECT_FALSE(std::filesystem::exists(state / "localize.yaml")) << "there is no map yet";
  const std::vector<Pose2> poses{{1.0, 2.0, {}}, {1.5, 2.0, {}}};
  const auto file = store.save(small_map(), poses);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(*file, (state / "explored" / "map.yaml").string());
  const auto map = load_map(*file);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->cells, small_map().cells);
  EXPECT_EQ(*read_file(state / "explored" / "poses.txt"),
            "# x y theta: m, m, rad\n1.000000 2.000000 0.000000\n1.500000 2.000000 0.000000\n");
  store.keep_place(mode, {}, now);
  const auto localizers = localization::load_localizer_checkpoint(state / "localize.yaml");
  ASSERT_TRUE(localizers) << localizers.error().message;
  EXPECT_EQ(localizers->map_hash, map_hash(*map));
}

TEST_F(SurveyStore, SaysWhatCannotBeWritten) {
  ASSERT_TRUE(write_file_atomically(state / "explored", "a file stands in the way"));
  const auto file = store.save(small_map(), {});
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().message.find("explored"), std::string::npos);
}

}  // namespace
}  // namespace docent::planning::survey_store_test
