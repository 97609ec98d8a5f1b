#include "docent/simulator/scenario/office_event.h"

#include <gtest/gtest.h>

#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator::office_event_test {
namespace {

TEST(OfficeEvents, AreRead) {
  const auto read = parse_scenario(
      "events:\n  - {at: 1, office: {kind: deliver, room: kitchen}}\n  - {at: 2, office: {kind: helper, after: 3}}\n",
      "s.yaml");
  ASSERT_TRUE(read) << read.error().message;
  const auto& first = std::get<OfficeEvent>(read->events[0].what);
  EXPECT_EQ(first.kind, OfficeEvent::Kind::deliver);
  EXPECT_EQ(first.room, "kitchen");
  EXPECT_EQ(std::get<OfficeEvent>(read->events[1].what).after, 3.0);
}

TEST(OfficeEvents, AreRefusedWhereTheyAreNone) {
  for (const char* event : {"{kind: deliver}", "{kind: sing}", "{kind: helper, after: 0}", "{}"})
    EXPECT_FALSE(parse_scenario("events:\n  - {at: 1, office: " + std::string{event} + "}\n", "s.yaml")) << event;
}

}  // namespace
}  // namespace docent::simulator::office_event_test
