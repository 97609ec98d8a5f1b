#include "docent/evaluation/message_ages.h"

#include <algorithm>
#include <string_view>

#include "docent/messages/conversions.h"

namespace docent::evaluation {

void MessageAges::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  const auto age_of = [&](const auto& header) { return std::max(0.0, to_seconds(time - from_message(header.stamp))); };
  if (name == topics::kBelief.name)
    beliefs_.add(age_of(static_cast<const docent_msgs::Belief*>(message.get())->header));
  else if (name == topics::kVirtualScan.name)
    hazards_.add(age_of(static_cast<const sensor_msgs::LaserScan*>(message.get())->header));
}

}  // namespace docent::evaluation
