#include "docent/interaction/voice/voice_grammar.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::interaction {
namespace {

museum::Museum museum_to_talk_to() {
  museum::Museum museum;
  museum.languages = {"en"};
  const auto exhibit = [&](const std::string& id, const std::string& title, bool web_only) {
    museum.exhibits.emplace_back();
    museum.exhibits.back().id = id;
    museum.exhibits.back().title = {{"en", title}};
    museum.exhibits.back().web_only = web_only;
  };
  exhibit("heart-lung", "The heart-lung machine", false);
  exhibit("zuse", "Zuse's computer Z4", false);
  exhibit("depot", "The depot", true);
  museum.tours = {{"highlights", {{"en", "The highlights"}}, {"zuse"}, {}, {}}};
  museum.rooms = {{"hall", {{"en", "The great hall"}}, {}}};
  return museum;
}

std::optional<VoiceCommand> meant(const VoiceGrammar& grammar, const std::string& said) {
  return grammar.command_of(said_words(said));
}

TEST(VoiceGrammar, WordsAreWhatPeopleSay) {
  EXPECT_EQ(said_words("The heart-lung machine"), (std::vector<std::string>{"the", "heart", "lung", "machine"}));
  EXPECT_EQ(said_words("Zuse's \"Z4\", 1944!"), (std::vector<std::string>{"zuse's", "z4", "1944"}));
  EXPECT_EQ(said_words("Röntgen"), (std::vector<std::string>{"röntgen"}));
  EXPECT_TRUE(said_words(" -- ").empty());
}

TEST(VoiceGrammar, KnowsWhatIsMeant) {
  using Kind = VoiceCommand::Kind;
  const VoiceGrammar grammar{museum_to_talk_to(), true};
  EXPECT_EQ(meant(grammar, "Please take me to the heart lung machine"), (VoiceCommand{Kind::exhibit, "heart-lung"}));
  EXPECT_EQ(meant(grammar, "show me Zuse's computer Z4"), (VoiceCommand{Kind::exhibit, "zuse"}));
  EXPECT_EQ(meant(grammar, "start the tour the highlights"), (VoiceCommand{Kind::tour, "highlights"}));
  EXPECT_EQ(meant(grammar, "drive to the great hall"), (VoiceCommand{Kind::room, "hall"}));
  EXPECT_EQ(meant(grammar, "tell me more"), (VoiceCommand{Kind::more, ""}));
  EXPECT_EQ(meant(grammar, "stop the tour"), (VoiceCommand{Kind::end_tour, ""}));
  EXPECT_EQ(meant(grammar, "show me the depot"), std::nullopt) << "for the Web only";
  EXPECT_EQ(meant(grammar, "the heart lung machine"), std::nullopt);
  EXPECT_EQ(meant(grammar, ""), std::nullopt);
}

TEST(VoiceGrammar, WhatIsCalledAlikeIsMeantOnce) {
  museum::Museum museum = museum_to_talk_to();
  museum.rooms.push_back({"other", {{"en", "Great Hall"}}, {}});
  const VoiceGrammar grammar{museum, true};
  EXPECT_EQ(meant(grammar, "go to the great hall")->target, "hall");
  EXPECT_EQ(grammar.size(), (VoiceGrammar{museum_to_talk_to(), true}.size()));
}

TEST(VoiceGrammar, IsWrittenWithTheTokensOfTheDictionary) {
  const VoiceGrammar grammar{museum_to_talk_to(), true};
  const auto words = grammar.words();
  EXPECT_TRUE(std::is_sorted(words.begin(), words.end()));
  EXPECT_TRUE(std::binary_search(words.begin(), words.end(), "z4"));
  EXPECT_TRUE(std::binary_search(words.begin(), words.end(), "please"));
  const std::string text = grammar.jsgf({{"z4", "unwritten1"}});
  EXPECT_EQ(text.find("z4"), std::string::npos);
  EXPECT_NE(text.find("zuse's computer unwritten1;"), std::string::npos) << text;
}

}  // namespace
}  // namespace docent::interaction
