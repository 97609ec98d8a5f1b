#include "docent/base/suggestion.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(Suggestion, NamesTheNearestWord) {
  const std::vector<std::string> known{"coarsening", "forget", "reach", "static_margin"};
  EXPECT_EQ(did_you_mean("reech", known), "; did you mean 'reach'?") << "a wrong letter";
  EXPECT_EQ(did_you_mean("each", known), "; did you mean 'reach'?") << "a missing one";
  EXPECT_EQ(did_you_mean("reaach", known), "; did you mean 'reach'?") << "one too many";
  EXPECT_EQ(did_you_mean("fogret", known), "; did you mean 'forget'?") << "two exchanged";
  EXPECT_EQ(did_you_mean("static_marign_m", known), "; did you mean 'static_margin'?") << "a long word may err more";
  EXPECT_EQ(did_you_mean("ab", {"abc", "ab", "a"}), "; did you mean 'ab'?") << "the nearest, not the first";
}

TEST(Suggestion, SaysNothingWhereNoWordIsNear) {
  EXPECT_EQ(did_you_mean("wings", {"coarsening", "forget", "reach"}), "");
  EXPECT_EQ(did_you_mean("roach", {"reach", "roast"}), "; did you mean 'reach'?");
  EXPECT_EQ(did_you_mean("rxxch", {"reach"}), "") << "two of five letters";
  EXPECT_EQ(did_you_mean("", {"a"}), "");
  EXPECT_EQ(did_you_mean("reach", {}), "");
  EXPECT_EQ(did_you_mean(std::string(5000, 'a'), {std::string(5000, 'a')}), "") << "no name is so long";
}

}  // namespace
}  // namespace docent
