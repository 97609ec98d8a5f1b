#include "docent/interaction/speech/dictionary.h"

#include <gtest/gtest.h>

#include <set>

#include "docent/base/files.h"
#include "docent/interaction/speech/dictionary_files.h"

namespace docent::interaction::dictionary_test {
namespace {

std::string any_text(const Phrasing& phrasing) {
  for (const auto& variants : phrasing.by_mood) {
    if (!variants.empty()) return variants.front();
  }
  return "";
}

TEST(Dictionary, EachFileIsWhole) {
  ASSERT_GE(dictionary_files().size(), 2U);
  for (const auto& [language, text] : dictionary_files()) {
    const auto dictionary = parse_dictionary(std::string{text}, std::string{language});
    ASSERT_TRUE(dictionary) << dictionary.error().message;
    for (std::size_t i = 0; i < dictionary->sentences.size(); ++i) {
      const bool english_has = any_text(dictionary_of("en").sentences.at(i)).find("{}") != std::string::npos;
      for (const auto& variants : dictionary->sentences.at(i).by_mood) {
        for (const std::string& sentence : variants) {
          EXPECT_GT(sentence.size(), 5U) << language << ' ' << i;
          EXPECT_EQ(sentence.find("{}") != std::string::npos, english_has) << language << ": " << sentence;
        }
        EXPECT_EQ(std::set<std::string>(variants.begin(), variants.end()).size(), variants.size())
            << language << ": the same variant twice in " << to_text(static_cast<Sentence>(i));
      }
    }
    EXPECT_EQ(dictionaries().count(std::string{language}), 1U);
  }
}

TEST(Dictionary, EachLanguageHasWordsForTheSameMoods) {
  for (const auto& [language, dictionary] : dictionaries()) {
    for (std::size_t i = 0; i < dictionary.sentences.size(); ++i) {
      for (std::size_t mood = 0; mood < words_of(Mood{}).size(); ++mood) {
        const auto& here = dictionary.sentences.at(i).by_mood.at(mood);
        const auto& english = dictionary_of("en").sentences.at(i).by_mood.at(mood);
        EXPECT_EQ(here.empty(), english.empty())
            << language << ": " << to_text(static_cast<Sentence>(i)) << ' ' << words_of(Mood{}).at(mood);
      }
    }
  }
}

TEST(Dictionary, TheFilesOfTheFolderAreInTheProgram) {
  const std::filesystem::path folder = "src/docent/interaction/speech/languages";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator{folder}) {
    if (entry.path().extension() != ".yaml") continue;
    ++files;
    const auto text = read_file(entry.path());
    ASSERT_TRUE(text);
    bool is_there = false;
    for (const auto& [language, known] : dictionary_files())
      is_there = is_there || (language == entry.path().stem().string() && known == *text);
    EXPECT_TRUE(is_there) << entry.path();
  }
  EXPECT_EQ(files, dictionary_files().size());
}

TEST(Dictionary, AnotherLanguageGetsEnglish) {
  EXPECT_EQ(&dictionary_of("xx"), &dictionary_of("en"));
  EXPECT_NE(&dictionary_of("de"), &dictionary_of("en"));
}

TEST(Dictionary, AFaultNamesFileAndKey) {
  const std::string whole{dictionary_files().front().second};
  const auto fault = [](const std::string& text) {
    const auto dictionary = parse_dictionary(text, "xx.yaml");
    return dictionary ? std::string{} : dictionary.error().message;
  };
  EXPECT_EQ(fault(whole), "");
  EXPECT_NE(fault(whole + "  goodbye: \"Bye.\"\n").find("goodbye"), std::string::npos)
      << fault(whole + "  goodbye: x\n");
  const auto at = whole.find("  waking:");
  const std::string without = whole.substr(0, at) + whole.substr(whole.find('\n', at) + 1);
  EXPECT_NE(fault(without).find("waking"), std::string::npos) << fault(without);
  EXPECT_NE(fault("articles: []\n").find("xx.yaml"), std::string::npos);
  const auto instead = [&](const std::string& waking) {
    return fault(whole.substr(0, at) + "  waking:" + waking + "\n" + whole.substr(whole.find('\n', at) + 1));
  };
  EXPECT_EQ(instead(" {happy: [Hello., Good day.]}"), "");
  EXPECT_NE(instead(" {happy: []}").find("waking"), std::string::npos);
  EXPECT_NE(instead(" {merry: [Hello.]}").find("merry"), std::string::npos);
  EXPECT_NE(instead(" {happy: [Hello., 'Hello, {}.']}").find("some of its texts"), std::string::npos);
  EXPECT_NE(instead(" {happy: [Hello., '']}").find("empty"), std::string::npos);
  EXPECT_NE(instead(" [Hello.]").find("xx.yaml"), std::string::npos);
  EXPECT_NE(fault(whole.substr(0, whole.find("sentences:"))).find("sentences"), std::string::npos);
}

}  // namespace
}  // namespace docent::interaction::dictionary_test
