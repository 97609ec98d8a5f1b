#include "docent/apps/laboratory/learn/learn_report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/base/files.h"
#include "docent/robot/robot_config.h"

namespace docent::apps::learn_command {
namespace {

LearningOutcome outcome(double wall_depth, bool with_motion) {
  sensor_models::ProximityModelParams sensor;
  sensor.max_range = 30.0;
  sensor.sigma = 0.0714285;
  sensor.weight_hit = 0.6;
  sensor.weight_short = 0.05;
  localization::LearnedModels learned{
      sensor, {}, "too little motion", 0.0, 0.0, 0, wall_depth, {}, {}, {}, sensor_models::ReadingCounts{30.0}};
  learned.on_first_labels = {1000, 4, -3.0, -2.5, 0.05};
  learned.on_last_labels = learned.on_first_labels;
  learned.iterations.push_back({100, 90, 0.5, 3000, -3.0, -2.6, learned.on_first_labels});
  if (with_motion) {
    motion_models::OdometryFit fit;
    fit.noise.motion.rotation_per_metre = 0.000123;
    learned.motion = fit;
  }
  return {"laser", {"a.log", "b.log"}, "map.yaml", {}, {}, learned};
}

/// What a robot reads of it.
Result<localization::LocalizerParams> read_back(const LearningOutcome& outcome) {
  const auto path = std::filesystem::temp_directory_path() / ("docent-learned-" + std::to_string(::getpid()) + ".yaml");
  EXPECT_TRUE(write_file_atomically(path, learned_yaml(outcome)));
  const auto config = robot::RobotConfig::load(path);
  std::filesystem::remove(path);
  if (!config) return tl::unexpected<Error>(config.error());
  return config->section<localization::LocalizerParams>("localize");
}

TEST(LearnReport, RobotYamlIsReadAsItIs) {
  const auto params = read_back(outcome(0.2, true));
  ASSERT_TRUE(params) << params.error().message;
  EXPECT_DOUBLE_EQ(params->states.wall_depth, 0.2);
  EXPECT_DOUBLE_EQ(params->sensor.max_range, 30.0);
  EXPECT_NEAR(params->sensor.sigma, 0.0714285, 1e-6);
  EXPECT_DOUBLE_EQ(params->sensor.weight_short, 0.05);
  EXPECT_DOUBLE_EQ(params->motion.rotation_per_metre, 0.000123);
}

TEST(LearnReport, ASonarsModelIsNotTheLasers) {
  LearningOutcome of_sonar = outcome(0.0, false);
  of_sonar.sensor = "sonar";
  const std::string text = learned_yaml(of_sonar);
  EXPECT_NE(text.find("  sonar:\n    model:\n      max_range: 30\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("  sensor:"), std::string::npos);
}

TEST(LearnReport, WhatWasNotLearnedStaysAsItIs) {
  const auto params = read_back(outcome(0.0, false));
  ASSERT_TRUE(params) << params.error().message;
  EXPECT_EQ(params->motion.rotation_per_metre, motion_models::OdometryModelParams{}.rotation_per_metre);
  EXPECT_NE(learning_table(outcome(0.0, false)).find("not learned, too little motion"), std::string::npos);
}

TEST(LearnReport, SettingsAreThoseOfLocalize) {
  robot::RobotConfig config;
  const std::string settings = learned_settings(outcome(0.0, true));
  const std::size_t begin = settings.find('\'') + 1;
  ASSERT_TRUE(config.set("localize." + settings.substr(begin, settings.find('\'', begin) - begin)));
  const auto params = config.section<localization::LocalizerParams>("localize");
  ASSERT_TRUE(params) << params.error().message;
  EXPECT_DOUBLE_EQ(params->sensor.weight_hit, 0.6);
}

TEST(LearnReport, ShowsEveryParameterBeforeAndAfter) {
  const std::string table = learning_table(outcome(0.0, true));
  for (const char* key :
       {"sigma_per_metre", "near_factor", "weight_no_return", "rotation_per_radian", "+0.5000 +- 0.0500"})
    EXPECT_NE(table.find(key), std::string::npos) << key;
}

}  // namespace
}  // namespace docent::apps::learn_command
