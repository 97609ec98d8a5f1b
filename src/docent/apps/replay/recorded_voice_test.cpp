#include "docent/apps/replay/recorded_voice.h"

#include <gtest/gtest.h>

#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::replay_command {
namespace {

docent_msgs::Say say(const std::string& id, const std::string& text) { return {id, text, "en", "neutral"}; }

/// "Hello" was said twice: rendered in 0.5 s and said in 2 s, then in 0.1 s and 3 s.
RecordedLines recorded_lines() {
  RecordedLines lines;
  const auto add = [&lines]<class T>(const Topic<T>& topic, double at, const T& message) {
    const transport::TopicInfo info = transport::topic_info(topic);
    lines.add({info, time_from_seconds(at), std::make_shared<const T>(message)});
  };
  const auto state = [](const std::string& id, const std::string& is) {
    docent_msgs::SpeechState message;
    message.id = id;
    message.state = is;
    return message;
  };
  add(topics::kSay, 10.0, say("a", "Hello"));
  add(topics::kSay, 10.2, say("a", "Hello"));  // ordered again until it is seen
  add(topics::kSpeechState, 10.5, state("a", "speaking"));
  add(topics::kSpeechState, 12.5, state("a", "done"));
  add(topics::kSpeechState, 12.6, state("a", "done"));
  add(topics::kSay, 20.0, say("b", "Hello"));
  add(topics::kSpeechState, 20.1, state("b", "speaking"));
  add(topics::kSpeechState, 23.1, state("b", "done"));
  return lines;
}

TEST(RecordedVoice, SpeaksAsLongAsItTook) {
  transport::VirtualTimeHub hub;
  const auto bus = hub.connect("voice");
  const auto executive = hub.connect("executive");
  std::vector<std::pair<std::string, double>> heard;
  executive->subscribe<docent_msgs::SpeechState>(topics::kSpeechState, [&](const auto& state) {
    heard.emplace_back(state.id + " " + state.state, to_seconds(hub.now()));
  });
  const RecordedVoice voice{*bus, recorded_lines()};
  const auto order = executive->publisher(topics::kSay);
  order.publish(say("x", "Hello"));
  hub.run_until(time_from_seconds(0.2));
  order.publish(say("x", "Hello"));  // changes nothing
  hub.run_until(time_from_seconds(5));
  order.publish(say("y", "Hello"));
  hub.run_until(time_from_seconds(10));
  ASSERT_EQ(heard.size(), 4U);
  const std::pair<std::string, double> expected[] = {
      {"x speaking", 0.5}, {"x done", 2.5}, {"y speaking", 5.1}, {"y done", 8.1}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(heard[i].first, expected[i].first);
    EXPECT_NEAR(heard[i].second, expected[i].second, 1e-9);
  }
}

TEST(RecordedVoice, ANewLineReplacesThePresentOne) {
  transport::VirtualTimeHub hub;
  const auto bus = hub.connect("voice");
  const auto executive = hub.connect("executive");
  std::vector<std::string> heard;
  executive->subscribe<docent_msgs::SpeechState>(
      topics::kSpeechState, [&](const auto& state) { heard.push_back(state.id + " " + state.state); });
  const RecordedVoice voice{*bus, recorded_lines()};
  const auto order = executive->publisher(topics::kSay);
  order.publish(say("x", "Hello"));
  hub.run_until(time_from_seconds(1));
  order.publish(say("y", "Never said before."));
  hub.run_until(time_from_seconds(20));
  EXPECT_EQ(heard, (std::vector<std::string>{"x speaking", "y speaking", "y done"}));
  order.publish(say("x", "Hello"));  // who asks again is told that it is over
  hub.run_until(time_from_seconds(21));
  EXPECT_EQ(heard[3], "x done");
}

}  // namespace
}  // namespace docent::apps::replay_command
