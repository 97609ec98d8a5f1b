#include "docent/interaction/speech/dictionary.h"

#include <gtest/gtest.h>

#include "docent/base/files.h"
#include "docent/interaction/speech/dictionary_files.h"

namespace docent::interaction {
namespace {

TEST(Dictionary, EachFileIsWhole) {
  ASSERT_GE(dictionary_files().size(), 2U);
  for (const auto& [language, text] : dictionary_files()) {
    const auto dictionary = parse_dictionary(std::string{text}, std::string{language});
    ASSERT_TRUE(dictionary) << dictionary.error().message;
    for (std::size_t i = 0; i < dictionary->sentences.size(); ++i) {
      const std::string& sentence = dictionary->sentences.at(i);
      EXPECT_GT(sentence.size(), 5U) << language << ' ' << i;
      const bool has_place = sentence.find("{}") != std::string::npos;
      const bool english_has = dictionary_of("en").sentences.at(i).find("{}") != std::string::npos;
      EXPECT_EQ(has_place, english_has) << language << ": " << sentence;
    }
    EXPECT_EQ(dictionaries().count(std::string{language}), 1U);
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
}

}  // namespace
}  // namespace docent::interaction
