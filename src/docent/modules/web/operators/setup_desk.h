#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "docent/grid/occupancy_grid.h"
#include "docent/messages/localization_messages.h"
#include "docent/messages/operation_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/modules/shared/module.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/setup_office/setup_office.h"
#include "docent/telepresence/site.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: what a technician does who sets up the museum, and how the map grows meanwhile.
class SetupDesk {
 public:
  /// Where the growing map can be fetched.
  static constexpr const char* kPicture = "/api/growing.png";

  /// The bus and the site outlive it. What has become of its office is used no longer than it.
  SetupDesk(const ModuleContext& context, telepresence::Site& site);

  /// Null: no museum is set up.
  [[nodiscard]] std::shared_ptr<const telepresence::SetupOffice> office() const { return office_; }
  /// From now on operators are shown, in that slot. @pre lives as long as this
  void begin(telepresence::WebServer& server, int slot);

 private:
  void take(const nav_msgs::OccupancyGrid& map);
  /// An exploration document, as JSON text; empty: nothing is explored.
  [[nodiscard]] std::string document() const;

  transport::Bus& bus_;
  telepresence::Site& site_;
  transport::Publisher<docent_msgs::MuseumMoved> moved_;
  transport::Publisher<docent_msgs::ExplorationOrder> orders_;
  std::shared_ptr<const telepresence::SetupOffice> office_;
  std::optional<docent_msgs::Exploration> exploration_;
  GridFrame frame_;           ///< of the map that is shown
  std::uint32_t number_ = 0;  ///< of the map that is shown; 0: there is none
  std::string shown_;
};

}  // namespace docent::modules
