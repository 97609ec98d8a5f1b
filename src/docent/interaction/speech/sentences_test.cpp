#include "docent/interaction/speech/sentences.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(Sentences, AreAllThereInBothLanguages) {
  for (int i = 0; i < kSentences; ++i) {
    const auto which = static_cast<Sentence>(i);
    const std::string english = sentence(which, "en", "Sputnik");
    const std::string german = sentence(which, "de", "Sputnik");
    EXPECT_GT(english.size(), 10U);
    EXPECT_GT(german.size(), 10U);
    EXPECT_NE(english, german);
    EXPECT_EQ(english.find("{}"), std::string::npos);
    EXPECT_EQ(german.find("{}"), std::string::npos);
    EXPECT_EQ(english, sentence(which, "fr", "Sputnik"));
    EXPECT_TRUE(std::string{".!?"}.find(english.back()) != std::string::npos);
  }
  EXPECT_EQ(sentence(Sentence::driving, "en", "The cyclotron"), "I am on my way to the cyclotron. Please follow me!");
}

}  // namespace
}  // namespace docent
