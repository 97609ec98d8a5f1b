#include "docent/telepresence/server/roles.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(Roles, PagesOfOtherSitesMayNotOpenTheChannel) {
  const std::vector<std::string> others{"museum.test"};
  for (const char* origin : {"", "http://robot.test", "https://robot.test", "https://ROBOT.test", "http://museum.test"})
    EXPECT_EQ(role_of({origin, "robot.test", ""}, others, "k1"), Role::visitor) << origin;
  for (const char* origin : {"http://evil.test", "null", "http://robot.test.evil.test", "http://http://robot.test"})
    EXPECT_EQ(role_of({origin, "robot.test", ""}, others, "k1"), std::nullopt) << origin;
}

TEST(Roles, ThePortOfTheSchemeGoesWithoutSaying) {
  EXPECT_EQ(role_of({"https://robot.test", "robot.test:443", ""}, {}, ""), Role::visitor);
  EXPECT_EQ(role_of({"http://robot.test", "robot.test:80", ""}, {}, ""), Role::visitor);
  EXPECT_EQ(role_of({"https://robot.test:8443", "robot.test:8443", ""}, {}, ""), Role::visitor);
  EXPECT_EQ(role_of({"https://robot.test", "robot.test:80", ""}, {}, ""), std::nullopt);
  EXPECT_EQ(role_of({"http://robot.test", "robot.test:443", ""}, {}, ""), std::nullopt);
  EXPECT_EQ(role_of({"http://robot.test", "robot.test:8080", ""}, {}, ""), std::nullopt) << "another site";
}

TEST(Roles, APageThatCameWithoutHttpsSpeaksForNobodyOverHttps) {
  EXPECT_EQ(role_of({"https://robot.test", "robot.test", "", true}, {}, ""), Role::visitor);
  EXPECT_EQ(role_of({"http://robot.test", "robot.test", "", true}, {}, ""), std::nullopt);
  EXPECT_EQ(role_of({"http://museum.test", "robot.test", "", true}, {"museum.test"}, ""), Role::visitor)
      << "named by the owner";
  EXPECT_EQ(role_of({"", "robot.test", "", true}, {}, ""), Role::visitor) << "no browser";
}

TEST(Roles, OnlyItsKeyMakesAPageTheRobotsScreen) {
  EXPECT_EQ(role_of({"http://robot.test", "robot.test", "k1"}, {}, "k1"), Role::kiosk);
  EXPECT_EQ(role_of({"http://evil.test", "robot.test", "k1"}, {}, "k1"), std::nullopt);
  for (const char* key : {"k2", "k", "k11", "K1"})
    EXPECT_EQ(role_of({"http://robot.test", "robot.test", key}, {}, "k1"), std::nullopt) << key;
  EXPECT_EQ(role_of({"http://robot.test", "robot.test", "k1"}, {}, ""), std::nullopt) << "the robot has no screen";
}

TEST(Roles, EachRoleAsksForWhatIsIts) {
  const ClientMessage watch = WatchMessage{true};
  const std::vector<ClientMessage> wishes{RequestMessage{}, CancelMessage{}, ChoiceMessage{}};
  const std::vector<ClientMessage> of_the_screen{LampsMessage{}, HelpMessage{}, SkipMessage{}, AnswerMessage{}};
  const std::vector<ClientMessage> of_staff{LeaseMessage{}, SteerMessage{}, StopMessage{}, SetHoursMessage{}};
  for (const Role role : {Role::observer, Role::visitor, Role::kiosk, Role::staff}) {
    for (const bool screen_stops : {false, true}) {
      EXPECT_TRUE(may_ask(role, watch, screen_stops));
      for (const ClientMessage& wish : wishes) EXPECT_EQ(may_ask(role, wish, screen_stops), role != Role::observer);
      for (const ClientMessage& own : of_the_screen) EXPECT_EQ(may_ask(role, own, screen_stops), role == Role::kiosk);
      for (const ClientMessage& own : of_staff) EXPECT_EQ(may_ask(role, own, screen_stops), role == Role::staff);
    }
  }
}

TEST(Roles, TheRobotsScreenStopsItWhereItMayAndNeverLetsItGo) {
  StopMessage stop;
  stop.stopped = true;
  EXPECT_FALSE(may_ask(Role::kiosk, stop, false));
  EXPECT_TRUE(may_ask(Role::kiosk, stop, true));
  EXPECT_FALSE(may_ask(Role::visitor, stop, true));
  stop.stopped = false;
  EXPECT_FALSE(may_ask(Role::kiosk, stop, true));
}

}  // namespace
}  // namespace docent::telepresence
