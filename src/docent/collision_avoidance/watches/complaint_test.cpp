#include "docent/collision_avoidance/watches/complaint.h"

#include <gtest/gtest.h>

namespace docent::collision_avoidance::complaint_test {
namespace {

TEST(Complaint, TheMoreCautiousOfTwoWins) {
  const Complaint slow{0.25, "slow"};
  const Complaint stand{0.0, "stand"};
  EXPECT_FALSE(worse(std::nullopt, std::nullopt));
  EXPECT_EQ(worse(slow, std::nullopt)->reason, "slow");
  EXPECT_EQ(worse(std::nullopt, slow)->reason, "slow");
  EXPECT_EQ(worse(slow, stand)->reason, "stand");
  EXPECT_EQ(worse(stand, slow)->reason, "stand");
  EXPECT_EQ(worse(stand, Complaint{0.0, "as well"})->reason, "stand") << "of two alike the first";
}

/// Messages every 0.1 s until 102 s, the last one `late` [s].
Freshness until_102(double late) {
  Freshness freshness;
  for (int i = 0; i <= 20; ++i) {
    const Time now = time_from_seconds(100.0 + 0.1 * i);
    freshness.receive(now, i == 20 ? now - seconds(late) : now);
  }
  return freshness;
}

TEST(Complaint, NothingFreshStands) {
  EXPECT_EQ(complaint_of(Freshness{}, time_from_seconds(100.0), "sweep")->reason, "no fresh sweep");
  const Freshness freshness = until_102(0.0);
  EXPECT_FALSE(complaint_of(freshness, time_from_seconds(102.4), "sweep"));
  const auto silent = complaint_of(freshness, time_from_seconds(102.6), "sweep");
  ASSERT_TRUE(silent);
  EXPECT_EQ(silent->max_speed, 0.0);
  EXPECT_EQ(silent->reason, "no fresh sweep");
  EXPECT_FALSE(complaint_of(freshness, time_from_seconds(102.6), "sweep", {.patience = 0.8})) << "with more patience";
}

TEST(Complaint, LateIsSlowAndTooLateStands) {
  EXPECT_FALSE(complaint_of(until_102(0.15), time_from_seconds(102.0), "sweep"));
  const auto late = complaint_of(until_102(0.3), time_from_seconds(102.0), "sweep");
  ASSERT_TRUE(late);
  EXPECT_EQ(late->max_speed, ComplaintParams{}.crippled_speed);
  EXPECT_EQ(late->reason, "the sweep comes late");
  const auto too_late = complaint_of(until_102(0.6), time_from_seconds(102.0), "sweep");
  ASSERT_TRUE(too_late);
  EXPECT_EQ(too_late->max_speed, 0.0);
  EXPECT_EQ(too_late->reason, "the sweep comes late");
}

}  // namespace
}  // namespace docent::collision_avoidance::complaint_test
