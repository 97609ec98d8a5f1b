#include "docent/transport/virtual_time_bus.h"

#include <gtest/gtest.h>

namespace docent::transport {
namespace {

using topics::kHorn;
using topics::kLimits;

TEST(VirtualTimeBus, DeliversInTheOrderOfTime) {
  VirtualTimeHub hub;
  const auto a = hub.connect("a");
  const auto b = hub.connect("b");
  const auto horn = a->publisher(kHorn);
  std::vector<std::string> heard;
  b->subscribe<docent_msgs::Horn>(kHorn, [&](const auto& message) {
    heard.push_back(message.reason + "@" + std::to_string(to_seconds(b->now())));
  });
  a->after(seconds(2), [&] { horn.publish({{}, "late"}); });
  a->after(seconds(1), [&] { horn.publish({{}, "early"}); });
  hub.run_until(time_from_seconds(3));
  EXPECT_EQ(heard, (std::vector<std::string>{"early@1.000000", "late@2.000000"}));
  EXPECT_EQ(hub.now(), time_from_seconds(3));
}

TEST(VirtualTimeBus, ALateJoinerGetsLatchedState) {
  VirtualTimeHub hub;
  const auto a = hub.connect("a");
  a->publisher(kLimits).publish({0.3, 1.0, "web", true});
  hub.run_until(time_from_seconds(1));
  const auto b = hub.connect("b");
  std::string mode;
  b->subscribe<docent_msgs::Limits>(kLimits, [&](const auto& message) { mode = message.mode; });
  hub.run_until(time_from_seconds(2));
  EXPECT_EQ(mode, "web");
}

TEST(VirtualTimeBus, AnAlterationIsWhatEverybodySees) {
  VirtualTimeHub hub;
  std::vector<std::string> seen;
  hub.tap([&](const TopicInfo&, Time, const std::shared_ptr<const void>& message) {
    seen.push_back(static_cast<const docent_msgs::Horn*>(message.get())->reason);
  });
  hub.alter(topic_info(kHorn), [](Time, const std::shared_ptr<const void>& message) {
    auto horn = *static_cast<const docent_msgs::Horn*>(message.get());
    horn.reason += "!";
    return std::make_shared<docent_msgs::Horn>(horn);
  });
  const auto a = hub.connect("a");
  const auto b = hub.connect("b");
  b->subscribe<docent_msgs::Horn>(kHorn, [&](const auto& message) { seen.push_back(message.reason); });
  a->publisher(kHorn).publish({{}, "beep"});
  hub.run_until(time_from_seconds(1));
  EXPECT_EQ(seen, (std::vector<std::string>{"beep!", "beep!"}));
}

TEST(VirtualTimeBus, ADestroyedNodeIsSilent) {
  VirtualTimeHub hub;
  const auto a = hub.connect("a");
  const auto horn = a->publisher(kHorn);
  int calls = 0;
  auto b = hub.connect("b");
  b->subscribe<docent_msgs::Horn>(kHorn, [&](const auto&) { ++calls; });
  b->every(seconds(0.1), [&] { ++calls; });
  horn.publish({});
  b.reset();
  horn.publish({});
  hub.run_until(time_from_seconds(2));
  EXPECT_EQ(calls, 0);
}

TEST(VirtualTimeBus, TimersKeepTheirBeat) {
  VirtualTimeHub hub;
  const auto a = hub.connect("a");
  std::vector<double> times;
  a->every(seconds(0.25), [&] { times.push_back(to_seconds(a->now())); });
  hub.run_until(time_from_seconds(1));
  EXPECT_EQ(times, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
}

TEST(VirtualTimeHub, KnowsWhoPublishesWhat) {
  VirtualTimeHub hub;
  auto plan = hub.connect("plan");
  auto avoid = hub.connect("avoid");
  (void)plan->publisher(topics::kTarget);
  (void)plan->publisher(topics::kHorn);
  (void)avoid->publisher(topics::kDrive);
  avoid->subscribe<docent_msgs::Target>(topics::kTarget, [](const auto&) {});
  EXPECT_EQ(hub.topics_published_by("plan"), (std::set<std::string>{"docent/target", "docent/horn"}));
  EXPECT_EQ(hub.topics_published_by("avoid"), (std::set<std::string>{"docent/drive"}));
  EXPECT_TRUE(hub.topics_published_by("nobody").empty());
}

}  // namespace
}  // namespace docent::transport
