#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"

namespace docent::telepresence {

/// The names of the protocol in Sec-WebSocket-Protocol. Foxglove's SDK and its bridge renamed it, with the same
/// messages; newer viewers offer the newer name, or both.
inline constexpr std::array<std::string_view, 2> kFoxgloveProtocols{"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// A topic as a client sees it.
struct FoxgloveChannel {
  std::uint32_t id = 0;
  std::string topic;   ///< "/scan_front"
  std::string type;    ///< "sensor_msgs/msg/LaserScan"
  std::string schema;  ///< ros2msg text of the type and all that it nests
};

// What the server says, as JSON.

[[nodiscard]] std::string encode_server_info(const std::string& name, const std::string& session);
[[nodiscard]] std::string encode_advertise(std::span<const FoxgloveChannel> channels);
/// @param level  0 information, 1 warning, 2 error
[[nodiscard]] std::string encode_status(int level, const std::string& message);

/// A message of a subscription: operation 1, subscription, time, all little endian, then the bytes.
[[nodiscard]] std::string encode_message_data(std::uint32_t subscription, Time time,
                                              std::span<const std::uint8_t> message);

// What a client says.

struct FoxgloveSubscribe {
  struct One {
    std::uint32_t subscription = 0;  ///< the client's own number
    std::uint32_t channel = 0;
  };
  std::vector<One> subscriptions;
};
struct FoxgloveUnsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
/// Anything that a read-only server does not do.
struct FoxgloveOther {
  std::string operation;
};
using FoxgloveRequest = std::variant<FoxgloveSubscribe, FoxgloveUnsubscribe, FoxgloveOther>;

/// Error: no JSON object with an operation, numbers that are none, or more than `kMostSubscriptions` at once.
[[nodiscard]] Result<FoxgloveRequest> parse_foxglove_request(std::string_view text);
inline constexpr std::size_t kMostSubscriptions = 256;  ///< of one client

}  // namespace docent::telepresence
