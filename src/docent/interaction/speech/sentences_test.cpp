#include "docent/interaction/speech/sentences.h"

#include <gtest/gtest.h>

#include "docent/interaction/speech/dictionary.h"

namespace docent::interaction {
namespace {

TEST(Sentences, AreAllThereInEachLanguage) {
  for (int i = 0; i < kSentences; ++i) {
    const auto which = static_cast<Sentence>(i);
    const std::string english = sentence(which, "en", "Sputnik");
    for (const auto& [language, dictionary] : dictionaries()) {
      const std::string text = sentence(which, language, "Sputnik");
      EXPECT_GT(text.size(), 10U);
      EXPECT_EQ(text.find("{}"), std::string::npos);
      EXPECT_EQ(text == english, language == "en") << text;
      EXPECT_TRUE(std::string{".!?"}.find(text.back()) != std::string::npos);
    }
    EXPECT_EQ(english, sentence(which, "xx", "Sputnik"));
  }
  EXPECT_EQ(sentence(Sentence::driving, "en", "The cyclotron"), "I am on my way to the cyclotron. Please follow me!");
  EXPECT_EQ(sentence(Sentence::driving, "de", "The Who"), "Nächstes Ziel: The Who. Bitte folgen Sie mir!");
}

}  // namespace
}  // namespace docent::interaction
