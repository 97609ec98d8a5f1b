#include "docent/modules/web/live_desk.h"

#include <utility>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/web/slots.h"

namespace docent::modules {

LiveDesk::LiveDesk(transport::Bus& bus, const robot::RobotBody& body, const WebParams& params)
    : bus_{bus}, body_{body}, params_{params}, scans_(body_.scanners.size()) {}

void LiveDesk::begin(telepresence::WebServer& server) {
  server_ = &server;
  server.restrict_to(telepresence::Stream::details, kWindow);
  server.restrict_to(telepresence::Stream::full, kLive);
  server.restrict_to(telepresence::Stream::full, kBelief);
  server.restrict_to(telepresence::Stream::thin, kPose);
  subscribe();
  bus_.every(seconds(1.0 / params_.live_hz), [this] { show_live(); });
  bus_.every(seconds(params_.pose_s / telepresence::WebServer::kParts), [this] { show_pose(); });
  bus_.every(seconds(1.0 / params_.belief_hz), [this] { show_slow(); });
}

void LiveDesk::subscribe() {
  bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& m) { carrier_.add_odometry(m); });
  subscribe_scanners(bus_, body_, [this](std::size_t i, const auto& m) { scans_[i] = m; });
  bus_.subscribe<sensor_msgs::BatteryState>(topics::kBattery, [this](const auto& m) { battery_ = m.percentage; });
  bus_.subscribe<docent_msgs::People>(topics::kPeople, [this](const auto& m) { people_ = m; });
  bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& m) {
    carrier_.set_belief(m);
    belief_ = m;
  });
  bus_.subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& m) {
    avoid_ = m;
    if (!m.window.empty()) server_->broadcast(kWindow, telepresence::encode_window(m));
  });
  bus_.subscribe<nav_msgs::Path>(topics::kPath, [this](const auto& m) {
    path_ = m;
    is_path_new_ = true;
  });
  bus_.subscribe<docent_msgs::GoalState>(topics::kGoalState, [this](const auto& m) {
    goal_ = m;
    is_path_new_ = true;
  });
}

telepresence::LiveFrame LiveDesk::frame_now() const {
  telepresence::LiveFrame frame;
  frame.now = bus_.now();
  frame.map_from_base = carrier_.map_from_base(frame.now);
  frame.linear = carrier_.linear();
  frame.angular = carrier_.angular();
  frame.p_lost = carrier_.p_lost();
  frame.battery = battery_;
  return frame;
}

void LiveDesk::show_live() {
  constexpr Duration kFreshPose = std::chrono::seconds{1};
  telepresence::LiveFrame frame = frame_now();
  if (!frame.map_from_base) frame.hypotheses = carrier_.hypotheses(frame.now, 0.03);
  frame.is_scan_in_map = frame.map_from_base.has_value();
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const sensor_msgs::LaserScan& scan = scans_[i];
    const Time taken = from_message(scan.header.stamp);
    if (scan.ranges.empty() || frame.now - taken > kFreshPose) continue;
    const Pose2 from_base = frame.is_scan_in_map ? *carrier_.map_from_base(taken) : Pose2{};
    frame.scan_origin = from_base.position();
    for (const Point2 point : telepresence::scan_points(scan, body_.scanners[i].base_from_sensor(),
                                                        static_cast<std::size_t>(params_.scan_step)))
      frame.scan.push_back(from_base * point);
  }
  if (frame.now - from_message(people_.header.stamp) <= kFreshPose) frame.people = people_;
  if (avoid_ && frame.now - from_message(avoid_->header.stamp) <= kFreshPose) frame.avoid = avoid_;
  server_->broadcast(kLive, telepresence::encode_live(frame));
}

/// Each part of the thin viewers gets the pose of its own moment, so that nobody waits until all have theirs.
void LiveDesk::show_pose() {
  server_->broadcast_part(kPose, part_, telepresence::encode_pose(frame_now()));
  part_ = (part_ + 1) % telepresence::WebServer::kParts;
}

void LiveDesk::show_slow() {
  if (belief_) server_->broadcast(kBelief, telepresence::encode_belief(*std::exchange(belief_, std::nullopt)));
  if (std::exchange(is_path_new_, false)) server_->broadcast(kPath, telepresence::encode_path(path_, goal_));
}

}  // namespace docent::modules
