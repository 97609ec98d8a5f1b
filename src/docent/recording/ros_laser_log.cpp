#include "docent/recording/ros_laser_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "docent/messages/cdr.h"
#include "docent/messages/conversions.h"
#include "docent/recording/log_scanners.h"

namespace docent::recording {
namespace {

constexpr int kMostLinks = 32;           ///< of a chain of frames; a longer one is a ring
constexpr double kFarthestMount = 20.0;  ///< [m] from the robot's centre; no robot is so large

/// Turns `v` by the rotation `q`.
geometry_msgs::Vector3 rotated(const geometry_msgs::Quaternion& q, const geometry_msgs::Vector3& v) {
  const auto cross = [](const geometry_msgs::Vector3& a, const geometry_msgs::Vector3& b) {
    return geometry_msgs::Vector3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const geometry_msgs::Vector3 axis{q.x, q.y, q.z};
  const auto once = cross(axis, v);
  const auto twice = cross(axis, once);
  return {v.x + 2.0 * (q.w * once.x + twice.x), v.y + 2.0 * (q.w * once.y + twice.y),
          v.z + 2.0 * (q.w * once.z + twice.z)};
}

/// The same scan with its beams in the order of rising bearings, and with a reach: drivers that know none say infinity.
sensor_msgs::LaserScan in_order(sensor_msgs::LaserScan scan) {
  if (scan.angle_increment < 0.0F && !scan.ranges.empty()) {
    scan.angle_min += scan.angle_increment * static_cast<float>(scan.ranges.size() - 1);
    scan.angle_increment = -scan.angle_increment;
    std::reverse(scan.ranges.begin(), scan.ranges.end());
  }
  if (scan.range_max > kFarthestReading) scan.range_max = kFarthestReading;
  return scan;
}

std::string without_slash(const std::string& frame) { return frame.starts_with('/') ? frame.substr(1) : frame; }

bool is_odometry(const geometry_msgs::TransformStamped& transform) {
  const std::string child = without_slash(transform.child_frame_id);
  return without_slash(transform.header.frame_id) == "odom" && (child == "base_link" || child == "base_footprint");
}

}  // namespace

template <class T>
bool RosLaserLogBuilder::admits(const T& content, const std::string& topic) {
  const MessageFault fault = fault_of(content);
  if (fault) refuse(topic, fault);
  return !fault;
}

void RosLaserLogBuilder::refuse(const std::string& topic, const MessageFault& fault) {
  Refused& refused = refused_[topic];
  if (refused.count++ == 0) refused.first = fault;
}

Result<void> RosLaserLogBuilder::add(const Rosbag2Message& message) {
  const auto damaged = [&] {
    return fail("damaged " + message.type + " on " + message.topic + " at " + std::to_string(to_seconds(message.time)) +
                " s");
  };
  if (std::abs(to_seconds(message.time)) > kLastSecond) {
    refuse(message.topic, {"the time in the file", "lies beyond the year 2106"});
    return {};
  }
  if (message.type == sensor_msgs::LaserScan::kType) {
    // Docent's virtual measurements come from the map, not from a sensor.
    if (message.topic.starts_with("/docent/")) return {};
    auto scan = decode_cdr<sensor_msgs::LaserScan>(message.data);
    if (!scan) return damaged();
    if (scan->ranges.empty()) return {};
    *scan = in_order(std::move(*scan));
    if (!admits(*scan, message.topic)) return {};
    ranges_.add(message.topic, scan->ranges, static_cast<double>(scan->range_max));
    add_scan(*scan, message.time);
  } else if (with_sonars_ && message.type == sensor_msgs::Range::kType) {
    const auto range = decode_cdr<sensor_msgs::Range>(message.data);
    if (!range) return damaged();
    if (admits(*range, message.topic)) add_ping(*range, message.time);
  } else if (message.type == nav_msgs::Odometry::kType) {
    const auto odometry = decode_cdr<nav_msgs::Odometry>(message.data);
    if (!odometry) return damaged();
    if (!admits(*odometry, message.topic)) return {};
    LoggedOdometry reading;
    reading.time = from_message(odometry->header.stamp);
    if (reading.time.nanoseconds == 0) reading.time = message.time;
    reading.time = stamps_[message.topic].follow(reading.time);
    reading.odom_from_base = from_message(odometry->pose.pose);
    reading.linear = odometry->twist.twist.linear.x;
    reading.angular = odometry->twist.twist.angular.z;
    odometry_[message.topic].push_back(reading);
    base_frames_[message.topic] = without_slash(odometry->child_frame_id);
  } else if (message.type == tf2_msgs::TFMessage::kType && message.topic == "/tf") {
    const auto transforms = decode_cdr<tf2_msgs::TFMessage>(message.data);
    if (!transforms) return damaged();
    for (const auto& transform : transforms->transforms)
      if (is_odometry(transform) && admits(transform, message.topic)) add_odometry(transform, message.time);
  } else if (message.type == tf2_msgs::TFMessage::kType && message.topic == "/tf_static") {
    const auto transforms = decode_cdr<tf2_msgs::TFMessage>(message.data);
    if (!transforms) return damaged();
    for (const auto& transform : transforms->transforms)
      if (admits(transform, message.topic)) static_transforms_[without_slash(transform.child_frame_id)] = transform;
  }
  return {};
}

void RosLaserLogBuilder::add_odometry(const geometry_msgs::TransformStamped& transform, Time log_time) {
  LoggedOdometry reading;
  reading.time = from_message(transform.header.stamp);
  if (reading.time.nanoseconds == 0) reading.time = log_time;
  reading.time = stamps_["/tf"].follow(reading.time);
  reading.odom_from_base = from_message(geometry_msgs::Pose{
      {transform.transform.translation.x, transform.transform.translation.y, 0.0}, transform.transform.rotation});
  tf_odometry_.push_back(reading);
  tf_base_frame_ = without_slash(transform.child_frame_id);
}

void RosLaserLogBuilder::add_scan(const sensor_msgs::LaserScan& message, Time log_time) {
  Scan scan;
  scan.time = from_message(message.header.stamp);
  if (scan.time.nanoseconds == 0) scan.time = log_time;
  scan.frame = without_slash(message.header.frame_id);
  scan.time = stamps_["scans of " + scan.frame].follow(scan.time);
  scan.scan.first_bearing = Angle::radians(static_cast<double>(message.angle_min));
  scan.scan.bearing_step = static_cast<double>(message.angle_increment);
  scan.scan.ranges.reserve(message.ranges.size());
  for (const float range : message.ranges) {
    const bool no_return = range >= message.range_max;  // +infinity too
    const bool is_zero = range == 0.0F;                 // what it means is settled in the end
    const bool invalid = !is_zero && (!(range >= message.range_min) || !(range > 0.0F));
    scan.scan.ranges.push_back(no_return ? std::numeric_limits<float>::infinity()
                                         : (invalid ? std::numeric_limits<float>::quiet_NaN() : range));
  }
  if (message.range_max < kFarthestReading) scan.scan.max_range = static_cast<double>(message.range_max);
  if (message.range_max < kFarthestReading)
    log_.max_range = std::max(log_.max_range, static_cast<double>(message.range_max));
  scans_.push_back(std::move(scan));
}

void RosLaserLogBuilder::add_ping(const sensor_msgs::Range& message, Time log_time) {
  constexpr std::uint8_t kUltrasound = 0;
  if (message.radiation_type != kUltrasound) return;
  const bool no_return = message.range >= message.max_range;  // +infinity too
  if (!no_return && !(message.range >= message.min_range && message.range > 0.0F)) return;
  Ping ping;
  ping.frame = without_slash(message.header.frame_id);
  ping.ping.time = from_message(message.header.stamp);
  if (ping.ping.time.nanoseconds == 0) ping.ping.time = log_time;
  ping.ping.range = no_return ? std::numeric_limits<float>::infinity() : message.range;
  log_.sonar_max_range = std::max(log_.sonar_max_range, static_cast<double>(message.max_range));
  pings_.push_back(std::move(ping));
}

void RosLaserLogBuilder::finish_pings() {
  std::map<std::string, int> sonars;  // by frame; -1: nobody knows where it is
  for (const Ping& ping : pings_) sonars[ping.frame] = -1;
  for (auto& [frame, index] : sonars) {
    if (const auto mount = mount_of(frame)) {
      index = static_cast<int>(log_.base_from_sonar.size());
      log_.base_from_sonar.push_back(mount->base_from_laser);
    } else {
      log_.notes.push_back("the place of the sonar '" + frame + "' is unknown: its readings are left out");
    }
  }
  std::stable_sort(pings_.begin(), pings_.end(),
                   [](const Ping& a, const Ping& b) { return a.ping.time < b.ping.time; });
  for (Ping& ping : pings_) {
    ping.ping.sonar = sonars[ping.frame];
    if (ping.ping.sonar < 0) continue;
    ping.ping.odom_from_base = odometry_at(ping.ping.time);
    log_.pings.push_back(ping.ping);
  }
}

std::optional<RosLaserLogBuilder::Mount> RosLaserLogBuilder::mount_of(const std::string& frame) const {
  // From the laser up to the base: each link takes what is known of the laser into its parent's frame.
  geometry_msgs::Vector3 origin{};
  geometry_msgs::Vector3 ahead{1.0, 0.0, 0.0};
  geometry_msgs::Vector3 up{0.0, 0.0, 1.0};
  std::string at = frame;
  for (int links = 0; links < kMostLinks; ++links) {
    if (at == base_frame_ || at == "base_link" || at == "base_footprint") {
      Mount mount;
      mount.base_from_laser = {origin.x, origin.y, Angle::radians(std::atan2(ahead.y, ahead.x))};
      mount.is_upside_down = up.z < 0.0;
      if (norm(mount.base_from_laser.position()) > kFarthestMount) return std::nullopt;
      return mount;
    }
    const auto link = static_transforms_.find(at);
    if (link == static_transforms_.end()) return std::nullopt;
    const geometry_msgs::Transform& parent_from_child = link->second.transform;
    origin = rotated(parent_from_child.rotation, origin);
    origin = {origin.x + parent_from_child.translation.x, origin.y + parent_from_child.translation.y,
              origin.z + parent_from_child.translation.z};
    ahead = rotated(parent_from_child.rotation, ahead);
    up = rotated(parent_from_child.rotation, up);
    at = without_slash(link->second.header.frame_id);
  }
  return std::nullopt;
}

Pose2 RosLaserLogBuilder::odometry_at(Time time) const {
  const auto& readings = log_.odometry;
  if (readings.empty()) return {};
  const auto after = std::lower_bound(readings.begin(), readings.end(), time,
                                      [](const LoggedOdometry& reading, Time wanted) { return reading.time < wanted; });
  if (after == readings.begin()) return after->odom_from_base;
  if (after == readings.end()) return readings.back().odom_from_base;
  const LoggedOdometry& before = *std::prev(after);
  const double share = to_seconds(time - before.time) / to_seconds(after->time - before.time);
  const Pose2& a = before.odom_from_base;
  const Pose2& b = after->odom_from_base;
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          Angle::radians(a.theta.radians() + share * (b.theta - a.theta).radians())};
}

void RosLaserLogBuilder::take_out_jumps() {
  LogOdometry unbroken;
  std::vector<LoggedOdometry> kept;
  kept.reserve(log_.odometry.size());
  for (LoggedOdometry& reading : log_.odometry) {
    const auto odom_from_base = unbroken.follow(reading.time, reading.odom_from_base);
    if (!odom_from_base) continue;
    reading.odom_from_base = *odom_from_base;
    kept.push_back(reading);
  }
  log_.odometry = std::move(kept);
  if (std::string note = unbroken.note(); !note.empty()) log_.notes.push_back(std::move(note));
  for (const auto& [name, stamps] : stamps_)
    if (stamps.set_back() > 0)
      log_.notes.push_back("the clock that stamps " + name + " was set back: later stamps are moved as far");
}

std::string RosLaserLogBuilder::refused_text() const {
  std::string text;
  for (const auto& [topic, refused] : refused_)
    text +=
        (text.empty() ? "" : ", ") + std::to_string(refused.count) + " of " + topic + " (" + refused.first.text() + ")";
  return text;
}

Result<LaserLog> RosLaserLogBuilder::finish() {
  const std::string refused = refused_text();
  if (scans_.empty())
    return fail(refused.empty() ? "holds no laser scan" : "holds no laser scan that is fit; refused: " + refused);
  if (!refused.empty()) log_.notes.push_back("messages that cannot be were left out: " + refused);
  if (const auto judged = ranges_.judge(log_.notes); !judged) return tl::unexpected<Error>(judged.error());
  const auto most = std::max_element(odometry_.begin(), odometry_.end(),
                                     [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (most == odometry_.end() && !tf_odometry_.empty()) {
    log_.odometry = std::move(tf_odometry_);
    base_frame_ = tf_base_frame_;
    log_.notes.emplace_back("there is no odometry topic: the transform odom -> " + base_frame_ + " of /tf is taken");
  } else if (most == odometry_.end()) {
    log_.notes.emplace_back("there is no odometry: the robot is taken to stand still between scans");
  } else {
    log_.odometry = std::move(most->second);
    base_frame_ = base_frames_[most->first];
    if (odometry_.size() > 1) log_.notes.push_back("of several odometry topics " + most->first + " is used");
  }
  take_out_jumps();
  std::stable_sort(log_.odometry.begin(), log_.odometry.end(),
                   [](const LoggedOdometry& a, const LoggedOdometry& b) { return a.time < b.time; });
  std::stable_sort(scans_.begin(), scans_.end(), [](const Scan& a, const Scan& b) { return a.time < b.time; });
  std::set<std::string> without_place;
  std::vector<std::string> frames;  // [scans]
  for (Scan& entry : scans_) {
    LoggedScan& scan = entry.scan;
    scan.time = entry.time;
    scan.odom_from_base = odometry_at(entry.time);
    scan.logged_pose = scan.odom_from_base;
    if (const auto mount = mount_of(entry.frame)) {
      scan.base_from_laser = mount->base_from_laser;
      if (mount->is_upside_down) {
        scan.first_bearing = -scan.first_bearing;
        scan.bearing_step = -scan.bearing_step;
      }
    } else if (without_place.insert(entry.frame).second) {
      log_.notes.push_back("the place of the laser '" + entry.frame + "' is unknown: the robot's centre is taken");
    }
    scan.rear = std::abs(scan.base_from_laser.theta.degrees()) > 90.0;
    log_.scans.push_back(std::move(scan));
    frames.push_back(entry.frame);
  }
  finish_pings();
  if (!(log_.max_range > 0.0)) {
    for (const LoggedScan& scan : log_.scans)
      for (const float range : scan.ranges)
        if (std::isfinite(range)) log_.max_range = std::max(log_.max_range, static_cast<double>(range));
  }
  settle_scanners(log_, frames);
  return std::move(log_);
}

}  // namespace docent::recording
