#include "docent/telepresence/accounts/person.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(APerson, MayDoWhatLowerRanksMay) {
  for (const Rank own : {Rank::viewer, Rank::visitor, Rank::moderator, Rank::operator_}) {
    const Person person{"", "", own};
    for (const Rank least : {Rank::viewer, Rank::visitor, Rank::moderator, Rank::operator_})
      EXPECT_EQ(person.is_at_least(least), static_cast<int>(own) >= static_cast<int>(least));
  }
  EXPECT_STREQ(to_text(Rank::operator_), "operator");
}

}  // namespace
}  // namespace docent::telepresence
