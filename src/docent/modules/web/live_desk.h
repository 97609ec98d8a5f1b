#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/messages/docent_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/modules/web/web_params.h"
#include "docent/robot/robot_config.h"
#include "docent/telepresence/belief_carrier.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: what moves. The pose and what the scanners see, the belief, the way.
class LiveDesk {
 public:
  /// The bus outlives it.
  LiveDesk(transport::Bus& bus, const robot::RobotBody& body, const WebParams& params);

  /// From now on viewers are shown. @pre lives as long as this
  void begin(telepresence::WebServer& server);
  [[nodiscard]] std::optional<Pose2> map_from_base() const { return carrier_.map_from_base(bus_.now()); }
  [[nodiscard]] const docent_msgs::People& people() const { return people_; }

 private:
  void subscribe();
  /// Where the robot is, and how fast.
  [[nodiscard]] telepresence::LiveFrame frame_now() const;
  void show_live();
  void show_pose();
  void show_slow();

  transport::Bus& bus_;
  const robot::RobotBody body_;
  const WebParams params_;
  telepresence::WebServer* server_ = nullptr;
  telepresence::BeliefCarrier carrier_;
  std::vector<sensor_msgs::LaserScan> scans_;  ///< [scanners] newest sweeps
  docent_msgs::People people_;
  std::optional<docent_msgs::Belief> belief_;  ///< not yet shown
  std::optional<docent_msgs::AvoidState> avoid_;
  std::optional<double> battery_;
  nav_msgs::Path path_;
  docent_msgs::GoalState goal_;
  bool is_path_new_ = false;
  int part_ = 0;  ///< of the thin viewers, that gets the next pose
};

}  // namespace docent::modules
