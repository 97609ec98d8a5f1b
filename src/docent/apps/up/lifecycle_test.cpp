#include "docent/apps/up/lifecycle.h"

#include <gtest/gtest.h>

namespace docent::apps::up_command {
namespace {

using Step = Lifecycle::Step;

Lifecycle::Time at(double seconds) {
  return Lifecycle::Time{} +
         std::chrono::duration_cast<Lifecycle::Time::duration>(std::chrono::duration<double>(seconds));
}

TEST(Lifecycle, BacksOffFromShortToLongAndForgetsAfterAGoodTime) {
  Lifecycle life{true};
  EXPECT_EQ(life.next(at(0)), Step::start);
  double now = 0;
  for (const double delay : {0.2, 0.4, 0.8, 1.6, 3.2, 5.0, 5.0}) {
    life.started(at(now));
    life.ended(at(now), "exit code 1");
    EXPECT_DOUBLE_EQ(life.delay_s(), delay);
    EXPECT_EQ(life.next(at(now + delay - 0.05)), Step::wait);
    EXPECT_EQ(life.next(at(now + delay + 0.01)), Step::start);
    now += delay + 0.01;
  }
  life.started(at(now));
  life.ended(at(now + 10.5), "signal 9");
  EXPECT_DOUBLE_EQ(life.delay_s(), 0.2);
  EXPECT_EQ(life.status(at(now + 10.5)), "ended (signal 9), starts again in 0.2 s");
}

TEST(Lifecycle, TellsSilenceAndKillsLateEnoughForAStopOfTenSeconds) {
  Lifecycle life{true};
  life.started(at(0));
  life.heard(at(1), "ready", "");
  EXPECT_EQ(life.status(at(2)), "ready");
  EXPECT_EQ(life.status(at(7)), "not responding for 6 s");
  EXPECT_EQ(life.next(at(11.5)), Step::wait);
  life.heard(at(11.5), "degraded", "no scan");
  EXPECT_EQ(life.status(at(12)), "degraded: no scan");
  EXPECT_EQ(life.next(at(26)), Step::wait);
  EXPECT_EQ(life.next(at(27)), Step::kill);
}

TEST(Lifecycle, ALongStartIsNoSilence) {
  Lifecycle life{true};
  life.started(at(0));
  EXPECT_EQ(life.status(at(30)), "starting");
  EXPECT_EQ(life.next(at(30)), Step::wait);
  EXPECT_EQ(life.next(at(61)), Step::kill);
}

TEST(Lifecycle, WithoutHealthNothingIsSilent) {
  Lifecycle life{false};
  life.started(at(0));
  EXPECT_EQ(life.next(at(1000)), Step::wait);
  EXPECT_EQ(life.status(at(1000)), "running");
}

TEST(Lifecycle, HealthOfADeadProcessDoesNotRaiseIt) {
  Lifecycle life{true};
  life.started(at(0));
  life.ended(at(1), "signal 11");
  life.heard(at(1.01), "ready", "");
  EXPECT_FALSE(life.is_running());
}

}  // namespace
}  // namespace docent::apps::up_command
