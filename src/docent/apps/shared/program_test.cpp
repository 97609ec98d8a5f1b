#include "docent/apps/shared/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"

namespace docent::apps {
namespace {

/// Two groups of commands, of which one notes that it ran.
class ProgramWithCommands : public ::testing::Test {
 protected:
  [[nodiscard]] Program program() {
    const auto plain = [this](const char* name, std::function<void()> callback) {
      return [this, name, callback = std::move(callback)](CLI::App& app) {
        CLI::App* command = app.add_subcommand(name, "a command");
        command->callback(callback);
        for (const char* option : {"--report", "--log"}) command->add_option(option)->check(output_file());
        command->add_option("--crowd", crowd_)->check(CLI::IsMember({"quiet", "busy"}))->capture_default_str();
      };
    };
    return {.name = "guide",
            .meaning = "A program.",
            .version = "1.2",
            .groups = {{"Run", {plain("drive", [this] { ++drives_; })}},
                       {"Fail",
                        {plain("refuse",
                               [] {
                                 throw CommandFailed{"no such place", 7};
                               }),
                         plain("break", [] { throw std::runtime_error{"broken"}; })}}},
            .other = "guide-lab",
            .others = {"measure"},
            .examples = {{"drive", "drive --report drive.json"}}};
  }

  struct Finished {
    int code = -1;
    std::string out;
    std::string error;
  };
  Finished run_with(std::vector<const char*> words) {
    words.insert(words.begin(), "guide");
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = run(program(), static_cast<int>(words.size()), words.data());
    return {code, ::testing::internal::GetCapturedStdout(), ::testing::internal::GetCapturedStderr()};
  }

  int drives_ = 0;
  std::string crowd_ = "quiet";
};

TEST_F(ProgramWithCommands, HelpEndsWithAnExample) {
  const std::string help = run_with({"drive", "--help"}).out;
  EXPECT_TRUE(help.find("Example:\n  guide drive --report drive.json\n") != std::string::npos) << help;
}

TEST_F(ProgramWithCommands, AWordOfAListIsToldFromThoseThatThereAre) {
  const Finished finished = run_with({"drive", "--crowd", "busi"});
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.error.find("busi not in {quiet,busy}; did you mean 'busy'?"), std::string::npos) << finished.error;
}

TEST_F(ProgramWithCommands, OutputThatAFullDiskDoesNotTakeIsAFault) {
  ::testing::internal::CaptureStderr();
  std::fflush(stdout);
  const int before = ::dup(STDOUT_FILENO), full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(::dup2(full, STDOUT_FILENO), 0);
  std::printf("what a command says\n");
  const std::array<const char*, 2> words{"guide", "drive"};
  const int code = run(program(), static_cast<int>(words.size()), words.data());
  ::dup2(before, STDOUT_FILENO);
  ::close(before);
  ::close(full);
  std::clearerr(stdout);
  EXPECT_EQ(code, 1);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "guide: the output cannot be written: No space left on device\n");
}

TEST_F(ProgramWithCommands, RunsTheOneThatIsNamed) {
  EXPECT_EQ(names_of_commands(program()), (std::vector<std::string>{"drive", "refuse", "break"}));
  EXPECT_EQ(run_with({"drive"}).code, 0);
  EXPECT_EQ(drives_, 1);
  EXPECT_EQ(run_with({"--version"}).out, "guide 1.2\n");
}

TEST_F(ProgramWithCommands, ListsThemUnderTheirHeadings) {
  const Finished help = run_with({"--help"});
  EXPECT_EQ(help.code, 0);
  const auto at = [&](const char* text) { return help.out.find(text); };
  EXPECT_LT(at("Run:"), at("drive"));
  EXPECT_LT(at("drive"), at("Fail:"));
  EXPECT_LT(at("Fail:"), at("refuse"));
}

TEST_F(ProgramWithCommands, SaysInOneLineWhatIsWrong) {
  const Finished refused = run_with({"refuse"});
  EXPECT_EQ(refused.code, 7);
  EXPECT_EQ(refused.error, "guide: no such place\n");
  const Finished broken = run_with({"break"});
  EXPECT_EQ(broken.code, 1);
  EXPECT_EQ(broken.error, "guide: broken\n");
  const Finished misspelt = run_with({"drve"});
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_EQ(misspelt.error, "guide: unknown command 'drve'; did you mean 'drive'? (try --help)\n");
  const Finished none = run_with({});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.error, "guide: A subcommand is required (try --help)\n");
  EXPECT_EQ(run_with({"drive", "--backwards"}).code, 2);
  EXPECT_EQ(drives_, 0);
}

TEST_F(ProgramWithCommands, RefusesOneFileForTwoOutputsBeforeTheRun) {
  const Finished shared = run_with({"drive", "--report", "r.json", "--log", "r.json"});
  EXPECT_EQ(shared.code, 2);
  EXPECT_EQ(shared.error, "guide: --log r.json: is written by --report\n");
  EXPECT_EQ(drives_, 0);
  EXPECT_EQ(run_with({"drive", "--report", "r.json", "--log", "l.csv"}).code, 0);
  EXPECT_EQ(drives_, 1);
}

TEST_F(ProgramWithCommands, NamesTheProgramThatHasTheCommand) {
  const Finished elsewhere = run_with({"measure", "--all"});
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_EQ(elsewhere.error, "guide: 'measure' is a command of guide-lab\n");
}

TEST(ProgramHelp, SaysTypesInPlainWords) {
  EXPECT_EQ(plain_type("TEXT"), "TEXT");
  EXPECT_EQ(plain_type("FLOAT"), "NUMBER");
  EXPECT_EQ(plain_type("UINT"), "WHOLE NUMBER");
  EXPECT_EQ(plain_type("FLOAT:POSITIVE"), "NUMBER above 0");
  EXPECT_EQ(plain_type("FLOAT:FLOAT in [0 - 1]"), "NUMBER from 0 to 1");
  EXPECT_EQ(plain_type("INT:INT in [1 - 65535]"), "WHOLE NUMBER from 1 to 65535");
  EXPECT_EQ(plain_type("TEXT:{empty,quiet,busy,packed}"), "ONE OF empty, quiet, busy, packed");
  EXPECT_EQ(plain_type("TEXT:FILE"), "FILE");
  EXPECT_EQ(plain_type("UINT:SEED"), "SEED");
}

TEST_F(ProgramWithCommands, HelpTellsWhatHoldsWithoutAnOption) {
  const std::string help = run_with({"drive", "--help"}).out;
  EXPECT_NE(help.find("--crowd ONE OF quiet, busy (without: quiet)"), std::string::npos) << help;
}

}  // namespace
}  // namespace docent::apps
