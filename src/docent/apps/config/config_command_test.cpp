#include "docent/apps/config/config_command.h"

#include <gtest/gtest.h>

#include "docent/apps/config/parameter_meanings.h"
#include "docent/base/files.h"
#include "docent/modules/host/registry.h"

namespace docent::apps::config_command {
namespace {

TEST(Config, EveryKeyHasAMeaning) {
  EXPECT_EQ(keys_without_meaning(robot::RobotConfig{}), std::vector<std::string>{})
      << "the doc comment of its struct should say what the key is for, with its unit";
}

TEST(Config, MeaningsAreTheDocCommentsOfTheStructs) {
  EXPECT_EQ(meaning_of("RobotBody", "max_speed"), "[m/s] that the base can do; museums limit it further");
  EXPECT_EQ(
      meaning_of("RobotBody", "outline"),
      "[m] or this convex polygon [[x, y], …], robot frame; then `radius` holds it: plans and steering take that");
  EXPECT_NE(meaning_of("Scanner", "y"), "") << "the second name of a declaration";
  EXPECT_NE(meaning_of("LocalizeParams", "beams"), "") << "a key of a struct whose keys are listed as its own";
  EXPECT_EQ(meaning_of("RobotBody", "no_such_key"), "");
}

TEST(Config, WhatIsPrintedIsARobotYamlThatSetsTheSame) {
  robot::RobotConfig config;
  ASSERT_TRUE(config.set("avoid.window.cycle=0.2").has_value());
  const auto text = commented_config(config, {});
  ASSERT_TRUE(text.has_value()) << text.error().message;
  const auto path = std::filesystem::path{testing::TempDir()} / "printed-robot.yaml";
  ASSERT_TRUE(write_file_atomically(path, *text).has_value());
  const auto read = robot::RobotConfig::load(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const auto again = commented_config(*read, {});
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(*again, *text);
  EXPECT_NE(text->find("cycle: 0.2 "), std::string::npos);
}

TEST(Config, ASectionAloneAndAnUnknownOne) {
  const auto text = commented_config(robot::RobotConfig{}, {"map"});
  ASSERT_TRUE(text.has_value()) << text.error().message;
  EXPECT_NE(text->find("\nmap:"), std::string::npos);
  EXPECT_EQ(text->find("\navoid:"), std::string::npos);
  const auto unknown = commented_config(robot::RobotConfig{}, {"mapp"});
  ASSERT_FALSE(unknown.has_value());
  EXPECT_NE(unknown.error().message.find("mapp"), std::string::npos);
  EXPECT_NE(unknown.error().message.find("localize"), std::string::npos);
}

/// docs/robot.yaml is what the command prints.
TEST(Config, TheCommentedFileInTheRepositoryIsUpToDate) {
  const auto text = commented_config(robot::RobotConfig{}, {});
  const auto file = read_file("docs/robot.yaml");
  ASSERT_TRUE(text.has_value() && file.has_value());
  EXPECT_EQ(*file, *text) << "docent config > docs/robot.yaml";
}

}  // namespace
}  // namespace docent::apps::config_command
