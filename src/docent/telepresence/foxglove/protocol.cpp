#include "docent/telepresence/foxglove/protocol.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

std::optional<std::uint32_t> number_of(const Json& value) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto number = value.get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

template <class T>
void append_little_endian(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>((value >> (8U * i)) & 0xFFU);
}

Result<FoxgloveRequest> parse_subscribe(const Json& list) {
  FoxgloveSubscribe subscribe;
  for (const Json& entry : list) {
    if (!entry.is_object() || !entry.contains("id") || !entry.contains("channelId"))
      return fail("subscribe: expected id and channelId");
    const auto subscription = number_of(entry["id"]);
    const auto channel = number_of(entry["channelId"]);
    if (!subscription || !channel) return fail("subscribe: id and channelId must be whole numbers of 32 bits");
    subscribe.subscriptions.push_back({*subscription, *channel});
  }
  return FoxgloveRequest{std::move(subscribe)};
}

Result<FoxgloveRequest> parse_unsubscribe(const Json& list) {
  FoxgloveUnsubscribe unsubscribe;
  for (const Json& entry : list) {
    const auto subscription = number_of(entry);
    if (!subscription) return fail("unsubscribe: subscriptionIds must be whole numbers of 32 bits");
    unsubscribe.subscriptions.push_back(*subscription);
  }
  return FoxgloveRequest{std::move(unsubscribe)};
}

}  // namespace

std::string encode_server_info(const std::string& name, const std::string& session) {
  return Json{{"op", "serverInfo"}, {"name", name}, {"capabilities", Json::array()}, {"sessionId", session}}.dump();
}

std::string encode_advertise(std::span<const FoxgloveChannel> channels) {
  Json list = Json::array();
  for (const FoxgloveChannel& channel : channels)
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel.type},
                    {"schema", channel.schema},
                    {"schemaEncoding", "ros2msg"}});
  return Json{{"op", "advertise"}, {"channels", std::move(list)}}.dump();
}

std::string encode_status(int level, const std::string& message) {
  return Json{{"op", "status"}, {"level", level}, {"message", message}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);  // it may quote a client
}

std::string encode_message_data(std::uint32_t subscription, Time time, std::span<const std::uint8_t> message) {
  constexpr char kMessageData = 1;
  std::string bytes;
  bytes.reserve(1 + sizeof(std::uint32_t) + sizeof(std::uint64_t) + message.size());
  bytes += kMessageData;
  append_little_endian(bytes, subscription);
  append_little_endian(bytes, static_cast<std::uint64_t>(time.nanoseconds));
  bytes.append(message.begin(), message.end());
  return bytes;
}

Result<FoxgloveRequest> parse_foxglove_request(std::string_view text) {
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object()) return fail("expected a JSON object");
  const auto operation = object.find("op");
  if (operation == object.end() || !operation->is_string()) return fail("expected an operation, op");
  const auto name = operation->get<std::string>();
  const bool subscribes = name == "subscribe";
  if (!subscribes && name != "unsubscribe") return FoxgloveRequest{FoxgloveOther{name.substr(0, 64)}};
  const auto list = object.find(subscribes ? "subscriptions" : "subscriptionIds");
  if (list == object.end() || !list->is_array()) return fail(name + ": expected a list");
  if (list->size() > kMostSubscriptions) return fail(name + ": too many at once");
  return subscribes ? parse_subscribe(*list) : parse_unsubscribe(*list);
}

}  // namespace docent::telepresence
