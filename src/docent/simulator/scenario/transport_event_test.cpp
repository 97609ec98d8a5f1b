#include "docent/simulator/scenario/transport_event.h"

#include <gtest/gtest.h>

#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator::transport_event_test {
namespace {

Result<Scenario> scenario(const std::string& fields) {
  return parse_scenario("events:\n  - {at: 3, transport: {" + fields + "}}\n", "s.yaml");
}

TEST(TransportEvent, NamesASensorAndWhatHappensToItsMessages) {
  const auto read = scenario(
      "sensor: odom, jitter: 0.05, hiccups: 6, hold: 0.2, stamps: receipt, reorder: 0.01, twice: 0.02, drop: 0.1, "
      "clock: -0.03, drift: 1e-4, set_back: 0.2, every: 30, for: 60");
  ASSERT_TRUE(read) << read.error().message;
  const auto& event = std::get<Transport>(read->events.at(0).what);
  EXPECT_EQ(event.sensor, Sensor::odom);
  EXPECT_DOUBLE_EQ(event.duration, 60.0);
  EXPECT_DOUBLE_EQ(event.wire.jitter, 0.05);
  EXPECT_DOUBLE_EQ(event.wire.hiccups, 6.0);
  EXPECT_DOUBLE_EQ(event.wire.hold, 0.2);
  EXPECT_EQ(event.wire.stamps, "receipt");
  EXPECT_DOUBLE_EQ(event.wire.reorder, 0.01);
  EXPECT_DOUBLE_EQ(event.wire.twice, 0.02);
  EXPECT_DOUBLE_EQ(event.wire.drop, 0.1);
  EXPECT_DOUBLE_EQ(event.wire.clock, -0.03);
  EXPECT_DOUBLE_EQ(event.wire.drift, 1e-4);
  EXPECT_DOUBLE_EQ(event.wire.set_back, 0.2);
  EXPECT_DOUBLE_EQ(event.wire.every, 30.0);
}

TEST(TransportEvent, MayBeOfAllSensors) {
  const auto read = scenario("sensor: all, drop: 0.1");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(std::get<Transport>(read->events.at(0).what).sensor);
  const auto infrared = scenario("sensor: infrared");
  ASSERT_TRUE(infrared);
  EXPECT_EQ(std::get<Transport>(infrared->events.at(0).what).sensor, Sensor::infrared);
}

TEST(TransportEvent, FaultsAreNamedWithTheirLine) {
  for (const auto& [fields, word] : std::vector<std::pair<std::string, std::string>>{
           {"drop: 0.1", "sensor"},
           {"sensor: nose, drop: 0.1", "laser_rear"},
           {"sensor: odom, drop: 2", "drop must be 0..1"},
           {"sensor: odom, stamps: never", "sending, receipt, moving or zero"},
           {"sensor: odom, for: -1", "'for'"},
           {"sensor: odom, jiter: 1", "jiter"}}) {
    const auto read = scenario(fields);
    ASSERT_FALSE(read) << fields;
    EXPECT_NE(read.error().message.find("s.yaml:2"), std::string::npos) << read.error().message;
    EXPECT_NE(read.error().message.find(word), std::string::npos) << read.error().message;
  }
}

}  // namespace
}  // namespace docent::simulator::transport_event_test
