#include "docent/museum/languages.h"

#include <gtest/gtest.h>

namespace docent::museum {
namespace {

TEST(Languages, AreThoseOfIso639) {
  for (const char* code : {"en", "de", "fr", "aa", "zu"}) EXPECT_TRUE(is_language(code)) << code;
  for (const char* code : {"", "e", "eng", "xx", "EN", "a ", " a", "  "}) EXPECT_FALSE(is_language(code)) << code;
}

TEST(Languages, Utf8IsChecked) {
  for (const char* text : {"", "plain", "Größe", "日本", "🙂"}) EXPECT_TRUE(is_utf8(text)) << text;
  for (const char* text : {"\xfc", "M\xfcnze", "\xc3", "\xe6\x97", "\x80", "\xff\xfe"}) EXPECT_FALSE(is_utf8(text));
}

}  // namespace
}  // namespace docent::museum
