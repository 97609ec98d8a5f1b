#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "docent/apps/localize/localize_log.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/modules/host/registry.h"
#include "docent/recording/laser_log.h"
#include "hostile_recording.h"
#include "module_stage.h"

// Whatever decodes may come in; what cannot be is refused there and named, and nothing behind it crashes, hangs or says
// what cannot be.

namespace docent {
namespace {

class Hostile : public ::testing::Test {
 protected:
  Hostile() : folder_{std::filesystem::temp_directory_path() / ("docent-hostile-" + std::to_string(::getpid()))} {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Hostile() override { std::filesystem::remove_all(folder_); }
  Hostile(const Hostile&) = delete;
  Hostile& operator=(const Hostile&) = delete;
  std::filesystem::path folder_;
};

TEST_F(Hostile, RecordingsAreReadAndLocalizedInBoundedTime) {
  constexpr std::uint64_t kSeeds = 40;
  write_room_map(folder_);
  const auto map = load_map(folder_ / "room.yaml");
  ASSERT_TRUE(map) << map.error().message;
  localization::MarkovLocalizer localizer{*map, {}, {}, 1};
  std::size_t refused = 0, noted = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const auto path = folder_ / (seed % 2 == 0 ? "drive.mcap" : "drive.db3");
    (seed % 2 == 0 ? write_mcap : write_rosbag2)(path, hostile_drive(seed));
    const auto log = recording::read_laser_log(path, {.with_sonars = true});
    if (!log) {
      ++refused;
      EXPECT_EQ(
          log.error().message.rfind(path.string() + ": holds no laser scan (sensor_msgs/LaserScan) that is fit", 0), 0U)
          << log.error().message;
      continue;
    }
    if (seed == 0) {
      EXPECT_TRUE(log->notes.empty()) << log->notes.front();
      EXPECT_EQ(log->scans.size(), 60U);
      EXPECT_EQ(log->pings.size(), 240U);
    }
    for (const std::string& note : log->notes) noted += note.find("were left out") != std::string::npos ? 1 : 0;
    for (const recording::LoggedScan& scan : log->scans) {
      ASSERT_LE(std::abs(scan.odom_from_base.x), 2e7);
      ASSERT_LE(norm(scan.base_from_laser.position()), 20.0);
    }
    for (const bool reverse : {false, true}) {
      localizer.start_unknown();
      apps::localize_command::LogRunOptions options;
      options.reverse = reverse;
      const auto begin = std::chrono::steady_clock::now();
      const apps::localize_command::LogRun run = apps::localize_command::localize_log(*log, localizer, options);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{20});
      for (const apps::localize_command::LoggedPose& pose : run.poses) {
        if (!pose.has_pose) continue;
        ASSERT_TRUE(std::isfinite(pose.map_from_base.x) && std::isfinite(pose.map_from_base.theta.radians()));
      }
    }
  }
  EXPECT_GT(refused, 2U);
  EXPECT_GT(noted, 10U);
}

class HostileModule : public ::testing::TestWithParam<const char*> {};

TEST_P(HostileModule, OutlivesWhateverComesAndSaysOnlyWhatCanBe) {
  const std::filesystem::path state = std::filesystem::temp_directory_path() /
                                      (std::string{"docent-hostile-"} + GetParam() + std::to_string(::getpid()));
  std::filesystem::create_directories(state);
  {
    ModuleStage stage{GetParam(), state};
    Rng rng{7};
    const auto begin = std::chrono::steady_clock::now();
    for (int step = 0; step < 150; ++step) {
      const double share = step % 3 == 0 ? 0.0 : step % 3 == 1 ? 0.03 : 0.3;
      for (std::size_t topic = 0; topic < ModuleStage::topics(); ++topic) stage.publish(topic, rng, share);
      stage.run(0.05);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{60});
    for (const std::string& unfit : stage.unfit_output()) ADD_FAILURE() << unfit;
    EXPECT_EQ(stage.health().module, GetParam());
    if (stage.refused() > 0) {
      EXPECT_NE(stage.health().reason.find("refused: "), std::string::npos) << stage.health().reason;
    }
    // And it works again when the noise ends.
    for (int step = 0; step < 130; ++step) {
      for (std::size_t topic = 0; topic < ModuleStage::topics(); ++topic) stage.publish(topic, rng, 0.0);
      stage.run(0.05);
    }
    EXPECT_EQ(stage.health().reason.find("refused"), std::string::npos) << stage.health().reason;
  }
  std::filesystem::remove_all(state);
}

std::vector<const char*> module_names() {
  std::vector<const char*> names;
  for (const modules::ModuleEntry& entry : modules::all_modules()) names.push_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Modules, HostileModule, ::testing::ValuesIn(module_names()),
                         [](const auto& of) { return std::string{of.param}; });

}  // namespace
}  // namespace docent
