#include "docent/apps/shared/tour_check.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"
#include "docent/task_control/golog/golog_program.h"

namespace docent::apps {
namespace {

const char* const kHello = "action(hello).\nposs(hello, true).\nproc(main, [hello, ?(closing)]).\n";

class TourCheck : public ::testing::Test {
 protected:
  TourCheck() : folder_{std::filesystem::temp_directory_path() / ("docent-tour-check-" + std::to_string(::getpid()))} {
    std::filesystem::create_directories(folder_);
    museum_.folder = folder_;
    museum_.languages = {"en", "de"};
    museum_.exhibits.emplace_back().id = "airbus";
  }
  ~TourCheck() override { std::filesystem::remove_all(folder_); }
  TourCheck(const TourCheck&) = delete;
  TourCheck& operator=(const TourCheck&) = delete;

  void write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(write_file_atomically(folder_ / name, text));
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// All lines that it finds, the faults first.
  [[nodiscard]] std::vector<std::string> lines() const {
    const TourFindings found = check_tour(task_control::golog_file(folder_), museum_);
    std::vector<std::string> lines;
    for (const Error& fault : found.faults) lines.push_back(fault.message);
    lines.insert(lines.end(), found.notes.begin(), found.notes.end());
    return lines;
  }

  std::filesystem::path folder_;
  museum::Museum museum_;
};

using Lines = std::vector<std::string>;

TEST_F(TourCheck, AMuseumMayHaveNeitherFile) { EXPECT_EQ(lines(), Lines{}); }

TEST_F(TourCheck, ReadsBothFiles) {
  write("tour.pl", "proc(main, explain(airbuss)).\n");
  write("golex.yaml", "drive:\n  - lok: place\n");
  EXPECT_EQ(lines(),
            (Lines{path("tour.pl") + ":1: explain(airbuss): there is no exhibit(airbuss); did you mean airbus?",
                   path("golex.yaml") + ":2: unknown directive 'lok'; did you mean 'look'?"}));
}

TEST_F(TourCheck, EachActionNeedsAKey) {
  write("tour.pl", kHello);
  const std::string missing =
      path("tour.pl") + ":1: no key of " + path("golex.yaml") + " says what the robot does for the action 'hello'";
  EXPECT_EQ(lines(), (Lines{missing}));
  write("golex.yaml", "helo:\n  - wait: 1\n");
  EXPECT_EQ(lines(), (Lines{missing + "; did you mean 'helo'?",
                            path("golex.yaml") + ":1: note: no action is called 'helo'; did you mean 'hello'?"}));
  write("golex.yaml", "hello:\n  - wait: 1\n");
  EXPECT_EQ(lines(), Lines{});
}

TEST_F(TourCheck, NotesKeysThatNoActionCalls) {
  write("golex.yaml", "mingle:\n  - wait: 1\ndrvie:\n  - drive: place\n");
  EXPECT_EQ(lines(), (Lines{path("golex.yaml") + ":3: note: no action is called 'drvie'; did you mean 'drive'?"}));
}

TEST_F(TourCheck, NotesTextsThatDoNotFitTheMuseumsLanguages) {
  write("golex.yaml",
        "explain:\n  - say: {en: Look!, de: Schau!}\n  - announce: {eng: Look!, de: Schau!}\n    mood: happy\n");
  EXPECT_EQ(lines(), (Lines{path("golex.yaml") + ":3: note: the museum does not speak 'eng'; did you mean 'en'?",
                            path("golex.yaml") + ":3: note: there is no text in 'en'"}));
}

}  // namespace
}  // namespace docent::apps
