#include "docent/localization/judgement/hindrance.h"

#include <gtest/gtest.h>

namespace docent::localization::hindrance_test {
namespace {

/// A robot that knows its place.
Doubt none() {
  Doubt doubt;
  doubt.mass = 1.0;
  doubt.confirmation = 1.0;
  doubt.agreement = 0.8;
  return doubt;
}

TEST(Hindrance, NothingHindersWhoKnowsItsPlace) { EXPECT_EQ(hindrance_of(none(), {}), ""); }

TEST(Hindrance, AContradictionIsNamedWithItsShareBeforeAllElse) {
  Doubt doubt = none();
  doubt.contradiction = 0.7;
  doubt.agreement = 0.1;
  doubt.share = 0.3;
  doubt.confirmation = 0.0;
  EXPECT_NE(hindrance_of(doubt, {}).find("70 % of the readings pass through walls"), std::string::npos);
}

TEST(Hindrance, EachHasItsWords) {
  struct Case {
    double Doubt::*what;
    double value;
    const char* words;
  };
  for (const Case& one :
       {Case{&Doubt::mass, 0.0, "seen nothing"}, Case{&Doubt::agreement, 0.1, "explains only 10 %"},
        Case{&Doubt::unmapped, 0.5, "not on the map"}, Case{&Doubt::share, 0.5, "others look like it"},
        Case{&Doubt::mass, 0.5, "50 % of the belief"}, Case{&Doubt::spread, 1.0, "1.0 m"},
        Case{&Doubt::confirmation, 0.5, "not borne out"}}) {
    Doubt doubt = none();
    doubt.*one.what = one.value;
    EXPECT_NE(hindrance_of(doubt, {}).find(one.words), std::string::npos) << hindrance_of(doubt, {});
  }
}

}  // namespace
}  // namespace docent::localization::hindrance_test
