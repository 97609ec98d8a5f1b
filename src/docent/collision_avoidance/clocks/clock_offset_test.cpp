#include "docent/collision_avoidance/clocks/clock_offset.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/base/random.h"

namespace docent::collision_avoidance::clock_offset_test {
namespace {

/// A topic whose clock may be off, and whose messages may come late.
struct Topic {
  double period = 0.05;  // [s]
  double clock = 0.0;    // [s] ahead
  double late = 0.0;     // [s] each comes so much later
  double jitter = 0.0;   // [s] more than that, evenly
  double drop = 0.0;     // share
  double reorder = 0.0;  // share that comes after the next
  double now = 100.0;    // [s]
  Rng rng{5};
  ClockOffset offset{};
  double came = 0.0;       // [s] the last one
  double overtaken = 0.0;  // [s] when it was sent; 0: none is on its way

  void run(double duration) {
    for (const double end = now + duration; now < end; now += period) {
      if (rng.chance(drop)) continue;
      const double comes = std::max(came + 1e-4, now + late + rng.uniform(0.0, jitter));
      if (rng.chance(reorder)) {
        overtaken = now;
        continue;
      }
      receive(comes, now);
      if (overtaken > 0.0) receive(comes + 1e-3, overtaken);
      overtaken = 0.0;
    }
  }

  void receive(double comes, double sent) {
    came = comes;
    offset.receive(time_from_seconds(comes), time_from_seconds(sent + clock));
  }
};

TEST(ClockOffset, IsTheLeastDelay) {
  Topic topic{.clock = -3.0, .jitter = 0.05};
  topic.run(20.0);
  EXPECT_NEAR(topic.offset.least_delay(), 3.0, 0.005);
  EXPECT_EQ(topic.offset.set_back(), 0.0);
}

TEST(ClockOffset, WhoComesLaterForGoodIsLateAndNotSetBack) {
  for (const double period : {0.01, 0.05, 0.1}) {
    for (const double late : {0.3, 0.5, 2.0}) {
      SCOPED_TRACE(late);
      Topic topic{.period = period, .jitter = 0.03, .drop = 0.1, .reorder = 0.02};
      topic.run(20.0);
      topic.late = late;
      topic.run(20.0);
      EXPECT_GT(topic.offset.lateness(), late - 0.05);
      EXPECT_EQ(topic.offset.set_back(), 0.0);
    }
  }
}

TEST(ClockOffset, AClockThatWasSetBackIsNotLate) {
  for (const double period : {0.01, 0.05, 0.1}) {
    for (const double back : {0.2, 0.5, 30.0}) {
      for (const bool rough : {false, true}) {
        SCOPED_TRACE(testing::Message() << period << " " << back << " " << rough);
        Topic topic{.period = period, .jitter = rough ? 0.05 : 0.0, .drop = rough ? 0.1 : 0.0};
        topic.run(20.0);
        topic.clock = -back;
        topic.run(3.0);
        EXPECT_NEAR(topic.offset.set_back(), back, rough ? 0.03 : 1e-3);
        topic.run(5.0);
        EXPECT_LT(topic.offset.lateness(), 0.06);
        topic.clock = 0.0;  // and forward again
        topic.run(5.0);
        EXPECT_NEAR(topic.offset.set_back(), 0.0, 0.03);
        EXPECT_LT(topic.offset.lateness(), 0.06);
      }
    }
  }
}

TEST(ClockOffset, WhoWasOvertakenTellsNothingOfTheClock) {
  Topic topic{.jitter = 0.02, .reorder = 0.1};
  topic.run(600.0);
  EXPECT_NEAR(topic.offset.set_back(), 0.0, 0.005);
  EXPECT_NEAR(topic.offset.least_delay(), 0.0, 0.005);
}

}  // namespace
}  // namespace docent::collision_avoidance::clock_offset_test
