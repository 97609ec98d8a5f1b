#include "docent/task_control/golex/decomposition.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/base/files.h"
#include "docent/task_control/golex/executive_fixture.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {
namespace {

std::string error_of(const std::string& text) {
  const auto read = parse_decomposition(text, "golex.yaml", default_decomposition());
  return read ? "" : read.error().message;
}

TEST(Decomposition, TheBuiltInOneKnowsEveryTask) {
  for (const char* kind : words_of(TaskKind{})) {
    ASSERT_NE(default_decomposition().find(kind), nullptr) << kind;
    EXPECT_FALSE(default_decomposition().find(kind)->empty()) << kind;
  }
  EXPECT_EQ(default_decomposition().find("dance"), nullptr);
}

// [Rhino1999] Table 5: track point, horn, music, drive (which ends turned to the exhibit), then explain.
TEST(Decomposition, ADriveIsDividedAsInTable5) {
  const auto& visit = *default_decomposition().find("visit");
  std::vector<DirectiveKind> kinds;
  const ActionItem& way = visit.at(1);  // a greeting comes before the first one of a tour
  for (const Directive& directive : way.together) {
    if (directive.kind != DirectiveKind::announce) kinds.push_back(directive.kind);
  }
  EXPECT_EQ(kinds, (std::vector{DirectiveKind::look, DirectiveKind::horn, DirectiveKind::music, DirectiveKind::drive}));
  EXPECT_EQ(way.together.front().argument, "place");
}

TEST(Decomposition, AMuseumReplacesSingleActionsAndAddsOthers) {
  const auto read = parse_decomposition(
      "home:\n"
      "  - drive: place\n"
      "wave:\n"
      "  - {look: visitors, say: {en: Hello!, de: Hallo!}, wait: 2.5}\n"
      "  - {say: short}\n"
      "  - {say: short, if: more}\n",
      "golex.yaml", default_decomposition());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->find("home")->size(), 1U);
  EXPECT_EQ(read->find("visit")->size(), default_decomposition().find("visit")->size());
  const auto& wave = *read->find("wave");
  ASSERT_EQ(wave.size(), 3U);
  EXPECT_EQ(wave[0].together[1].texts.at("de"), "Hallo!");
  EXPECT_EQ(wave[2].condition, Condition::more);
  EXPECT_NE(wave[1].together[0].name, wave[2].together[0].name) << "ids follow from names";
}

TEST(Decomposition, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_EQ(error_of("visit:\n  - fly: place\n"), "golex.yaml:2: unknown directive 'fly'");
  EXPECT_EQ(error_of("visit:\n  - drive: moon\n"), "golex.yaml:2: 'drive' must be place or charger");
  EXPECT_EQ(error_of("visit:\n  - say: shrot\n"),
            "golex.yaml:2: 'say' must be short, long, attraction, the key of a sentence, or a text in each language");
  EXPECT_EQ(error_of("visit:\n  - wait: 3 days\n"), "golex.yaml:2: 'wait' must be linger or seconds, 0 to 600");
  EXPECT_EQ(error_of("visit:\n  - wait: -1\n"), "golex.yaml:2: 'wait' must be linger or seconds, 0 to 600");
  EXPECT_EQ(error_of("visit:\n  - {drive: place, drive: place}\n"), "golex.yaml:2: 'drive' comes twice in one item");
  EXPECT_EQ(error_of("visit:\n  - drive: place\n    if: rain\n"),
            "golex.yaml:3: 'if' must be more, broken_off, moved or tour_begins");
  EXPECT_EQ(error_of("charge:\n  - dock: wall\n"), "golex.yaml:2: 'dock' must be charger");
  EXPECT_NE(error_of("visit: drive\n"), "");
  EXPECT_NE(error_of("- visit\n"), "");
  EXPECT_NE(error_of("visit:\n  - [drive]\n"), "");
  EXPECT_NE(error_of("visit:\n  - drive: {a: b}\n"), "");
  EXPECT_NE(error_of("[1]: [2]\n"), "");
  EXPECT_NE(error_of(""), "");
}

TEST(Decomposition, AMuseumsFolderMayHaveOne) {
  const auto folder = std::filesystem::temp_directory_path() / ("docent-golex-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  EXPECT_EQ(load_decomposition(folder)->find("hello"), nullptr);
  ASSERT_TRUE(write_file_atomically(folder / "golex.yaml", "hello:\n  - wait: 1\n"));
  EXPECT_NE(load_decomposition(folder)->find("hello"), nullptr);
  ASSERT_TRUE(write_file_atomically(folder / "golex.yaml", "hello:\n  - wiat: 1\n"));
  EXPECT_EQ(load_decomposition(folder).error().message,
            (folder / "golex.yaml").string() + ":2: unknown directive 'wiat'; did you mean 'wait'?");
  std::filesystem::remove_all(folder);
}

/// Of a museum's own action.
class OwnAction : public ExecutiveTest {
 protected:
  void begin(const std::string& text) {
    auto read = parse_decomposition(text, "golex.yaml", default_decomposition());
    ASSERT_TRUE(read) << read.error().message;
    executive = Executive{{}, *read, {}, time()};
    ExecutiveTask task = visit("o");
    task.order.kind = Word<TaskKind>{std::string{"own"}};
    start(task);
  }
};

TEST_F(OwnAction, WhatStandsTogetherRunsTogetherAndEndsWithTheLast) {
  begin("own:\n  - {say: {en: A story on the way.}, drive: place, wait: 4}\n  - say: {en: The end.}\n");
  EXPECT_EQ(said.back().text, "A story on the way.");
  EXPECT_EQ(state.state, TaskStatus::driving);
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::explaining) << "the story goes on";
  speech("o/say", SpeechStatus::speaking);
  speech("o/say", SpeechStatus::done);
  EXPECT_EQ(said.back().text, "A story on the way.") << "the wait is not over";
  pass(4.5);
  EXPECT_EQ(said.back().text, "The end.");
  EXPECT_EQ(said.back().id, "o/say-2");
  speech("o/say-2", SpeechStatus::done);
  EXPECT_EQ(state.state, TaskStatus::done);
}

TEST_F(OwnAction, ARestartRepeatsOnlyWhatIsNotOver) {
  begin("own:\n  - {say: {en: A story.}, drive: place}\n");
  speech("o/say", SpeechStatus::done);
  const auto before = saved;
  executive =
      Executive{{},
                *parse_decomposition("own:\n  - {say: {en: A story.}, drive: place}\n", "g", default_decomposition()),
                before,
                time()};
  said.clear();
  collect();
  pass(2.0);
  EXPECT_TRUE(said.empty());
  EXPECT_EQ(drive->id, "o/drive");
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::done);
}

TEST_F(OwnAction, AnActionThatHoldsNothingUpIsDoneAtOnce) {
  begin("own:\n  - look: way\n  - {music: stop, announce: {en: Hi!}}\n");
  EXPECT_EQ(state.state, TaskStatus::done);
  EXPECT_EQ(said.back().text, "Hi!");
  begin("own: []\n");
  EXPECT_EQ(state.state, TaskStatus::done);
}

TEST_F(OwnAction, TheDriveOfTheTaskBeforeIsOver) {
  start(visit("t1"));
  begin("own:\n  - wait: 3\n  - drive: place\n");
  EXPECT_EQ(drive->id, "") << "it does not go on to the exhibit";
  pass(3.5);
  EXPECT_EQ(drive->id, "o/drive");
}

TEST_F(OwnAction, AFileThatWasChangedBeginsTheActionAnew) {
  begin("own:\n  - wait: 3\n  - drive: place\n");
  pass(3.5);
  executive =
      Executive{{}, *parse_decomposition("own:\n  - drive: place\n", "g", default_decomposition()), saved, time()};
  collect();
  EXPECT_EQ(state.state, TaskStatus::driving);
  goal(GoalStatus::arrived);
  EXPECT_EQ(state.state, TaskStatus::done);
}

}  // namespace
}  // namespace docent::task_control
