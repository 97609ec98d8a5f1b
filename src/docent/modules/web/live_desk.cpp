#include "docent/modules/web/live_desk.h"

#include <utility>

#include "docent/messages/topics.h"
#include "docent/modules/shared/scanners.h"
#include "docent/telepresence/views/slots.h"

namespace docent::modules {

namespace slots = telepresence::slots;

LiveDesk::LiveDesk(transport::Bus& bus, const robot::RobotBody& body, const WebParams& params)
    : bus_{bus}, body_{body}, params_{params}, view_{mounts_of(body_.scanners), params_.scan_step} {}

void LiveDesk::begin(telepresence::WebServer& server) {
  server_ = &server;
  server.restrict_to(telepresence::Stream::details, slots::kWindow);
  server.restrict_to(telepresence::Stream::full, slots::kLive);
  server.restrict_to(telepresence::Stream::full, slots::kBelief);
  server.restrict_to(telepresence::Stream::thin, slots::kPose);
  subscribe();
  bus_.every(seconds(1.0 / params_.live_hz), [this] { server_->broadcast(slots::kLive, view_.live(bus_.now())); });
  bus_.every(seconds(params_.pose_s / telepresence::WebServer::kParts), [this] { show_pose(); });
  bus_.every(seconds(1.0 / params_.belief_hz), [this] { show_slow(); });
}

void LiveDesk::subscribe() {
  const auto see = [this](const auto& message) { view_.see(message); };
  bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, see);
  subscribe_scanners(bus_, body_, [this](std::size_t i, const auto& scan, const auto& place) {
    view_.mount(i, place.base_from_sensor);
    view_.see_scan(i, scan);
  });
  bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, see);
  bus_.subscribe<docent_msgs::People>(topics::kPeople, see);
  bus_.subscribe<docent_msgs::Belief>(topics::kBelief, see);
  bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& state) {
    view_.see(state);
    if (!state.window.empty()) server_->broadcast(slots::kWindow, telepresence::encode_window(state));
  });
  bus_.subscribe<nav_msgs::Path>(topics::kPath, see);
  bus_.subscribe<docent_msgs::GoalState>(topics::kGoalState, see);
}

/// Each part of the thin viewers gets the pose of its own moment, so that nobody waits until all have theirs.
void LiveDesk::show_pose() {
  server_->broadcast_part(slots::kPose, part_, view_.pose(bus_.now()));
  part_ = (part_ + 1) % telepresence::WebServer::kParts;
}

void LiveDesk::show_slow() {
  if (auto belief = view_.belief()) server_->broadcast(slots::kBelief, std::move(*belief));
  if (auto path = view_.path()) server_->broadcast(slots::kPath, std::move(*path));
}

}  // namespace docent::modules
