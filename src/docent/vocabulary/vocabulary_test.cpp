#include "docent/vocabulary/vocabulary.h"

#include <gtest/gtest.h>

#include <set>

namespace docent {
namespace {

/// Every value up to the last has one word of its own, and comes back from it.
template <class E>
void expect_each_has_its_word(E last) {
  const auto words = words_of(E{});
  ASSERT_EQ(words.size(), static_cast<std::size_t>(last) + 1);
  EXPECT_EQ(std::set<std::string>(words.begin(), words.end()).size(), words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto value = static_cast<E>(i);
    EXPECT_STREQ(to_text(value), words.at(i));
    EXPECT_EQ(parse<E>(words.at(i)), value);
  }
  for (const char* text : {"", "nonsense", " done", "Done"}) EXPECT_EQ(parse<E>(text), std::nullopt) << text;
}

TEST(Vocabulary, EachValueHasItsWord) {
  expect_each_has_its_word(RequestKind::skip);
  expect_each_has_its_word(RequestSource::vote);
  expect_each_has_its_word(RequestStatus::cancelled);
  expect_each_has_its_word(OperatingMode::hours);
  expect_each_has_its_word(ExplorationOrder::finish);
  expect_each_has_its_word(SetupStep::done);
  expect_each_has_its_word(MissionPhase::waiting);
  expect_each_has_its_word(TaskKind::point);
  expect_each_has_its_word(LookFor::company);
  expect_each_has_its_word(TaskStatus::failed);
  expect_each_has_its_word(GoalStatus::unreachable);
  expect_each_has_its_word(DriveMode::turn);
  expect_each_has_its_word(GazeAt::none);
  expect_each_has_its_word(Rung::free);
  expect_each_has_its_word(SpeechStatus::failed);
  expect_each_has_its_word(Mood::angry);
  expect_each_has_its_word(LookAt::none);
  expect_each_has_its_word(GazeStrategy::ahead);
  expect_each_has_its_word(SpeechAct::complain);
  expect_each_has_its_word(Answer::no);
  expect_each_has_its_word(ContactKind::hazards);
  expect_each_has_its_word(ReasonWord::charger_no_current);
  expect_each_has_its_word(EventKind::staff_called);
}

TEST(Vocabulary, ValuesHaveTheirOwnWords) {
  EXPECT_STREQ(to_text(RequestStatus::fulfilled), "fulfilled");
  EXPECT_STREQ(to_text(MissionPhase::going_home), "going_home");
  EXPECT_STREQ(to_text(MissionPhase::waiting), "waiting");
  EXPECT_STREQ(to_text(GoalStatus::turning), "turning");
  EXPECT_STREQ(to_text(EventKind::explained), "explained");
  EXPECT_STREQ(to_text(EventKind::tour_broken_off), "tour_broken_off");
  EXPECT_STREQ(to_text(EventKind::attraction_trial), "attraction_trial");
  EXPECT_STREQ(to_text(EventKind::charger_failed), "charger_failed");
  EXPECT_STREQ(to_text(EventKind::asked_for_way), "asked_for_way");
  EXPECT_STREQ(to_text(Rung::global_detour), "global_detour");
  EXPECT_STREQ(to_text(std::optional<TaskStatus>{}), "");
  EXPECT_STREQ(to_text(std::optional{TaskStatus::done}), "done");
}

TEST(Vocabulary, AnUnknownWordIsKeptAndEqualsNothing) {
  const Word<RequestKind> tour{std::string{"tour"}};
  EXPECT_EQ(tour, RequestKind::tour);
  EXPECT_NE(tour, RequestKind::exhibit);
  EXPECT_EQ(tour.text(), "tour");
  const Word<RequestKind> dance{std::string{"dance"}};
  EXPECT_EQ(dance.text(), "dance");
  EXPECT_EQ(dance.value(), std::nullopt);
  for (const RequestKind kind : {RequestKind::exhibit, RequestKind::tour, RequestKind::cancel}) EXPECT_NE(dance, kind);
  EXPECT_NE(dance, Word<RequestKind>{std::string{"sing"}});
  EXPECT_EQ(Word<RequestKind>{}.text(), "");
}

}  // namespace
}  // namespace docent
