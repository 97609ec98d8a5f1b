#include "docent/apps/museum/check_command.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "docent/apps/museum/office_command.h"
#include "docent/apps/museum/survey_command.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/interaction/sound/sound_file.h"

namespace docent::apps::museum_command {
namespace {

/// Runs `docent ARGUMENTS`; the message of CommandFailed, or "".
std::string run(const std::string& arguments) {
  CLI::App app{"docent"};
  add_check_command(app);
  add_office_command(app);
  add_survey_command(app);
  try {
    app.parse(arguments);
  } catch (const CommandFailed& failure) {
    EXPECT_NE(failure.exit_code, 0);
    return failure.message;
  }
  return {};
}

class CheckCommand : public ::testing::Test {
 protected:
  CheckCommand() : folder_{std::filesystem::temp_directory_path() / ("docent-check-" + std::to_string(::getpid()))} {
    std::filesystem::remove_all(folder_);
    std::filesystem::copy("museums/bonn", folder_, std::filesystem::copy_options::recursive);
  }
  ~CheckCommand() override { std::filesystem::remove_all(folder_); }
  CheckCommand(const CheckCommand&) = delete;
  CheckCommand& operator=(const CheckCommand&) = delete;

  void change(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = read_file(folder_ / name).value();
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    ASSERT_TRUE(write_file_atomically(folder_ / name, text.replace(at, from.size(), to)));
  }

  std::filesystem::path folder_;
};

TEST_F(CheckCommand, PassesWhatIsFine) { EXPECT_EQ(run("check " + folder_.string()), ""); }

TEST_F(CheckCommand, ChecksForTheRobotInUse) {
  const auto faults_of = [&](const std::string& arguments) {
    testing::internal::CaptureStderr();
    EXPECT_NE(run("check " + folder_.string() + " " + arguments), "") << arguments;
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_NE(faults_of("--set body.radius=0.9").find("the robot needs 1 m"), std::string::npos);
  EXPECT_NE(faults_of("--set 'plan.route={clearance: {hazards: 1.0}}'").find("the robot needs 1.27 m"),
            std::string::npos);
  ASSERT_TRUE(write_file_atomically(folder_ / "wide.yaml", "body: {radius: 0.9}\n"));
  EXPECT_NE(faults_of("--robot " + (folder_ / "wide.yaml").string()).find("the robot needs 1 m"), std::string::npos);
  EXPECT_EQ(run("check " + folder_.string() + " --set body.radius=0.25"), "");
  EXPECT_NE(run("check " + folder_.string() + " --set body.radius=thick").find("body.radius"), std::string::npos);
}

TEST_F(CheckCommand, ListensToRecordingsAndMusic) {
  const auto audio = folder_ / "content/audio/en";
  std::filesystem::create_directories(audio);
  const std::string sound = interaction::shared_sound(interaction::Clip(4410, 0.25F)).content;
  ASSERT_TRUE(write_file_atomically(audio / "particle-trap.short.wav", sound));
  ASSERT_TRUE(write_file_atomically(audio / "partical-trap.short.wav", sound));
  testing::internal::CaptureStdout();
  EXPECT_EQ(run("check " + folder_.string()), "");
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("partical-trap.short.wav"), std::string::npos) << said;
  EXPECT_EQ(said.find("particle-trap.short.wav"), std::string::npos) << said;
  testing::internal::CaptureStdout();
  EXPECT_EQ(run("check --recordings " + folder_.string()), "");
  const std::string list = testing::internal::GetCapturedStdout();
  EXPECT_NE(list.find("content/audio/en/particle-trap.short\trecorded\tneutral\tThe particle trap"), std::string::npos);
  EXPECT_NE(list.find("content/audio/de/particle-trap.short\tspoken by the voice\t"), std::string::npos);
  EXPECT_NE(list.find("content/audio/en/let_me_through.angry.1\tspoken by the voice\tangry\t"), std::string::npos);

  change("museum.yaml", "map: map.yaml", "map: map.yaml\nsound: {music: content/audio/tune.ogg}");
  for (const char* damaged : {"en/particle-trap.short.wav", "tune.ogg"})
    ASSERT_TRUE(write_file_atomically(folder_ / "content/audio" / damaged, "this is no sound at all"));
  testing::internal::CaptureStderr();
  EXPECT_NE(run("check " + folder_.string()).find("2 faults"), std::string::npos);
  const std::string faults = testing::internal::GetCapturedStderr();
  EXPECT_NE(faults.find("particle-trap.short.wav"), std::string::npos) << faults;
  EXPECT_NE(faults.find("tune.ogg"), std::string::npos) << faults;
}

TEST_F(CheckCommand, SaysInWhichLanguageTheRobotHasNoPhrases) {
  const auto said = [&] {
    testing::internal::CaptureStdout();
    EXPECT_EQ(run("check " + folder_.string()), "");
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(said().find("note:"), std::string::npos);
  std::string text = read_file(folder_ / "museum.yaml").value();
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"[en, de, fr]", "[en, tr, fr]"}, {", de: ", ", tr: "}}) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  ASSERT_TRUE(write_file_atomically(folder_ / "museum.yaml", text));
  const std::string note = said();
  EXPECT_NE(note.find("museum.yaml:3"), std::string::npos) << note;
  EXPECT_NE(note.find("'tr'"), std::string::npos);
}

TEST_F(CheckCommand, PassesDrawnOffices) {
  for (int seed = 1; seed <= 25; ++seed) {
    const std::string out = (folder_ / ("office-" + std::to_string(seed))).string();
    EXPECT_EQ(run("office --seed " + std::to_string(seed) + " --out " + out), "");
    EXPECT_EQ(run("check " + out), "") << seed;
  }
  EXPECT_EQ(run("office --seed 1 --pictures --out " + (folder_ / "drawn").string()), "");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "drawn" / "world.png"));
  const auto vectors = folder_ / "vectors";
  EXPECT_EQ(run("office --seed 1 --pictures --picture-format svg --out " + vectors.string()), "");
  const auto world = read_file(vectors / "world.svg");
  ASSERT_TRUE(world);
  for (const char* word : {"x [m], y [m]", "wall", "furniture", "operating area", "home"})
    EXPECT_NE(world->find(word), std::string::npos) << word;
  const auto survey = read_file(vectors / "survey.svg");
  ASSERT_TRUE(survey);
  for (const char* word : {"x [m], y [m]", "free", "occupied", "unknown"})
    EXPECT_NE(survey->find(word), std::string::npos) << word;
}

TEST_F(CheckCommand, ReadsTheTourProgramAndItsActions) {
  const auto faults = [&] {
    testing::internal::CaptureStderr();
    EXPECT_EQ(run("check " + folder_.string()), folder_.string() + ": 2 faults");
    return testing::internal::GetCapturedStderr();
  };
  ASSERT_TRUE(write_file_atomically(folder_ / "tour.pl", "proc(main, goto(zuze)).\n"));
  ASSERT_TRUE(write_file_atomically(folder_ / "golex.yaml", "drive:\n  - look: plaice\n"));
  const std::string said = faults();
  EXPECT_NE(said.find("tour.pl:1: goto(zuze): there is no place(zuze); did you mean zuse?"), std::string::npos) << said;
  EXPECT_NE(said.find("golex.yaml:2: 'look' must be"), std::string::npos) << said;

  ASSERT_TRUE(write_file_atomically(folder_ / "tour.pl", "proc(main, goto(zuse)).\n"));
  ASSERT_TRUE(write_file_atomically(folder_ / "golex.yaml", "drvie:\n  - look: place\n"));
  testing::internal::CaptureStdout();
  EXPECT_EQ(run("check " + folder_.string()), "");
  const std::string note = testing::internal::GetCapturedStdout();
  EXPECT_NE(note.find("golex.yaml:1: note: no action is called 'drvie'; did you mean 'drive'?"), std::string::npos)
      << note;
}

TEST_F(CheckCommand, CountsFaults) {
  change("museum.yaml", "minutes: 6", "minutes: -6");
  change("museum.yaml", "kind: plate", "kind: hole");
  EXPECT_EQ(run("check " + folder_.string()), folder_.string() + ": 2 faults");
}

TEST_F(CheckCommand, LooksIntoTheSimulation) {
  change("simulation.yaml", "exhibits: [particle-trap", "exhibits: [sword, particle-trap");
  EXPECT_EQ(run("check " + folder_.string()), folder_.string() + ": 1 fault");
  change("simulation.yaml", "sword", "crew");
  EXPECT_EQ(run("check " + folder_.string()), folder_.string() + ": 1 fault") << "only for the Web";
  change("simulation.yaml", "crew, ", "");
  change("simulation.yaml", "kind: stairs", "kind: lake");
  EXPECT_EQ(run("check " + folder_.string()), folder_.string() + ": 1 fault");
}

TEST_F(CheckCommand, SurveyWritesWhatMuseumYamlNeeds) {
  const auto out = folder_ / "survey";
  EXPECT_EQ(
      run("survey --world " + (folder_ / "simulation.yaml").string() + " --seed 7 --pictures --out " + out.string()),
      "");
  EXPECT_TRUE(load_map(out / "map.yaml"));
  EXPECT_EQ(read_file(out / "hazards.yaml").value().substr(0, 9), "hazards:\n");
  EXPECT_TRUE(std::filesystem::exists(out / "world.png"));
  EXPECT_TRUE(std::filesystem::exists(out / "survey.png"));
  EXPECT_NE(run("survey --world none.yaml --out " + out.string()).find("none.yaml: cannot be read"), std::string::npos);
}

}  // namespace
}  // namespace docent::apps::museum_command
