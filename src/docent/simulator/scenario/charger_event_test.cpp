#include "docent/simulator/scenario/charger_event.h"

#include <gtest/gtest.h>

#include <string>

#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator::charger_event_test {
namespace {

Result<Scenario> scenario(const std::string& fields) {
  return parse_scenario("events:\n  - {at: 3, charger: {" + fields + "}}\n", "s.yaml");
}

TEST(ChargerEvent, SaysWhatTheBatterySays) {
  const auto read = scenario("kind: claims, for: 90");
  ASSERT_TRUE(read) << read.error().message;
  const auto& event = std::get<ChargerFault>(read->events.at(0).what);
  EXPECT_EQ(event.kind, ChargerFault::Kind::claims);
  EXPECT_DOUBLE_EQ(event.duration, 90.0);
  EXPECT_EQ(std::get<ChargerFault>(scenario("kind: dead")->events.at(0).what).kind, ChargerFault::Kind::dead);
  EXPECT_EQ(std::get<ChargerFault>(scenario("kind: mute")->events.at(0).what).kind, ChargerFault::Kind::mute);
}

TEST(ChargerEvent, OtherKindsAndTimesAreRefused) {
  EXPECT_EQ(scenario("kind: off").error().message, "s.yaml:2: expected one of dead, claims, mute, found 'off'");
  EXPECT_FALSE(scenario("for: 3"));
  EXPECT_FALSE(scenario("kind: dead, for: -1"));
  EXPECT_FALSE(scenario("kind: dead, volts: 24"));
}

}  // namespace
}  // namespace docent::simulator::charger_event_test
