#include "docent/evaluation/run_logs/office_log.h"

#include <gtest/gtest.h>

#include "docent/messages/topics.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::evaluation::office_log_test {
namespace {

TEST(OfficeLog, HasARowForEachChange) {
  transport::VirtualTimeHub hub;
  OfficeLog log;
  hub.tap([&](const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
    log.add(topic, time, message);
  });
  const auto bus = hub.connect("world");
  auto truth = bus->publisher(topics::kTrueState);
  auto things = bus->publisher(topics::kSeenThings);
  auto state = bus->publisher(topics::kOfficeState);
  docent_msgs::TrueState robot;
  robot.x = 3.0, robot.y = 4.0;
  truth.publish(robot);
  docent_msgs::OfficeState phase;
  phase.kind = "deliver", phase.phase = "driving", phase.room = "kitchen";
  state.publish(phase);
  docent_msgs::SeenThings seen;
  seen.things.push_back({.id = 5, .object = "can", .x = 1.0, .y = 2.0, .looks = 4, .last = {}});
  things.publish(seen);
  things.publish(seen);
  things.publish(docent_msgs::SeenThings{});
  hub.run_until(time_from_seconds(1.0));
  EXPECT_EQ(log.rows(),
            "0.00,state,driving,3.000,4.000,deliver kitchen,0,0,0,0\n"
            "0.00,thing,can,1.000,2.000,5,4,0,0,0\n"
            "0.00,gone,can,0,0,5,0,0,0,0\n");
}

}  // namespace
}  // namespace docent::evaluation::office_log_test
