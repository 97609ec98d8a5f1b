#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "docent/telepresence/foxglove/hub.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// Shows every topic of the robot to clients of the Foxglove protocol. A topic is listened to from when somebody first
/// wants it, and encoded only while somebody does.
class FoxgloveDesk {
 public:
  FoxgloveDesk(transport::Bus& bus, const std::string& name);

  /// For the server, which calls it back on its own thread.
  [[nodiscard]] std::shared_ptr<telepresence::FoxgloveHub> hub() const { return hub_; }
  /// @pre lives as long as this
  void set_server(telepresence::WebServer& server) { server_ = &server; }

 private:
  /// Somebody has subscribed to a channel. On the bus's thread.
  void want(std::uint32_t channel);
  void show(std::uint32_t channel, const std::shared_ptr<const void>& message);

  transport::Bus& bus_;
  std::vector<transport::TopicInfo> topics_;  ///< [channels]
  std::shared_ptr<telepresence::FoxgloveHub> hub_;
  telepresence::WebServer* server_ = nullptr;
  std::map<std::uint32_t, std::shared_ptr<const void>> heard_;  ///< of channels that are listened to, the newest
};

}  // namespace docent::modules
