#pragma once

#include <optional>

#include "docent/modules/web/web_params.h"
#include "docent/robot/robot_config.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/views/live_view.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: connects what moves, as viewers see it, to bus and server.
class LiveDesk {
 public:
  /// The bus outlives it.
  LiveDesk(transport::Bus& bus, const robot::RobotBody& body, const WebParams& params);

  /// From now on viewers are shown. @pre lives as long as this
  void begin(telepresence::WebServer& server);
  [[nodiscard]] std::optional<Pose2> map_from_base() const { return view_.map_from_base(bus_.now()); }
  [[nodiscard]] const docent_msgs::People& people() const { return view_.people(); }

 private:
  void subscribe();
  void show_pose();
  void show_slow();

  transport::Bus& bus_;
  const robot::RobotBody body_;
  const WebParams params_;
  telepresence::WebServer* server_ = nullptr;
  telepresence::LiveView view_;
  int part_ = 0;  ///< of the thin viewers, that gets the next pose
};

}  // namespace docent::modules
