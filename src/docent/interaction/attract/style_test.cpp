#include "docent/interaction/attract/style.h"

#include <gtest/gtest.h>

#include <set>

namespace docent::interaction {
namespace {

TEST(Style, EachActionHasAnIndexOfItsOwn) {
  std::set<AttractionAction> all;
  for (int i = 0; i < kAttractionActions; ++i) {
    EXPECT_EQ(index_of(attraction_action(i)), i);
    all.insert(attraction_action(i));
  }
  EXPECT_EQ(all.size(), static_cast<std::size_t>(kAttractionActions));
}

TEST(Style, FaceAndWordsMakeItAndTheGazeDoesNot) {
  const auto style = [](Mood face, SpeechAct speech) { return style_of({GazeStrategy::nearest, face, speech}); };
  EXPECT_EQ(style(Mood::happy, SpeechAct::invite), Style::friendly);
  EXPECT_EQ(style(Mood::happy, SpeechAct::silence), Style::fairly_friendly);
  EXPECT_EQ(style(Mood::neutral, SpeechAct::ask), Style::fairly_friendly);
  EXPECT_EQ(style(Mood::neutral, SpeechAct::silence), Style::even);
  EXPECT_EQ(style(Mood::happy, SpeechAct::complain), Style::even);
  EXPECT_EQ(style(Mood::sad, SpeechAct::silence), Style::fairly_upset);
  EXPECT_EQ(style(Mood::angry, SpeechAct::demand), Style::upset);
  for (int i = 0; i < kAttractionActions; ++i) {
    AttractionAction action = attraction_action(i);
    const Style before = style_of(action);
    action.gaze = GazeStrategy::ahead;
    EXPECT_EQ(style_of(action), before);
  }
}

TEST(Style, FriendlinessFallsAlongTheOrder) {
  EXPECT_EQ(friendliness_of(Style::friendly), 1.0);
  EXPECT_EQ(friendliness_of(Style::fairly_friendly), 0.5);
  EXPECT_EQ(friendliness_of(Style::even), 0.0);
  EXPECT_EQ(friendliness_of(Style::fairly_upset), -0.5);
  EXPECT_EQ(friendliness_of(Style::upset), -1.0);
}

TEST(Style, DifferencesCountGazeFaceAndSpeech) {
  const AttractionAction action{GazeStrategy::nearest, Mood::happy, SpeechAct::invite};
  EXPECT_EQ(differences(action, action), 0);
  EXPECT_EQ(differences(action, {GazeStrategy::nearest, Mood::sad, SpeechAct::invite}), 1);
  EXPECT_EQ(differences(action, {GazeStrategy::ahead, Mood::sad, SpeechAct::silence}), 3);
}

}  // namespace
}  // namespace docent::interaction
