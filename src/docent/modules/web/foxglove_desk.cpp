#include "docent/modules/web/foxglove_desk.h"

#include "docent/messages/topics.h"
#include "docent/recording/recorder.h"

namespace docent::modules {

FoxgloveDesk::FoxgloveDesk(transport::Bus& bus, const std::string& name) : bus_{bus} {
  for_each_robot_topic([this](const auto& topic) { topics_.push_back(transport::topic_info(topic)); });
  std::vector<telepresence::FoxgloveChannel> channels;
  for (const auto& topic : topics_) {
    const auto* known = recording::find_recorded_topic(topic.name);
    channels.push_back({static_cast<std::uint32_t>(channels.size()), std::string{"/"} + topic.name, topic.type->name,
                        known != nullptr ? known->schema : std::string{}});
  }
  hub_ = std::make_shared<telepresence::FoxgloveHub>(
      name, std::move(channels), [this](std::uint32_t channel) { bus_.post([this, channel] { want(channel); }); });
}

void FoxgloveDesk::want(std::uint32_t channel) {
  const auto [heard, is_new] = heard_.try_emplace(channel);
  const transport::TopicInfo& topic = topics_[channel];
  if (is_new) {
    bus_.add_subscription(topic, [this, channel, is_latched = topic.qos == Qos::state](const auto& message) {
      if (is_latched) heard_[channel] = message;
      show(channel, message);
    });
  } else if (heard->second != nullptr) {
    show(channel, heard->second);  // of a latched topic, for whoever came later
  }
}

void FoxgloveDesk::show(std::uint32_t channel, const std::shared_ptr<const void>& message) {
  if (server_ == nullptr || !hub_->is_wanted(channel)) return;
  server_->show(channel, bus_.now(),
                std::make_shared<const std::vector<std::uint8_t>>(topics_[channel].type->encode(message.get())));
}

}  // namespace docent::modules
