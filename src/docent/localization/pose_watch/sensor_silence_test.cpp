#include "docent/localization/pose_watch/sensor_silence.h"

#include <gtest/gtest.h>

namespace docent::localization::sensor_silence_test {
namespace {

TEST(SensorSilence, TheFirstThatWasNotHeardForTooLongIsNamed) {
  const Time now = time_from_seconds(100.0);
  SensorSilence silence{{"odom", "scan_front", "scan_rear"}, seconds(1.5)};
  EXPECT_EQ(silence.first_silent(now), "odom") << "none was ever heard";
  for (std::size_t i = 0; i < 3; ++i) silence.hear(i, now);
  EXPECT_FALSE(silence.first_silent(now + seconds(1.5)));
  silence.hear(0, now + seconds(1.0));
  silence.hear(2, now + seconds(1.0));
  EXPECT_EQ(silence.first_silent(now + seconds(2.0)), "scan_front");
  EXPECT_EQ(silence.first_silent(now + seconds(9.0)), "odom");
}

TEST(SensorSilence, WhatHasNoSensorsIsNotSilent) {
  EXPECT_FALSE(SensorSilence({}, seconds(1.5)).first_silent(time_from_seconds(100.0)));
}

}  // namespace
}  // namespace docent::localization::sensor_silence_test
