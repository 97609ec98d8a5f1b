#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "docent/apps/laboratory/ablations/crippled_robot.h"
#include "docent/apps/replay/replay_run.h"
#include "docent/apps/simulate/simulation_run.h"
#include "docent/base/files.h"
#include "docent/evaluation/deployment_evaluator.h"
#include "docent/recording/recorder.h"

namespace docent {
namespace {

constexpr double kSeconds = 240.0;

/// One recorded run in Bonn for all tests.
class Replay : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("docent_replay_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    apps::simulate_command::SimulationRunOptions options;
    options.museum = museum_folder();
    options.crowd = "quiet";
    options.requests_per_hour = 120.0;
    options.seed = 3;
    options.recording = recording();
    auto run = apps::simulate_command::SimulationRun::create(options);
    ASSERT_TRUE(run) << run.error().message;
    ASSERT_TRUE((*run)->run_until(time_from_seconds(kSeconds)));
    ASSERT_TRUE((*run)->finish());
    live_report_ = (*run)->report_json();
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }
  static std::string museum_folder() { return std::string{DOCENT_SOURCES} + "/museums/bonn"; }
  static std::string recording() { return (folder_ / "run.mcap").string(); }

  [[nodiscard]] static Result<apps::replay_command::ReplayOutcome> replay_with(const std::vector<std::string>& modules,
                                                                               const std::string& setting = "",
                                                                               const std::string& out = "") {
    const auto museum = museum::load_museum(museum_folder());
    if (!museum) return tl::unexpected<Error>(museum.error());
    robot::RobotConfig config;
    if (!setting.empty()) {
      if (auto set = config.set(setting); !set) return tl::unexpected<Error>(set.error());
    }
    const auto robot = std::make_shared<apps::ablations::CrippledRobot>();
    if (auto read = robot->read(config); !read) return tl::unexpected<Error>(read.error());
    apps::replay_command::ReplayOptions options;
    options.robot_maker = robot;
    options.recording = recording();
    options.modules = modules;
    options.out = out;
    return apps::replay_command::replay(*museum, config, options);
  }
  static Result<evaluation::DeploymentReport> evaluate(const std::string& file) {
    auto reader = recording::McapReader::open(file);
    if (!reader) return tl::unexpected<Error>(reader.error());
    evaluation::DeploymentEvaluator evaluator;
    auto read = recording::read_recording(*reader, {}, [&](const recording::RecordedMessage& message) {
      evaluator.add(message.topic, message.time, message.message);
      return true;
    });
    if (!read) return tl::unexpected<Error>(read.error());
    return evaluator.report();
  }

  static std::filesystem::path folder_;
  static std::string live_report_;
};
std::filesystem::path Replay::folder_;
std::string Replay::live_report_;

TEST_F(Replay, EvaluatingTheRecordingGivesTheReportOfTheRun) {
  const auto report = evaluate(recording());
  ASSERT_TRUE(report) << report.error().message;
  auto live = nlohmann::ordered_json::parse(live_report_);
  for (const char* key : {"wall_seconds", "cpu_seconds", "speedup", "wall_speedup", "p99_ms"}) live.erase(key);
  EXPECT_EQ(nlohmann::ordered_json::parse(evaluation::to_json(*report, std::nullopt)).dump(2), live.dump(2));
  EXPECT_GT(report->distance_m, 5.0);  // something happened
  EXPECT_TRUE(report->localization.localized_after_s);
}

TEST_F(Replay, TheSensorsGiveTheSameMissionEventsInTheSameOrder) {
  const auto outcome = replay_with({});
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_GE(outcome->recorded.size(), 8U);
  EXPECT_EQ(apps::replay_command::first_difference(outcome->recorded, outcome->repeated, outcome->seconds), "");
  for (const char* topic : {"scan_front", "odom", "docent/request"})
    EXPECT_NE(std::find(outcome->replayed_topics.begin(), outcome->replayed_topics.end(), topic),
              outcome->replayed_topics.end())
        << topic;
  for (const char* topic : {"docent/belief", "docent/event", "docent/mission_state", "cmd_vel"})
    EXPECT_EQ(std::find(outcome->replayed_topics.begin(), outcome->replayed_topics.end(), topic),
              outcome->replayed_topics.end())
        << topic << " is made anew";
}

TEST_F(Replay, AChangedModuleIsSeenInItsRecording) {
  const std::string out = (folder_ / "localized.mcap").string();
  const auto again = replay_with({"localize"}, "", out);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->modules, std::vector<std::string>{"localize"});
  EXPECT_TRUE(again->recorded.empty());
  ASSERT_TRUE(again->report);
  const auto original = evaluate(recording());
  const auto repeated = evaluate(out);
  ASSERT_TRUE(original && repeated);
  EXPECT_NEAR(repeated->localization.error_m.mean(), original->localization.error_m.mean(), 0.03);
  EXPECT_EQ(evaluation::to_json(*repeated, std::nullopt), evaluation::to_json(*again->report, std::nullopt));
  // A robot that only adds up its odometry once it has found itself drifts away in the same recording.
  const auto crippled = replay_with({"localize"}, "evaluation.dead_reckoning=true");
  ASSERT_TRUE(crippled) << crippled.error().message;
  ASSERT_TRUE(crippled->report);
  EXPECT_EQ(crippled->report->crippled, "dead_reckoning");
  EXPECT_GT(crippled->report->localization.error_m.mean(), 2.0 * repeated->localization.error_m.mean());
}

TEST_F(Replay, WhatCannotBeReplayedIsSaidSo) {
  const auto unknown = replay_with({"localise"});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("localise"), std::string::npos);
  EXPECT_FALSE(replay_with({"record"}));
  EXPECT_FALSE(replay_with({}, "", "/nowhere/out.mcap"));
  const auto name = apps::replay_command::museum_of_recording(recording());
  ASSERT_TRUE(name);
  EXPECT_EQ(*name, "bonn");
}

TEST(FirstDifference, NamesThePlaceAmongTheMissionsEvents) {
  const std::vector<apps::replay_command::ReplayEvent> recorded{{1.0, "localized", ""}, {5.0, "explained", "vase"}};
  EXPECT_EQ(
      apps::replay_command::first_difference(recorded, {{2.0, "localized", ""}, {9.0, "explained", "vase"}}, 100.0),
      "");
  EXPECT_EQ(apps::replay_command::first_difference(
                recorded, {{2.0, "localized", ""}, {3.0, "drive_blocked", ""}, {9.0, "explained", "vase"}}, 100.0),
            "");
  EXPECT_EQ(apps::replay_command::first_difference(recorded, {{2.0, "localized", ""}}, 100.0),
            "event 2: recorded explained vase at 5.0 s, now nothing more");
  EXPECT_EQ(apps::replay_command::first_difference(recorded, {{2.0, "localized", ""}}, 7.0), "");  // cut at the end
  EXPECT_EQ(
      apps::replay_command::first_difference(recorded, {{1.5, "relocalizing", ""}, {5.0, "explained", "vase"}}, 7.0),
      "event 1: recorded localized at 1.0 s, now relocalizing at 1.5 s");
}

}  // namespace
}  // namespace docent
