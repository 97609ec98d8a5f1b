#include "docent/simulator/scenario/office_people.h"

#include <gtest/gtest.h>

namespace docent::simulator::office_people_test {
namespace {

TEST(OfficePeople, OrderOnceAndHelpAfterAWhile) {
  OfficePeople people;
  people.play({OfficeEvent::Kind::tidy, "", 5.0});
  const auto first = people.step(time_from_seconds(1.0));
  ASSERT_EQ(first.orders.size(), 1U);
  EXPECT_EQ(first.orders.front().kind, "tidy");
  EXPECT_TRUE(people.step(time_from_seconds(1.1)).orders.empty());
  docent_msgs::OfficeState state;
  state.order = first.orders.front().id, state.phase = "asking";
  state.points = true, state.x = 2.0, state.y = 3.0;
  people.see(state, time_from_seconds(10.0));
  EXPECT_TRUE(people.step(time_from_seconds(100.0)).presses.empty()) << "nobody helps";
  people.play({OfficeEvent::Kind::helper, "", 4.0});
  state.phase = "looking";
  people.see(state, time_from_seconds(110.0));
  state.phase = "asking";
  people.see(state, time_from_seconds(120.0));
  EXPECT_TRUE(people.step(time_from_seconds(123.0)).presses.empty());
  const auto helped = people.step(time_from_seconds(124.5));
  ASSERT_EQ(helped.presses.size(), 1U);
  ASSERT_TRUE(helped.takes);
  EXPECT_EQ(helped.takes->x, 2.0);
  EXPECT_TRUE(people.step(time_from_seconds(130.0)).presses.empty()) << "once";
}

}  // namespace
}  // namespace docent::simulator::office_people_test
