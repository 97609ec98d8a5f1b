#include "docent/telepresence/accounts/look_alikes.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(LookAlikes, WhatAReaderTakesForAnAccountsName) {
  // Cyrillic, Greek, wide, with a space of no width, mathematical.
  for (const char* name :
       {"ada", "Ada", " A D A ", "a.d-a", "\u0430da", "ad\u03b1", "\uff41\uff44\uff41", "a\u200bda", "\U0001d41ada"})
    EXPECT_TRUE(looks_like(name, "ada")) << name;
  for (const char* name : {"adam", "Ida", "", "eve", "a1da", "\u827e\u8fbe"})
    EXPECT_FALSE(looks_like(name, "ada")) << name;
  EXPECT_TRUE(looks_like("pauI", "paul")) << "a capital I";
  EXPECT_TRUE(looks_like("pau1", "paul"));
  EXPECT_TRUE(looks_like("OIiver", "oliver"));
  EXPECT_TRUE(looks_like("rnargaret", "margaret"));
  EXPECT_FALSE(looks_like("\xFF\xFE", "ada")) << "no text at all";
}

}  // namespace
}  // namespace docent::telepresence
