#include "docent/vocabulary/reason.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(Reason, ComesBackFromItsText) {
  for (std::size_t i = 0; i < words_of(ReasonWord{}).size(); ++i) {
    const auto word = static_cast<ReasonWord>(i);
    EXPECT_EQ(Reason{word}.text(), to_text(word));
    for (const Reason& reason : {Reason{word}, Reason{word, "sputnik"}, Reason{word, "sputnik the_vase"}}) {
      const Reason back = Reason::from_text(reason.text());
      EXPECT_EQ(back, reason) << reason.text();
      EXPECT_EQ(back.word(), word);
    }
  }
  EXPECT_EQ(Reason(ReasonWord::not_reached, "a b").text(), "not_reached a b");
}

TEST(Reason, NoneIsEmpty) {
  EXPECT_TRUE(Reason{}.is_none());
  EXPECT_EQ(Reason{}.text(), "");
  EXPECT_EQ(Reason::from_text(""), Reason{});
  EXPECT_FALSE(Reason{ReasonWord::closed}.is_none());
}

TEST(Reason, WhatIsNoWordIsKeptAsItCame) {
  for (const std::string text : {"The museum is closed.", "closed.", " closed", "Closed", "no_such_exhibit_"}) {
    const Reason reason = Reason::from_text(text);
    EXPECT_EQ(reason.word(), std::nullopt) << text;
    EXPECT_EQ(reason.text(), text);
    EXPECT_FALSE(reason.is_none());
  }
}

}  // namespace
}  // namespace docent
