#include "docent/evaluation/message_ages.h"

#include <algorithm>
#include <string_view>

#include "docent/messages/conversions.h"

namespace docent::evaluation {

void MessageAges::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  const auto age_of = [&](const auto& header) { return std::max(0.0, to_seconds(time - from_message(header.stamp))); };
  if (name == topics::kBelief.name) {
    const auto& belief = *static_cast<const docent_msgs::Belief*>(message.get());
    was_localized_ = was_localized_ || belief.localized;
    if (was_localized_) beliefs_.add(age_of(belief.header));
  } else if (name == topics::kVirtualScan.name && was_localized_) {
    hazards_.add(age_of(static_cast<const sensor_msgs::LaserScan*>(message.get())->header));
  }
}

}  // namespace docent::evaluation
