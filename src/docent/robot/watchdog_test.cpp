#include "docent/robot/watchdog.h"

#include <gtest/gtest.h>

#include <limits>

namespace docent::robot {
namespace {

TEST(CommandWatchdog, LetsFreshCommandsThrough) {
  CommandWatchdog watchdog{0.3, 0.8, 1.2};
  EXPECT_EQ(watchdog.output(time_from_seconds(0)), CommandWatchdog::Command{});
  watchdog.receive(time_from_seconds(1.0), {0.5, -0.2});
  EXPECT_EQ(watchdog.output(time_from_seconds(1.3)), (CommandWatchdog::Command{0.5, -0.2}));
}

TEST(CommandWatchdog, StopsWhenCommandsCease) {
  CommandWatchdog watchdog{0.3, 0.8, 1.2};
  watchdog.receive(time_from_seconds(1.0), {0.5, 0.0});
  EXPECT_EQ(watchdog.output(time_from_seconds(1.301)), CommandWatchdog::Command{});
  EXPECT_FALSE(watchdog.is_fresh(time_from_seconds(1.301)));
  watchdog.receive(time_from_seconds(2.0), {0.4, 0.0});
  EXPECT_EQ(watchdog.output(time_from_seconds(2.1)), (CommandWatchdog::Command{0.4, 0.0}));
}

TEST(CommandWatchdog, CutsOffAndRefuses) {
  CommandWatchdog watchdog{0.3, 0.8, 1.2};
  watchdog.receive(time_from_seconds(0), {5.0, -9.0});
  EXPECT_EQ(watchdog.output(time_from_seconds(0)), (CommandWatchdog::Command{0.8, -1.2}));
  watchdog.receive(time_from_seconds(0), {std::numeric_limits<double>::quiet_NaN(), 0.3});
  EXPECT_EQ(watchdog.output(time_from_seconds(0)), CommandWatchdog::Command{});
}

}  // namespace
}  // namespace docent::robot
