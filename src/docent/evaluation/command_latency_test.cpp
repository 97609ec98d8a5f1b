#include "docent/evaluation/command_latency.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

class Recorded {
 public:
  void sweep(double stamp, double heard, const char* scanner = "front") {
    auto scan = std::make_shared<sensor_msgs::LaserScan>();
    scan->header.stamp = to_message(time_from_seconds(stamp));
    latency.add(transport::topic_info(topics::scan_topic(scanner)), time_from_seconds(heard), scan);
  }
  void choice(double stamp, double heard, double linear) {
    auto state = std::make_shared<docent_msgs::AvoidState>();
    state->header.stamp = to_message(time_from_seconds(stamp));
    state->linear = linear;
    latency.add(transport::topic_info(topics::kAvoidState), time_from_seconds(heard), state);
  }
  void told(double heard, double linear) {
    auto twist = std::make_shared<geometry_msgs::Twist>();
    twist->linear.x = linear;
    latency.add(transport::topic_info(topics::kCommandVelocity), time_from_seconds(heard), twist);
  }
  CommandLatency latency;
};

TEST(CommandLatency, IsFromTheStampToTheFirstCommandThatKnowsTheSweep) {
  Recorded recorded;
  recorded.choice(9.99, 9.991, 0.2);  // before: does not know it
  recorded.sweep(10.0, 10.003);
  recorded.told(10.004, 0.2);  // a repetition
  recorded.told(10.03, 0.5);   // heard before the choice that it tells, as recorders do
  recorded.choice(10.02, 10.031, 0.5);
  recorded.told(10.05, 0.5);
  recorded.sweep(13.0, 13.0);
  EXPECT_EQ(recorded.latency.latencies().count(), 1U);
  EXPECT_NEAR(recorded.latency.latencies().at(0.5), 0.03, 0.0004);
  EXPECT_EQ(recorded.latency.unanswered(), 0U);
}

TEST(CommandLatency, KnowsEveryScannerOfTheBody) {
  for (const char* const scanner : {"front", "rear", "left", "right"}) {
    Recorded recorded;
    recorded.sweep(10.0, 10.0, scanner);
    recorded.choice(10.01, 10.01, 0.5);
    recorded.told(10.02, 0.5);
    recorded.sweep(13.0, 13.0, scanner);
    EXPECT_EQ(recorded.latency.latencies().count(), 1U) << scanner;
  }
}

TEST(CommandLatency, CountsSweepsThatNobodyAnswers) {
  Recorded recorded;
  recorded.sweep(10.0, 10.0);
  recorded.choice(10.01, 10.01, 0.5);
  recorded.told(10.02, 0.4);  // never what was chosen
  recorded.sweep(10.1, 10.1);
  recorded.choice(10.11, 10.11, 0.3);
  recorded.told(10.12, 0.3);
  recorded.sweep(12.05, 12.05);
  recorded.sweep(20.0, 20.0);
  EXPECT_EQ(recorded.latency.unanswered(), 1U) << "the last; the first was overtaken by the second's command";
  EXPECT_EQ(recorded.latency.latencies().count(), 2U);
  EXPECT_NEAR(recorded.latency.latencies().at(0.0), 0.02, 0.0003);
  EXPECT_NEAR(recorded.latency.latencies().at(1.0), 0.12, 0.0013);
}

TEST(CommandLatency, IsNothingWhereTimeStandsStill) {
  Recorded recorded;
  recorded.sweep(10.0, 10.0);
  recorded.choice(10.0, 10.0, 0.5);
  recorded.told(10.0, 0.5);
  recorded.sweep(13.0, 13.0);
  EXPECT_EQ(recorded.latency.latencies().count(), 1U);
  EXPECT_EQ(recorded.latency.latencies().at(1.0), 0.0);
}

}  // namespace
}  // namespace docent::evaluation
