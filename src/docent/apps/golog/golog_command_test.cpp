#include "docent/apps/golog/golog_command.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "docent/apps/shared/command.h"

namespace docent::apps::golog_command {
namespace {

/// Runs `docent golog ARGUMENTS`: what it prints, or the message of CommandFailed.
std::string run(const std::string& arguments) {
  CLI::App app{"docent"};
  add_golog_command(app);
  std::string message;
  testing::internal::CaptureStdout();
  try {
    app.parse("golog " + arguments);
  } catch (const CommandFailed& failure) {
    message = failure.message;
  }
  const std::string printed = testing::internal::GetCapturedStdout();
  return message.empty() ? printed : message;
}

TEST(GologCommand, SaysThatAMuseumHasNoProgramOfItsOwn) {
  for (const char* museum : {"museums/bonn", "museums/bonn/"}) {
    const std::string said = run(std::string{"check "} + museum);
    EXPECT_NE(said.find("tour_guide.pl: fine, for the 14 exhibits of"), std::string::npos) << said;
    EXPECT_NE(said.find(", which has no tour.pl of its own\n"), std::string::npos) << said;
  }
  EXPECT_EQ(run("check museums/bonn --program prolog/tour_guide.pl"),
            "prolog/tour_guide.pl: fine, for the 14 exhibits of museums/bonn\n");
}

TEST(GologCommand, SaysWhatMayHaveBeenMeant) {
  EXPECT_EQ(run("plan museums/bonn --request wankl"),
            "--request wankl: there is no such exhibit; did you mean 'wankel'?");
  const std::string said = run("plan museums/bonn --main tour_giude");
  EXPECT_NE(said.find("tour_guide.pl:1: tour_giude is neither an action nor a procedure; did you mean tour_guide?"),
            std::string::npos)
      << said;
}

}  // namespace
}  // namespace docent::apps::golog_command
