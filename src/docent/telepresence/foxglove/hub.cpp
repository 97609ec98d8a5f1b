#include "docent/telepresence/foxglove/hub.h"

#include <algorithm>
#include <utility>

#include "docent/base/check.h"

namespace docent::telepresence {

bool FoxgloveClient::subscribe(std::uint32_t subscription, std::uint32_t channel) {
  if (subscriptions_.size() >= kMostSubscriptions) return false;
  return subscriptions_.try_emplace(subscription, Pending{channel, {}, nullptr}).second;
}

std::optional<std::uint32_t> FoxgloveClient::unsubscribe(std::uint32_t subscription) {
  const auto place = subscriptions_.find(subscription);
  if (place == subscriptions_.end()) return std::nullopt;
  const std::uint32_t channel = place->second.channel;
  subscriptions_.erase(place);
  std::erase(order_, subscription);
  return channel;
}

void FoxgloveClient::add(std::uint32_t channel, Time time, const Bytes& message) {
  for (auto& [subscription, pending] : subscriptions_) {
    if (pending.channel != channel) continue;
    if (pending.message == nullptr) order_.push_back(subscription);
    pending.time = time;
    pending.message = message;
  }
}

std::optional<std::string> FoxgloveClient::next() {
  if (order_.empty()) return std::nullopt;
  const std::uint32_t subscription = order_.front();
  order_.pop_front();
  Pending& pending = subscriptions_.at(subscription);
  const Bytes message = std::exchange(pending.message, nullptr);
  return encode_message_data(subscription, pending.time, *message);
}

std::vector<std::uint32_t> FoxgloveClient::channels() const {
  std::vector<std::uint32_t> all;
  all.reserve(subscriptions_.size());
  for (const auto& [subscription, pending] : subscriptions_) all.push_back(pending.channel);
  return all;
}

FoxgloveHub::FoxgloveHub(std::string name, std::vector<FoxgloveChannel> channels,
                         std::function<void(std::uint32_t)> wanted)
    : channels_{std::move(channels)},
      wanted_{std::move(wanted)},
      server_info_{encode_server_info(name, name)},
      advertisement_{encode_advertise(channels_)},
      wanted_by_(channels_.size()) {
  for (std::size_t i = 0; i < channels_.size(); ++i) DOCENT_CHECK(channels_[i].id == i);
}

std::string FoxgloveHub::take(FoxgloveClient& client, const FoxgloveRequest& request) {
  if (const auto* subscribe_to = std::get_if<FoxgloveSubscribe>(&request)) return subscribe(client, *subscribe_to);
  if (const auto* end = std::get_if<FoxgloveUnsubscribe>(&request)) {
    for (const std::uint32_t subscription : end->subscriptions)
      if (const auto channel = client.unsubscribe(subscription)) --wanted_by_[*channel];
    return {};
  }
  return encode_status(
      1, "this robot is shown, not steered, here: " + std::get<FoxgloveOther>(request).operation + " is not served");
}

std::string FoxgloveHub::subscribe(FoxgloveClient& client, const FoxgloveSubscribe& request) {
  for (const auto& [subscription, channel] : request.subscriptions) {
    if (channel >= channels_.size()) return encode_status(2, "there is no channel " + std::to_string(channel));
    if (!client.subscribe(subscription, channel))
      return encode_status(2, "subscription " + std::to_string(subscription) + " is taken, or there are too many");
    ++wanted_by_[channel];
    wanted_(channel);
  }
  return {};
}

void FoxgloveHub::leave(const FoxgloveClient& client) {
  for (const std::uint32_t channel : client.channels()) --wanted_by_[channel];
}

}  // namespace docent::telepresence
