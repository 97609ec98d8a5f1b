#include "docent/telepresence/views/live_view.h"

#include <utility>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

constexpr Duration kFreshPose = std::chrono::seconds{1};

}  // namespace

LiveView::LiveView(std::vector<Pose2> mounts, int scan_step)
    : mounts_{std::move(mounts)}, scan_step_{static_cast<std::size_t>(scan_step)}, scans_(mounts_.size()) {}

void LiveView::see(const docent_msgs::Belief& belief) {
  carrier_.set_belief(belief);
  belief_ = belief;
}

void LiveView::see(const nav_msgs::Path& path) {
  path_ = path;
  is_path_new_ = true;
}

void LiveView::see(const docent_msgs::GoalState& state) {
  goal_ = state;
  is_path_new_ = true;
}

LiveFrame LiveView::frame(Time now) const {
  LiveFrame frame;
  frame.now = now;
  frame.map_from_base = carrier_.map_from_base(frame.now);
  frame.linear = carrier_.linear();
  frame.angular = carrier_.angular();
  frame.p_lost = carrier_.p_lost();
  frame.battery = battery_;
  return frame;
}

void LiveView::add_scans(LiveFrame& frame) const {
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const sensor_msgs::LaserScan& scan = scans_[i];
    const Time taken = from_message(scan.header.stamp);
    if (scan.ranges.empty() || frame.now - taken > kFreshPose) continue;
    const Pose2 from_base = frame.is_scan_in_map ? *carrier_.map_from_base(taken) : Pose2{};
    frame.scan_origin = from_base.position();
    for (const Point2 point : scan_points(scan, mounts_[i], scan_step_)) frame.scan.push_back(from_base * point);
  }
}

std::string LiveView::live(Time now) const {
  LiveFrame shown = frame(now);
  if (!shown.map_from_base) shown.hypotheses = carrier_.hypotheses(now, 0.03);
  shown.is_scan_in_map = shown.map_from_base.has_value();
  add_scans(shown);
  if (now - from_message(people_.header.stamp) <= kFreshPose) shown.people = people_;
  if (avoid_ && now - from_message(avoid_->header.stamp) <= kFreshPose) shown.avoid = avoid_;
  return encode_live(shown);
}

std::optional<std::string> LiveView::belief() {
  if (!belief_) return std::nullopt;
  return encode_belief(*std::exchange(belief_, std::nullopt));
}

std::optional<std::string> LiveView::path() {
  if (!std::exchange(is_path_new_, false)) return std::nullopt;
  return encode_path(path_, goal_);
}

}  // namespace docent::telepresence
