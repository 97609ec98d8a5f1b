#include "docent/modules/shared/sensor_time.h"

#include <gtest/gtest.h>

#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

nav_msgs::Odometry odometry_of(Time stamp, double x, double velocity) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = to_message(stamp);
  odometry.pose.pose = to_message(Pose2{x, 0.0, {}});
  odometry.twist.twist.linear.x = velocity;
  return odometry;
}

sensor_msgs::LaserScan scan_of(Time stamp) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = to_message(stamp);
  return scan;
}

class SensorTimes : public ::testing::Test {
 protected:
  void wait(double time) { hub.run_until(hub.now() + seconds(time)); }
  transport::VirtualTimeHub hub;
  std::unique_ptr<transport::Bus> bus = hub.connect("module");
  SensorTime times{*bus};
};

TEST_F(SensorTimes, WhatIsLateByMoreThanAnyHonestWayIsNotTakenForAClockOfItsOwn) {
  // Stamped on arrival, 0.3 s after the sweep: `calibrate` has found that.
  const ScannerPlace late{{}, 0.3};
  for (int i = 0; i < 50; ++i) {
    wait(0.1);
    EXPECT_EQ(times.of(odometry_of(bus->now(), 0.1 * i, 0.5)), bus->now());
    EXPECT_EQ(times.of(0, scan_of(bus->now()), late), bus->now() - seconds(0.3));
    EXPECT_EQ(times.of(1, scan_of(bus->now())), bus->now()) << "the other one has nothing to do with it";
  }
}

TEST_F(SensorTimes, TheDelayCountsAfterTheClock) {
  const ScannerPlace late{{}, 0.1};
  for (int i = 0; i < 50; ++i) {
    wait(0.1);
    (void)times.of(odometry_of(bus->now(), 0.1 * i, 0.5));
    const Time taken = times.of(0, scan_of(bus->now() - seconds(5.0)), late);
    EXPECT_NEAR(to_seconds(bus->now() - taken), 0.1, 1e-6) << "its clock is 5 s behind";
  }
}

TEST_F(SensorTimes, WhoStampsNothingOrRepeatsItselfIsOfNow) {
  wait(100.0);
  EXPECT_EQ(times.of(odometry_of({}, 1.0, 0.3)), bus->now());
  EXPECT_EQ(times.of("sonars", {}), bus->now());
  const Time stamp = bus->now();
  for (int i = 0; i < 40; ++i, wait(0.1)) {
    const Time taken = times.of(odometry_of(stamp, 1.5, 0.0));
    if (i > 1) {
      EXPECT_EQ(taken, bus->now());
    }
  }
}

}  // namespace
}  // namespace docent::modules
