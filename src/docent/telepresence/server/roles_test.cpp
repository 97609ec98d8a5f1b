#include "docent/telepresence/server/roles.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(Roles, PagesOfOtherSitesMayNotOpenTheChannel) {
  const std::vector<std::string> others{"museum.test"};
  for (const char* origin : {"", "http://robot.test", "https://robot.test", "https://ROBOT.test", "http://museum.test"})
    EXPECT_EQ(role_of({origin, "robot.test"}, others), Role::visitor) << origin;
  for (const char* origin : {"http://evil.test", "null", "http://robot.test.evil.test", "http://http://robot.test"})
    EXPECT_EQ(role_of({origin, "robot.test"}, others), std::nullopt) << origin;
}

TEST(Roles, AnObserverOnlyWatches) {
  const ClientMessage watch = WatchMessage{true};
  const std::vector<ClientMessage> wishes{RequestMessage{}, CancelMessage{}, ChoiceMessage{}};
  for (const Role role : {Role::observer, Role::visitor, Role::staff}) {
    EXPECT_TRUE(may_ask(role, watch));
    for (const ClientMessage& wish : wishes) EXPECT_EQ(may_ask(role, wish), role != Role::observer);
  }
}

}  // namespace
}  // namespace docent::telepresence
