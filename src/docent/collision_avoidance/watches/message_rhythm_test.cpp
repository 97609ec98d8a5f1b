#include "docent/collision_avoidance/watches/message_rhythm.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::collision_avoidance::message_rhythm_test {
namespace {

/// A topic and what becomes of its messages.
struct Topic {
  double rate = 50.0;   // [1/s]
  double jitter = 0.0;  // [s] of the stamps
  double drop = 0.0;    // share
  double hold = 0.0;    // [s] nothing comes, every two seconds, and then all at once, stamped on arrival
  double now = 100.0;   // [s]
  Rng rng{3};
  MessageRhythm rhythm{};

  /// Share of the time in which it seems to miss many.
  double run(double duration) {
    double seeming = 0.0;
    double messages = 0.0;
    for (const double end = now + duration; now < end; now += 1.0 / rate, ++messages) {
      const double into = std::fmod(now, 2.0);
      const double held = into < hold ? hold - into + 0.001 * into : 0.0;
      if (!rng.chance(drop)) rhythm.receive(time_from_seconds(now + held + rng.uniform(0.0, jitter)));
      seeming += rhythm.misses_many() ? 1.0 : 0.0;
    }
    return seeming / messages;
  }
};

TEST(MessageRhythm, KnowsItsPeriodAfterTwoSeconds) {
  Topic topic;
  topic.run(1.9);
  EXPECT_EQ(topic.rhythm.period(), 0.0);
  topic.run(1.0);
  EXPECT_NEAR(topic.rhythm.period(), 0.02, 0.001);
}

TEST(MessageRhythm, JitterHiccupsAndOneInTenLostAreAnOrdinaryDay) {
  for (const double rate : {10.0, 20.0, 50.0, 100.0}) {
    SCOPED_TRACE(rate);
    EXPECT_EQ((Topic{.rate = rate, .jitter = 0.02}.run(600.0)), 0.0);
    EXPECT_EQ((Topic{.rate = rate, .jitter = 0.05}.run(600.0)), 0.0);
    EXPECT_EQ((Topic{.rate = rate, .hold = 0.1}.run(600.0)), 0.0);
    EXPECT_LT((Topic{.rate = rate, .jitter = 0.05, .drop = 0.1}.run(3600.0)), rate > 10.0 ? 0.002 : 0.03);
  }
}

TEST(MessageRhythm, WhoLosesAThirdIsFoundAndNobodyGetsUsedToIt) {
  for (const double rate : {20.0, 50.0, 100.0}) {
    SCOPED_TRACE(rate);
    Topic topic{.rate = rate, .jitter = 0.02};
    topic.run(10.0);
    topic.drop = 0.35;
    topic.run(5.0);
    EXPECT_GT(topic.run(120.0), 0.9);
    topic.drop = 0.0;
    topic.run(5.0);
    EXPECT_LT(topic.run(60.0), 0.01);
  }
}

TEST(MessageRhythm, WhoLosesHalfIsFoundSoon) {
  Topic topic{.rate = 20.0};
  topic.run(10.0);
  topic.drop = 0.5;
  EXPECT_GT(topic.run(4.0), 0.3);
}

TEST(MessageRhythm, DoublesOvertakenOnesAndAClockThatIsSetAreNoLossAndNoGain) {
  MessageRhythm rhythm{};
  double clock = 0.0;
  for (int i = 0; i < 3000; ++i) {
    if (i % 500 == 499) clock -= 0.6;
    const Time stamp = time_from_seconds(100.0 + 0.05 * i + clock);
    if (i % 10 == 3) continue;  // comes two later
    rhythm.receive(stamp);
    rhythm.receive(stamp);
    if (i % 10 == 5) rhythm.receive(stamp - seconds(0.1));
    EXPECT_FALSE(rhythm.misses_many()) << i;
  }
  EXPECT_NEAR(rhythm.period(), 0.05, 0.003);
}

}  // namespace
}  // namespace docent::collision_avoidance::message_rhythm_test
