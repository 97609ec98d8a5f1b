#include "docent/interaction/voice/pronunciation.h"

#include <gtest/gtest.h>

namespace docent::interaction {
namespace {

TEST(Pronunciation, PhonemesOfTheOneAlphabetInThoseOfTheOther) {
  EXPECT_EQ(cmu_phonemes("mjuːzˈiəm"), "M Y UW Z IY AH M");
  EXPECT_EQ(cmu_phonemes("tʃˈɜːtʃ"), "CH ER CH");
  EXPECT_EQ(cmu_phonemes("fˈaɪɚ"), "F AY ER");
  EXPECT_EQ(cmu_phonemes("wˈɔːɾɚ"), "W AO T ER");
  EXPECT_EQ(cmu_phonemes(""), "");
  EXPECT_EQ(cmu_phonemes("\n?"), "");
}

TEST(Pronunciation, EspeakSaysHowWordsSound) {
  const auto sounds = pronounce({"museum", "zuse", "--help"});
  ASSERT_TRUE(sounds) << sounds.error().message;
  EXPECT_EQ(sounds->at(0), "M Y UW Z IY AH M");
  EXPECT_EQ(sounds->at(1).front(), 'Z');
  EXPECT_FALSE(sounds->at(2).empty()) << "a word, and no option";
  EXPECT_FALSE(pronounce({"..."})) << "that has no sound";
}

}  // namespace
}  // namespace docent::interaction
