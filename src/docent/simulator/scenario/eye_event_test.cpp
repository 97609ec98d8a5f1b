#include "docent/simulator/scenario/eye_event.h"

#include <gtest/gtest.h>

#include "docent/simulator/scenario/scenario.h"

namespace docent::simulator {
namespace {

TEST(EyeEvent, IsReadWithItsTimes) {
  const auto scenario = parse_scenario(
      "events:\n  - {at: 1, eye: {eye: ceiling, kind: exposure, gain: 2.5, for: 4}}\n  - {at: 2, eye: {eye: depth, "
      "kind: late}}\n",
      "s.yaml");
  ASSERT_TRUE(scenario) << scenario.error().message;
  const auto& exposure = std::get<EyeFault>(scenario->events[0].what);
  EXPECT_EQ(exposure.eye, EyeFault::Eye::ceiling);
  EXPECT_EQ(exposure.kind, EyeFault::Kind::exposure);
  EXPECT_DOUBLE_EQ(exposure.gain, 2.5);
  EXPECT_DOUBLE_EQ(exposure.duration, 4.0);
  EXPECT_EQ(std::get<EyeFault>(scenario->events[1].what).kind, EyeFault::Kind::late);
}

TEST(EyeEvent, NamesWhatIsWrong) {
  for (const auto& [text, complaint] : {std::pair{"{eye: nose, kind: gone}", "expected one of depth, ceiling"},
                                        {"{eye: depth, kind: blind}", "expected one of gone, frozen"},
                                        {"{eye: depth, kind: late, delay: 0}", "'delay' must be above 0"},
                                        {"{eye: depth, kind: gone, for: -1}", "'for' must be"},
                                        {"{eye: depth}", "kind"}}) {
    const auto scenario = parse_scenario("events:\n  - {at: 1, eye: " + std::string{text} + "}\n", "s.yaml");
    ASSERT_FALSE(scenario) << text;
    EXPECT_NE(scenario.error().message.find("s.yaml:2"), std::string::npos) << scenario.error().message;
    EXPECT_NE(scenario.error().message.find(complaint), std::string::npos) << scenario.error().message;
  }
}

}  // namespace
}  // namespace docent::simulator
