#include "docent/apps/shared/arguments.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "docent/apps/shared/command.h"

namespace docent::apps {
namespace {

TEST(Arguments, NumbersWithCommas) {
  EXPECT_EQ(parse_point("--from", "1.5,-2"), (Point2{1.5, -2.0}));
  EXPECT_NEAR(parse_pose("--start", "0,0,90").theta.degrees(), 90.0, 1e-9);
}

TEST(Arguments, AnythingElseIsRefusedByName) {
  for (const char* text : {"", "1", "1,2,3", "1,x", "1,2,", "nan,1", "1 2", "inf,0"}) {
    try {
      (void)parse_point("--from", text);
      ADD_FAILURE() << "'" << text << "' was taken";
    } catch (const CommandFailed& failure) {
      EXPECT_TRUE(failure.message.starts_with("--from ")) << failure.message;
      EXPECT_EQ(failure.exit_code, 2);
    }
  }
}

TEST(Arguments, APictureIsRefusedBeforeTheWorkByItsExtension) {
  for (const char* good : {"a.svg", "a.pdf", "a.png", "/tmp/b.c.svg"}) {
    std::string text = good;
    EXPECT_EQ(output_picture()(text), "") << good;
  }
  for (const char* bad : {"a.jpg", "a", "svg", "a.svg.gz", ""}) {
    std::string text = bad;
    EXPECT_NE(output_picture()(text).find("must end in .svg, .pdf or .png"), std::string::npos) << bad;
  }
  std::string nowhere = "/nowhere/a.svg";
  EXPECT_NE(output_picture()(nowhere).find("there is no folder /nowhere"), std::string::npos);
}

TEST(Arguments, LinksAndPipesAreTaken) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path{::testing::TempDir()} / "docent_arguments_test";
  fs::create_directories(folder);
  fs::create_symlink("new.json", folder / "dangling");
  fs::create_symlink("no/where.json", folder / "nowhere");
  fs::create_symlink("round", folder / "round");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const auto fault_of = [&](const fs::path& path) {
    std::string text = path;
    return output_file()(text);
  };
  // A device may be written into though nothing can be made in its folder.
  for (const fs::path& good : {folder / "plain", folder / "dangling", folder / "pipe", fs::path{"/dev/null"}})
    EXPECT_EQ(fault_of(good), "") << good;
  EXPECT_NE(fault_of(folder / "nowhere").find("there is no folder " + (folder / "no").string()), std::string::npos);
  EXPECT_NE(fault_of(folder / "round").find("cannot be written: Too many levels"), std::string::npos);
  EXPECT_NE(fault_of(folder).find("it is a folder"), std::string::npos);
  fs::remove_all(folder);
}

TEST(Arguments, TwoOptionsMayNotReplaceOneFile) {
  const auto fault_of = [](std::vector<std::string> words) -> std::string {
    CLI::App app;
    CLI::App* command = app.add_subcommand("run", "a command");
    std::string report, log, picture, read;
    command->add_option("--report", report)->check(output_file());
    command->add_option("--log", log)->check(output_file());
    command->add_option("--picture", picture)->check(output_picture());
    command->add_option("--read", read);
    words.insert(words.begin(), "run");
    std::reverse(words.begin(), words.end());
    app.parse(words);
    try {
      refuse_shared_outputs(app);
    } catch (const CommandFailed& failure) {
      EXPECT_EQ(failure.exit_code, 2);
      return failure.message;
    }
    return "";
  };
  EXPECT_EQ(fault_of({"--report", "r.json", "--log", "./r.json"}), "--log ./r.json: is written by --report");
  EXPECT_EQ(fault_of({"--picture", "a.svg", "--log", "a.svg"}), "--picture a.svg: is written by --log");
  EXPECT_EQ(fault_of({"--report", "r.json", "--log", "l.csv", "--picture", "p.svg"}), "");
  EXPECT_EQ(fault_of({"--report", "/dev/null", "--log", "/dev/null"}), "");
  EXPECT_EQ(fault_of({"--report", "r.json", "--read", "r.json"}), "") << "reading is no writing";
}

TEST(Arguments, WhatIsNoPoseNoFolderOrNoNumberIsRefused) {
  for (std::string pose : {"1,2,90", "-1.5,0,0"}) EXPECT_EQ(pose_option()(pose), "") << pose;
  for (std::string pose : {"1,2", "1,2,90,4", "", "1;2;90", "nan,2,90", "1,2,ninety"})
    EXPECT_NE(pose_option()(pose).find("expected three numbers X,Y,DEG"), std::string::npos) << pose;
  const std::filesystem::path folder = std::filesystem::path{::testing::TempDir()} / "docent_kept_folder";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "file").string();
  std::ofstream{file} << "x";
  std::string there = folder.string(), new_one = (folder / "a/b").string(), below = file + "/state", same = file;
  EXPECT_EQ(kept_folder()(there), "");
  EXPECT_EQ(kept_folder()(new_one), "");
  EXPECT_EQ(kept_folder()(same), file + " is not a folder");
  EXPECT_EQ(kept_folder()(below), file + " is not a folder");
  std::filesystem::remove_all(folder);
  const auto fault_of = [](const char* text) -> std::string {
    CLI::App app;
    CLI::App* command = app.add_subcommand("run", "a command");
    double seconds = 1.0;
    std::string name;
    command->add_option("--seconds", seconds)->check(CLI::Range(1.0, 600.0));
    command->add_option("--name", name);
    app.parse(std::vector<std::string>{text, "--seconds", "inf", "--name", "run"});
    try {
      refuse_odd_numbers(app);
    } catch (const CommandFailed& failure) {
      EXPECT_EQ(failure.exit_code, 2);
      return failure.message;
    }
    return "";
  };
  EXPECT_EQ(fault_of("nan"), "--seconds nan: expected a number") << "which no bound refuses";
  EXPECT_EQ(fault_of("1.5"), "") << "a name may be inf";
}

TEST(Arguments, ANameThatBeginsTopicsIsOneOfRos2) {
  for (std::string name : {"rhino", "robot_2", "hall/_left/r2"}) EXPECT_EQ(topic_prefix()(name), "") << name;
  for (std::string name : {"", "my robot", "2nd", "a//b", "/a", "a/", "a/2", "a-b", "größe", "a\nb"})
    EXPECT_NE(topic_prefix()(name), "") << name;
  std::string longest(64, 'a');
  EXPECT_EQ(topic_prefix()(longest), "");
  longest += 'a';
  EXPECT_NE(topic_prefix()(longest), "");
}

}  // namespace
}  // namespace docent::apps
