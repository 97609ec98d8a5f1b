#include "docent/task_control/golex/directive_text.h"

#include <gtest/gtest.h>

#include <set>

#include "docent/interaction/speech/sentences.h"
#include "docent/task_control/golex/executive_fixture.h"

namespace docent::task_control {
namespace {

const Directive kAnnouncement{DirectiveKind::announce, "announcement", {}, "announcement"};

TEST(DirectiveText, ALineThatIsSentAgainHasTheSameWordsAndTasksDiffer) {
  std::set<std::string> heard;
  for (int i = 0; i < 50; ++i) {
    const ExecutiveTask task = visit("t" + std::to_string(i));
    EXPECT_EQ(text_of(kAnnouncement, task, Mood::happy), text_of(kAnnouncement, task, Mood::happy));
    heard.insert(text_of(kAnnouncement, task, Mood::happy));
  }
  const int ways = interaction::count_variants(interaction::Sentence::announcement, "en", Mood::happy);
  EXPECT_EQ(heard.size(), static_cast<std::size_t>(ways)) << "each of them has its turn";
}

TEST(DirectiveText, OneActionDoesNotRepeatItself) {
  ExecutiveTask task = visit("m");
  task.style = interaction::AttractionAction{GazeStrategy::nearest, Mood::happy, SpeechAct::invite};
  std::set<std::string> heard;
  for (const ActionItem& item : *default_decomposition().find("mingle")) {
    for (const Directive& directive : item.together) {
      if (directive.kind == DirectiveKind::announce) heard.insert(text_of(directive, task, Mood::happy));
    }
  }
  EXPECT_EQ(heard.size(), 3U);
}

TEST(DirectiveText, WhoSaysNothingHasNoWords) {
  ExecutiveTask task = visit("m");
  const Directive attraction{DirectiveKind::announce, "attraction", {}, "attraction"};
  EXPECT_EQ(text_of(attraction, task, Mood::happy), "");
  task.style = interaction::AttractionAction{GazeStrategy::nearest, Mood::happy, SpeechAct::silence};
  EXPECT_EQ(text_of(attraction, task, Mood::happy), "");
}

TEST(DirectiveText, WhoLeadsATourAsksEveryOtherTimeToStayBehindIt) {
  const auto behind = interaction::sentence(interaction::Sentence::stay_behind, "en", Mood::neutral, 0);
  ExecutiveTask task = visit("t");
  for (int count = 1; count <= 4; ++count) EXPECT_NE(words_for_way(task, Mood::neutral, count), behind) << "on the Web";
  task.order.tour_id = "space";
  EXPECT_EQ(words_for_way(task, Mood::neutral, 1), "Please let me through.");
  EXPECT_EQ(words_for_way(task, Mood::neutral, 2), behind);
  EXPECT_NE(words_for_way(task, Mood::neutral, 3), "Please let me through.") << "it is another way to say it";
  EXPECT_NE(words_for_way(task, Mood::neutral, 4), behind);
}

TEST(DirectiveText, WhoLooksForItsPlaceSaysWhyPeopleShallStepBack) {
  ExecutiveTask task = visit("l");
  task.order.kind = TaskKind::relocalize;
  const auto asked = words_for_way(task, Mood::neutral, 1);
  EXPECT_NE(asked.find("step back"), std::string::npos);
  EXPECT_NE(words_for_way(task, Mood::neutral, 2), asked);
}

}  // namespace
}  // namespace docent::task_control
