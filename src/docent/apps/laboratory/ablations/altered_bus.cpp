#include "docent/apps/laboratory/ablations/altered_bus.h"

namespace docent::apps::ablations {

void AlteredBus::add_subscription(const transport::TopicInfo& topic, Handler handler) {
  if (alterations_.deaf_to_.contains(topic.name)) return;
  const auto heard = alterations_.heard_.find(topic.name);
  if (heard == alterations_.heard_.end()) return bus_->add_subscription(topic, std::move(handler));
  bus_->add_subscription(topic, [&alter = heard->second, handler = std::move(handler)](
                                    const std::shared_ptr<const void>& message) { handler(alter(message)); });
}

int AlteredBus::add_publisher(const transport::TopicInfo& topic) {
  const int publisher = add_publisher_on(*bus_, topic);
  const auto said = alterations_.said_.find(topic.name);
  if (said != alterations_.said_.end()) said_[publisher] = &said->second;
  return publisher;
}

void AlteredBus::publish(int publisher, std::shared_ptr<const void> message) {
  const auto said = said_.find(publisher);
  if (said != said_.end()) message = (*said->second)(message);
  publish_on(*bus_, publisher, std::move(message));
}

}  // namespace docent::apps::ablations
