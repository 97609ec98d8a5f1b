#include "docent/simulator/transport/wire.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::simulator::wire_test {
namespace {

constexpr double kPeriod = 0.05;  // [s]

struct Message {
  Time sent, came, stamp;
};

Time at(double time) { return time_from_seconds(100.0 + time); }

/// What comes of ten minutes of a sensor of 20 Hz, in the order of sending.
std::vector<Message> carry(const WireParams& params, std::uint64_t seed = 1) {
  EXPECT_TRUE(params.validate());
  Wire wire{params, Rng{seed}, at(0.0)};
  std::vector<Message> messages;
  for (int i = 0; i < 12000; ++i) {
    const Time now = at(kPeriod * i);
    for (const auto& delivery : wire.carry(now)) {
      EXPECT_GE(delivery.after.count(), 0);
      messages.push_back({now, now + delivery.after, delivery.stamp});
    }
  }
  return messages;
}

double share_late(const std::vector<Message>& messages, double by) {
  const auto late = std::count_if(messages.begin(), messages.end(),
                                  [&](const Message& message) { return message.came - message.sent > seconds(by); });
  return static_cast<double>(late) / static_cast<double>(messages.size());
}

bool is_in_order(const std::vector<Message>& messages) {
  return std::is_sorted(messages.begin(), messages.end(),
                        [](const Message& a, const Message& b) { return a.came < b.came; });
}

TEST(Wire, CarriesEveryMessageAtOnce) {
  const auto messages = carry({});
  ASSERT_EQ(messages.size(), 12000U);
  for (const Message& message : messages) {
    EXPECT_EQ(message.came, message.sent);
    EXPECT_EQ(message.stamp, message.sent);
  }
}

TEST(Wire, ADelayIsTheSameForAll) {
  for (const Message& message : carry({.delay = 0.15})) {
    EXPECT_EQ(message.came - message.sent, seconds(0.15));
    EXPECT_EQ(message.stamp, message.sent);
  }
  for (const Message& message : carry({.delay = 0.15, .stamps = "receipt"})) EXPECT_EQ(message.stamp, message.came);
  EXPECT_GT(share_late(carry({.delay = 0.1, .jitter = 0.1}), 0.15), 0.4);
}

TEST(Wire, StampsAreThoseOfDriversThatAreUnlikeOurs) {
  for (const Message& message : carry({.stamps = "zero"})) EXPECT_EQ(message.stamp, Time{});
  Wire wire{{.stamps = "moving", .clock = 2.0}, Rng{1}, at(0.0)};
  EXPECT_EQ(wire.carry(at(1.0), true).front().stamp, at(3.0));
  EXPECT_EQ(wire.carry(at(1.1), false).front().stamp, at(3.0)) << "it repeats itself";
  EXPECT_EQ(wire.carry(at(1.2), true).front().stamp, at(3.2));
}

TEST(Wire, JitterIsEvenAndOvertakesNothing) {
  const auto messages = carry({.jitter = 0.08});
  EXPECT_EQ(share_late(messages, 0.082), 0.0);
  EXPECT_NEAR(share_late(messages, 0.06), 0.25, 0.03);
  EXPECT_TRUE(is_in_order(messages));
  for (const Message& message : messages) EXPECT_EQ(message.stamp, message.sent);
}

TEST(Wire, WhatWasHeldComesAtOnce) {
  const auto messages = carry({.hiccups = 6.0, .hold = 0.5});
  EXPECT_TRUE(is_in_order(messages));
  // Sixty of 0.3 s on average in 600 s: a share of 0.03 is held at all.
  EXPECT_NEAR(share_late(messages, 0.001), 0.03, 0.012);
  EXPECT_EQ(share_late(messages, 0.51), 0.0);
  int bursts = 0;
  for (std::size_t i = 1; i < messages.size(); ++i)
    bursts += messages[i].came - messages[i - 1].came < seconds(0.002) ? 1 : 0;
  EXPECT_GT(bursts, 150);
}

TEST(Wire, DriversThatStampOnReceiptKnowNothingOfTheWay) {
  for (const Message& message : carry({.jitter = 0.05, .hiccups = 6.0, .stamps = "receipt"}))
    EXPECT_EQ(message.stamp, message.came);
}

TEST(Wire, SomeAreLostSomeComeTwiceSomeAreOvertaken) {
  EXPECT_NEAR(static_cast<double>(carry({.drop = 0.1}).size()), 10800.0, 150.0);
  const auto twice = carry({.twice = 0.1});
  EXPECT_NEAR(static_cast<double>(twice.size()), 13200.0, 150.0);
  const auto overtaken = carry({.reorder = 0.1});
  EXPECT_NEAR(share_late(overtaken, 0.019), 0.1, 0.02);
  EXPECT_FALSE(is_in_order(overtaken));
}

TEST(Wire, AClockIsAheadRunsFastAndIsSetBack) {
  for (const Message& message : carry({.clock = 0.03, .drift = 1e-4, .set_back = 0.2, .every = 60.0})) {
    const double since = to_seconds(message.sent - at(0.0));
    EXPECT_NEAR(to_seconds(message.stamp - message.sent), 0.03 + 1e-4 * since - 0.2 * std::floor(since / 60.0), 1e-8);
  }
}

TEST(Wire, ASeedGivesTheSameWay) {
  const WireParams all{.jitter = 0.05, .hiccups = 6.0, .reorder = 0.05, .twice = 0.05, .drop = 0.1};
  const auto same = [](const Message& a, const Message& b) { return a.came == b.came && a.stamp == b.stamp; };
  const auto once = carry(all, 7);
  const auto again = carry(all, 7);
  EXPECT_TRUE(std::equal(once.begin(), once.end(), again.begin(), again.end(), same));
  const auto other = carry(all, 8);
  EXPECT_FALSE(std::equal(once.begin(), once.end(), other.begin(), other.end(), same));
}

TEST(Wire, WhatCannotBeIsRefused) {
  for (const WireParams& params : {WireParams{.jitter = -0.1}, WireParams{.hold = 0.0}, WireParams{.stamps = "never"},
                                   WireParams{.drop = 1.1}, WireParams{.drift = 1.0}, WireParams{.every = 0.0}})
    EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::simulator::wire_test
