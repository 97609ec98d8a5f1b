#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/telepresence/foxglove/protocol.h"

namespace docent::telepresence {

/// What one client has subscribed to and has still to get: of each subscription the newest message, in the order in
/// which they came first. Bounded by kMostSubscriptions.
class FoxgloveClient {
 public:
  using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;

  /// False: it has too many.
  bool subscribe(std::uint32_t subscription, std::uint32_t channel);
  /// The channel that it was for; nullopt: there is no such subscription.
  std::optional<std::uint32_t> unsubscribe(std::uint32_t subscription);
  void add(std::uint32_t channel, Time time, const Bytes& message);
  /// The next message to send, as bytes of the protocol; nullopt: none.
  [[nodiscard]] std::optional<std::string> next();
  /// Channels of all its subscriptions, one entry each.
  [[nodiscard]] std::vector<std::uint32_t> channels() const;

 private:
  struct Pending {
    std::uint32_t channel = 0;
    Time time{};
    Bytes message;  ///< null: nothing new
  };
  std::map<std::uint32_t, Pending> subscriptions_;
  std::deque<std::uint32_t> order_;  ///< those with something new
};

/// The channels of the robot, and how many want each. What the module publishes goes through here.
class FoxgloveHub {
 public:
  /// @param wanted  called on the server's thread whenever somebody subscribes to a channel
  FoxgloveHub(std::string name, std::vector<FoxgloveChannel> channels, std::function<void(std::uint32_t)> wanted);

  [[nodiscard]] const std::vector<FoxgloveChannel>& channels() const { return channels_; }
  /// What a client is told on arrival.
  [[nodiscard]] const std::string& server_info() const { return server_info_; }
  [[nodiscard]] const std::string& advertisement() const { return advertisement_; }
  /// Any thread.
  [[nodiscard]] bool is_wanted(std::uint32_t channel) const { return wanted_by_[channel] > 0; }

  /// The answer to a request of a client; empty: none is due. On the server's thread.
  std::string take(FoxgloveClient& client, const FoxgloveRequest& request);
  /// Forgets a client that has gone.
  void leave(const FoxgloveClient& client);

 private:
  std::string subscribe(FoxgloveClient& client, const FoxgloveSubscribe& request);
  std::vector<FoxgloveChannel> channels_;
  std::function<void(std::uint32_t)> wanted_;
  std::string server_info_;
  std::string advertisement_;
  std::vector<std::atomic<int>> wanted_by_;  ///< [channels]
};

}  // namespace docent::telepresence
