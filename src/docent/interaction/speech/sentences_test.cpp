#include "docent/interaction/speech/sentences.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "docent/interaction/speech/dictionary.h"

namespace docent::interaction::sentences_test {
namespace {

constexpr std::array kMoods{Mood::neutral, Mood::happy, Mood::sad, Mood::angry};

TEST(Sentences, AreAllThereInEachLanguage) {
  for (int i = 0; i < kSentences; ++i) {
    const auto which = static_cast<Sentence>(i);
    if (which == Sentence::room || which == Sentence::hallway) continue;  // names, not sentences
    for (const Mood mood : kMoods) {
      const std::string english = sentence(which, "en", mood, 0, "Sputnik");
      for (const auto& [language, dictionary] : dictionaries()) {
        ASSERT_GE(count_variants(which, language, mood), 1);
        for (int variant = 0; variant < count_variants(which, language, mood); ++variant) {
          const std::string text = sentence(which, language, mood, variant, "Sputnik");
          EXPECT_GT(text.size(), 10U);
          EXPECT_EQ(text.find("{}"), std::string::npos);
          EXPECT_EQ(text == english, language == "en" && variant == 0) << text;
          EXPECT_TRUE(std::string{".!?"}.find(text.back()) != std::string::npos);
        }
      }
      EXPECT_EQ(english, sentence(which, "xx", mood, 0, "Sputnik"));
    }
  }
}

TEST(Sentences, TakeTheTitleAsALanguageWritesIt) {
  const auto driving = [](const char* language, const char* title) {
    return sentence(Sentence::driving, language, Mood::neutral, 0, title);
  };
  EXPECT_EQ(driving("en", "The cyclotron"), "I am on my way to the cyclotron. Please follow me!");
  EXPECT_EQ(driving("de", "The Who"), "Nächstes Ziel: The Who. Bitte folgen Sie mir!");
}

TEST(Sentences, EachMoodAsksForTheWayInItsOwnWords) {
  for (const auto& [language, dictionary] : dictionaries()) {
    std::set<std::string> all;
    std::size_t count = 0;
    for (const Mood mood : kMoods) {
      for (int variant = 0; variant < count_variants(Sentence::let_me_through, language, mood); ++variant, ++count)
        all.insert(sentence(Sentence::let_me_through, language, mood, variant));
    }
    EXPECT_GE(count, 8U) << language;
    EXPECT_EQ(all.size(), count) << language;
  }
  EXPECT_EQ(sentence(Sentence::let_me_through, "en", Mood::neutral, 0), "Please let me through.");
}

TEST(Sentences, AMoodWithoutWordsTakesThoseOfAnother) {
  EXPECT_EQ(sentence(Sentence::waking, "en", Mood::angry, 7), sentence(Sentence::waking, "en", Mood::neutral, 0));
  EXPECT_EQ(sentence(Sentence::must_charge, "en", Mood::happy, 0), sentence(Sentence::must_charge, "en", Mood::sad, 0));
}

TEST(Sentences, EachSpeechActButSilenceHasASentenceOfItsOwn) {
  std::set<Sentence> said;
  for (const SpeechAct act : {SpeechAct::invite, SpeechAct::ask, SpeechAct::demand, SpeechAct::complain}) {
    const auto which = sentence_of(act);
    ASSERT_TRUE(which) << to_text(act);
    EXPECT_TRUE(is_spoken(*which)) << to_text(act);
    EXPECT_TRUE(said.insert(*which).second) << to_text(act);
  }
  EXPECT_FALSE(sentence_of(SpeechAct::silence));
}

TEST(Sentences, ThoseOfThePageAreNotSpokenAndEachHasItsKey) {
  EXPECT_FALSE(is_spoken(Sentence::charging));
  EXPECT_STREQ(to_text(Sentence::attract_demand), "attract_demand");
  EXPECT_STREQ(to_text(Sentence::let_me_through), "let_me_through");
}

}  // namespace
}  // namespace docent::interaction::sentences_test
