#include "docent/apps/laboratory/ablations/altered_bus.h"

#include <gtest/gtest.h>

#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::ablations {
namespace {

docent_msgs::Expression face(const std::string& mood) {
  docent_msgs::Expression expression;
  expression.mood = mood;
  return expression;
}

/// Two modules on a bus, of which one is altered.
class AlteredBusTest : public ::testing::Test {
 protected:
  void alter(BusAlterations alterations) {
    altered = std::make_unique<AlteredBus>(hub.connect("altered"), std::move(alterations));
  }
  static void keep(transport::Bus& bus, std::vector<std::string>& moods) {
    bus.subscribe<docent_msgs::Expression>(topics::kExpression,
                                           [&moods](const auto& face) { moods.push_back(face.mood); });
  }
  static docent_msgs::Expression neutral(const docent_msgs::Expression& said) {
    docent_msgs::Expression expression = said;
    expression.mood = "neutral";
    return expression;
  }

  transport::VirtualTimeHub hub;
  std::unique_ptr<transport::Bus> other = hub.connect("other");
  std::unique_ptr<transport::Bus> altered;
  std::vector<std::string> heard_by_other;
  std::vector<std::string> heard_by_altered;
};

TEST_F(AlteredBusTest, WhatItSaysIsAlteredForAll) {
  BusAlterations alterations;
  EXPECT_TRUE(alterations.empty());
  alterations.said<docent_msgs::Expression>(topics::kExpression, neutral);
  EXPECT_FALSE(alterations.empty());
  alter(std::move(alterations));
  keep(*other, heard_by_other);
  keep(*altered, heard_by_altered);
  altered->publisher(topics::kExpression).publish(face("happy"));
  other->publisher(topics::kExpression).publish(face("angry"));
  hub.run_until(time_from_seconds(1.0));
  EXPECT_EQ(heard_by_other, (std::vector<std::string>{"neutral", "angry"}));
  EXPECT_EQ(heard_by_altered, (std::vector<std::string>{"neutral", "angry"}));
}

TEST_F(AlteredBusTest, WhatItHearsIsAlteredForItAlone) {
  BusAlterations alterations;
  alterations.heard<docent_msgs::Expression>(topics::kExpression, neutral);
  alter(std::move(alterations));
  keep(*other, heard_by_other);
  keep(*altered, heard_by_altered);
  other->publisher(topics::kExpression).publish(face("happy"));
  hub.run_until(time_from_seconds(1.0));
  EXPECT_EQ(heard_by_other, (std::vector<std::string>{"happy"}));
  EXPECT_EQ(heard_by_altered, (std::vector<std::string>{"neutral"}));
}

TEST_F(AlteredBusTest, ItIsDeafToATopicAndHasItsTimeAndTimersFromTheOther) {
  BusAlterations alterations;
  alterations.deaf_to(topics::kExpression);
  alter(std::move(alterations));
  keep(*other, heard_by_other);
  keep(*altered, heard_by_altered);
  int ticks = 0;
  int shots = 0;
  altered->every(seconds(0.25), [&] { ++ticks; });
  altered->after(seconds(0.5), [&] { ++shots; });
  altered->post([&] { ++shots; });
  other->publisher(topics::kExpression).publish(face("happy"));
  hub.run_until(time_from_seconds(1.0));
  EXPECT_EQ(heard_by_other.size(), 1U);
  EXPECT_TRUE(heard_by_altered.empty());
  EXPECT_EQ(ticks, 4);
  EXPECT_EQ(shots, 2);
  EXPECT_EQ(altered->now(), hub.now());
}

}  // namespace
}  // namespace docent::apps::ablations
