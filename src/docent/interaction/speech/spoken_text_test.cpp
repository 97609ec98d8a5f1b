#include "docent/interaction/speech/spoken_text.h"

#include <gtest/gtest.h>

namespace docent::interaction::spoken_text_test {
namespace {

TEST(SpokenText, LeavesTheWords) {
  EXPECT_EQ(spoken_text("# Sputnik\n\nThe *first* **satellite**,\nlaunched in `1957`.\n\n- It [beeped](https://x.y)\n"
                        "- ![a picture](a.png)It was small\n---\nThe end"),
            "Sputnik. The first satellite, launched in 1957. It beeped. It was small. The end.");
  EXPECT_EQ(spoken_text(""), "");
  EXPECT_EQ(spoken_text("  \n\t\n"), "");
  EXPECT_EQ(spoken_text("snake_case _stressed_ 3 \\* 4"), "snake_case stressed 3 * 4.");
  EXPECT_EQ(spoken_text("[open"), "[open.");
  EXPECT_EQ(spoken_text("a\x01\x02 b"), "a b.");
  EXPECT_EQ(spoken_text("Überraschung!"), "Überraschung!");
}

TEST(SpokenText, CountsWhatAReaderCounts) {
  EXPECT_EQ(count_code_points("Größe"), 5U);
  EXPECT_EQ(count_code_points(""), 0U);
}

TEST(SpokenText, LongerTextsTakeLonger) {
  EXPECT_EQ(speech_duration("", "en", Mood::neutral), 0.0);
  const std::string sentence = "This is a sentence of some length. ";
  std::string text;
  double before = 0.0;
  for (int i = 0; i < 20; ++i) {
    text += sentence;
    const double now = speech_duration(text, "de", Mood::neutral);
    EXPECT_GT(now, before);
    before = now;
  }
  EXPECT_GT(speech_duration(text, "de", Mood::sad), before);
  EXPECT_LT(speech_duration(text, "de", Mood::happy), before);
}

TEST(SpokenText, AnExhibitIsIntroducedByItsTitle) {
  EXPECT_EQ(introduction("The *clock*", "# It\n\nIt ticks"), "The clock. It. It ticks.");
  EXPECT_EQ(spoken_text(introduction("The *clock*", "It ticks")), introduction("The *clock*", "It ticks"))
      << "reading it again changes nothing";
}

}  // namespace
}  // namespace docent::interaction::spoken_text_test
