#pragma once

#include <optional>
#include <string>

#include "docent/messages/localization_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: what the planner knows, for operators. The value function of the way that it plans, and what
/// stands in the building now.
class MapsDesk {
 public:
  /// The bus outlives it.
  explicit MapsDesk(transport::Bus& bus) : bus_{bus} {}

  /// From now on operators are shown, in that slot. @pre lives as long as this
  void begin(telepresence::WebServer& server, int slot);
  /// A maps document, as JSON text.
  [[nodiscard]] std::string document() const;

 private:
  void take(const nav_msgs::OccupancyGrid& map);
  void take(const docent_msgs::LiveMapUpdate& update);

  transport::Bus& bus_;
  nav_msgs::OccupancyGrid value_, live_;
  std::uint32_t number_ = 0;  ///< of the update that `live_` holds already
  std::string shown_;
};

}  // namespace docent::modules
