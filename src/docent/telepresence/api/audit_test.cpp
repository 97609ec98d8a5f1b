#include "docent/telepresence/api/audit.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(TheAuditLog, GivesTheNewestFirstAndForgetsTheOldest) {
  auto database = std::move(*Database::open(":memory:"));
  auto audit = std::move(*Audit::open(*database));
  for (int i = 0; i < 5; ++i)
    ASSERT_TRUE(audit->add({time_from_seconds(i), "account:ada", "login", std::to_string(i), "192.0.2.1"}));
  const auto newest = *audit->newest(2);
  ASSERT_EQ(newest.size(), 2U);
  EXPECT_EQ(newest[0].about, "4");
  EXPECT_EQ(newest[1].about, "3");
  audit->forget_before(time_from_seconds(3));
  EXPECT_EQ(audit->newest(10)->size(), 2U);
}

}  // namespace
}  // namespace docent::telepresence
