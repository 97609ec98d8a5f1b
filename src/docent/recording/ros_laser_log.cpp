#include "docent/recording/ros_laser_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "docent/base/text.h"
#include "docent/messages/cdr.h"
#include "docent/messages/conversions.h"
#include "docent/recording/log_odometry.h"
#include "docent/recording/log_scanners.h"

namespace docent::recording {
namespace {

constexpr Duration kStep = std::chrono::milliseconds{20};  ///< from message to message, where their order is all
constexpr double kTilt = 0.15;                             ///< [rad] from here on a scanner's plane is not the floor's
constexpr double kStill = 1e-3;                            ///< [m, rad]
constexpr double kLeastWayBySpeeds = 1.0;                  ///< [m] by speeds
constexpr Duration kApart = std::chrono::seconds{1};       ///< clocks; less may be the time that a message takes

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

std::vector<RecordedStamp> with_times(const std::vector<Time>& times, std::vector<RecordedStamp> stamps) {
  for (std::size_t i = 0; i < times.size(); ++i) stamps[i].stamp = times[i];
  return stamps;
}

bool is_same(const LoggedOdometry& a, const LoggedOdometry& b) {
  const Pose2 &x = a.odom_from_base, &y = b.odom_from_base;
  return x.x == y.x && x.y == y.y && x.theta.radians() == y.theta.radians();
}
bool is_same(const sensor_msgs::LaserScan& a, const sensor_msgs::LaserScan& b) {
  const auto is_one = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::equal(a.ranges.begin(), a.ranges.end(), b.ranges.begin(), b.ranges.end(), is_one);
}

/// [m] that the speeds of these readings come to.
double way_by_speeds(const std::vector<LoggedOdometry>& readings) {
  double way = 0.0;
  for (std::size_t i = 1; i < readings.size(); ++i)
    way += std::abs(readings[i].linear) * std::clamp(to_seconds(readings[i].time - readings[i - 1].time), 0.0, 1.0);
  return way;
}

}  // namespace

RecordedStamp RosLaserLogBuilder::stamp_of(const std_msgs::Header& header, Time recorded) const {
  const Time stamp = from_message(header.stamp);
  return {stamp.nanoseconds == 0 || options_.times == LogTimes::index ? recorded : stamp, recorded};
}

std::string RosLaserLogBuilder::robot_of(const std::string& topic, const geometry_msgs::TransformStamped& transform) {
  const std::string prefix = prefix_of(transform.child_frame_id);
  return name_space_of(topic) + (prefix.empty() ? "" : "/") + prefix;
}

template <class T>
void RosLaserLogBuilder::put_in_order(const std::string& topic, std::vector<T>& messages) {
  const auto content = [](const T& message) -> const auto& {
    if constexpr (requires { message.reading; })
      return message.reading;
    else
      return message.message;
  };
  std::stable_sort(messages.begin(), messages.end(),
                   [](const T& a, const T& b) { return a.stamp.recorded < b.stamp.recorded; });
  const auto again = std::unique(messages.begin(), messages.end(), [&](const T& a, const T& b) {
    return a.stamp.recorded == b.stamp.recorded && a.stamp.stamp == b.stamp.stamp && is_same(content(a), content(b));
  });
  if (const auto count = std::distance(again, messages.end()); count > 0)
    log_.notes.push_back(std::to_string(count) + " messages of " + topic + " are in it twice: each is read once");
  messages.erase(again, messages.end());
}

void RosLaserLogBuilder::refuse(const std::string& topic, const std::string& why) {
  Refused& refused = refused_[topic];
  if (refused.count++ == 0) refused.first = why;
}

template <class T>
void RosLaserLogBuilder::add_as(const Rosbag2Message& message,
                                void (RosLaserLogBuilder::*take)(const std::string&, T, Time)) {
  auto content = decode_cdr<T>(message.data);
  if (!content) return refuse(message.topic, "damaged");
  (this->*take)(message.topic, std::move(*content), message.time);
}

void RosLaserLogBuilder::add(const Rosbag2Message& message) {
  const bool is_wanted = message.type == sensor_msgs::LaserScan::kType || message.type == nav_msgs::Odometry::kType ||
                         message.type == tf2_msgs::TFMessage::kType ||
                         (options_.with_sonars && message.type == sensor_msgs::Range::kType);
  // Docent's virtual measurements come from the map, not from a sensor.
  if (!is_wanted) others_.try_emplace(message.topic, message.type);
  if (!is_wanted || message.topic.starts_with("/docent/")) return;
  Rosbag2Message timed = message;
  if (options_.times == LogTimes::index)
    timed.time = Time{} + count_++ * kStep;
  else if (message.time < Time{} || to_seconds(message.time) > kLastSecond)
    return refuse(message.topic, "the time in the file lies before 1970 or beyond 2106");
  if (message.type == sensor_msgs::LaserScan::kType) {
    add_as<sensor_msgs::LaserScan>(timed, &RosLaserLogBuilder::take_scan);
  } else if (message.type == sensor_msgs::Range::kType) {
    add_as<sensor_msgs::Range>(timed, &RosLaserLogBuilder::take_ping);
  } else if (message.type == nav_msgs::Odometry::kType) {
    add_as<nav_msgs::Odometry>(timed, &RosLaserLogBuilder::take_odometry);
  } else {
    add_as<tf2_msgs::TFMessage>(timed, &RosLaserLogBuilder::take_transforms);
  }
}

void RosLaserLogBuilder::take_scan(const std::string& topic, sensor_msgs::LaserScan message, Time recorded) {
  if (message.ranges.empty()) return refuse(topic, "a scan without readings");
  message = in_order(std::move(message));
  // A driver that states no reach, or 0: it shows in the readings.
  if (!(message.range_max > message.range_min) && message.range_min >= 0.0F)
    message.range_max = static_cast<float>(kFarthestReading);
  if (const MessageFault fault = fault_of(message)) return refuse(topic, fault.text());
  message.header.frame_id = plain_frame(message.header.frame_id);
  message.intensities.clear();
  scans_[topic].push_back({stamp_of(message.header, recorded), std::move(message)});
}

void RosLaserLogBuilder::take_odometry(const std::string& topic, nav_msgs::Odometry message, Time recorded) {
  if (const MessageFault fault = fault_of(message)) return refuse(topic, fault.text());
  LoggedOdometry reading;
  reading.odom_from_base = from_message(message.pose.pose);
  reading.linear = message.twist.twist.linear.x;
  reading.angular = message.twist.twist.angular.z;
  OdometryTopic& of = odometry_[topic];
  of.topic = topic;
  of.readings.push_back({stamp_of(message.header, recorded), reading});
  of.parent = plain_frame(message.header.frame_id);
  of.child = plain_frame(message.child_frame_id);
}

void RosLaserLogBuilder::take_transforms(const std::string& topic, tf2_msgs::TFMessage message, Time recorded) {
  const std::string name = topic.substr(topic.rfind('/') + 1);
  if (name != "tf" && name != "tf_static") return;
  FrameTree& frames = frames_[name_space_of(topic)];
  for (auto& transform : message.transforms) {
    if (const MessageFault fault = fault_of(transform)) {
      refuse(topic, fault.text());
    } else if (name == "tf_static") {
      frames.add_static(transform);
    } else if (tells_odometry(transform)) {
      LoggedOdometry reading;
      const auto& place = transform.transform.translation;
      reading.odom_from_base = from_message(geometry_msgs::Pose{{place.x, place.y, 0.0}, transform.transform.rotation});
      OdometryTopic& of = tf_odometry_[robot_of(topic, transform)];
      const std::string child = plain_frame(transform.child_frame_id);
      if (!of.readings.empty() && child != of.child) {  // two frames of one robot
        if (!is_base(child) || is_base(of.child)) continue;
        of.readings.clear();
      }
      of.topic = topic;
      of.readings.push_back({stamp_of(transform.header, recorded), reading});
      of.parent = plain_frame(transform.header.frame_id);
      of.child = plain_frame(transform.child_frame_id);
    } else {
      frames.add_moving(transform);
    }
  }
}

void RosLaserLogBuilder::take_ping(const std::string& topic, sensor_msgs::Range message, Time recorded) {
  constexpr std::uint8_t kUltrasound = 0;
  if (const MessageFault fault = fault_of(message)) return refuse(topic, fault.text());
  if (message.radiation_type != kUltrasound) return;
  const bool no_return = message.range >= message.max_range;  // +infinity too
  if (!no_return && !(message.range >= message.min_range && message.range > 0.0F)) return;
  Ping ping;
  ping.frame = plain_frame(message.header.frame_id);
  ping.ping.time = stamp_of(message.header, recorded).stamp;
  ping.ping.range = no_return ? std::numeric_limits<float>::infinity() : message.range;
  log_.sonar_max_range = std::max(log_.sonar_max_range, static_cast<double>(message.max_range));
  pings_.push_back(std::move(ping));
}

void RosLaserLogBuilder::finish_pings() {
  std::map<std::string, int> sonars;  // by frame; -1: nobody knows where it is
  for (const Ping& ping : pings_) sonars[ping.frame] = -1;
  for (auto& [frame, index] : sonars) {
    if (const auto mount = frames_of(chosen_.robot + "/tf").mount_of(frame, base_frame_)) {
      index = static_cast<int>(log_.base_from_sonar.size());
      log_.base_from_sonar.push_back(mount->base_from_sensor);
    } else {
      log_.notes.push_back("the place of the sonar '" + frame + "' is unknown: its readings are left out");
    }
  }
  std::stable_sort(pings_.begin(), pings_.end(),
                   [](const Ping& a, const Ping& b) { return a.ping.time < b.ping.time; });
  for (Ping& ping : pings_) {
    ping.ping.sonar = sonars[ping.frame];
    if (ping.ping.sonar < 0) continue;
    ping.ping.odom_from_base = odometry_at(log_, ping.ping.time);
    log_.pings.push_back(ping.ping);
  }
}

std::string RosLaserLogBuilder::refused_text() const {
  std::string text;
  for (const auto& [topic, refused] : refused_)
    text += (text.empty() ? "" : ", ") + std::to_string(refused.count) + " of " + topic + " (" + refused.first + ")";
  return text;
}

/// With what is there instead, and what to do with it.
Error RosLaserLogBuilder::no_scan() const {
  constexpr std::size_t kMostNamed = 6;
  std::string text = "holds no laser scan (sensor_msgs/LaserScan)";
  if (const std::string refused = refused_text(); !refused.empty()) text += " that is fit; refused: " + refused;
  bool has_cloud = false, has_echoes = false;
  std::vector<std::string> there;
  for (const auto& [topic, of] : odometry_) there.push_back(topic + " (" + nav_msgs::Odometry::kType + ")");
  for (const auto& [topic, type] : others_) {
    const bool is_cloud = type.find("PointCloud") != std::string::npos;
    const bool is_echoes = type.find("MultiEchoLaserScan") != std::string::npos;
    has_cloud = has_cloud || is_cloud;
    has_echoes = has_echoes || is_echoes;
    there.insert(is_cloud || is_echoes ? there.begin() : there.end(), topic + " (" + type + ")");
  }
  if (there.size() > kMostNamed) {
    const std::string more = std::to_string(there.size() - kMostNamed) + " more";
    there.resize(kMostNamed);
    there.push_back(more);
  }
  if (!there.empty()) text += "; it holds " + listed(there);
  if (has_cloud)
    text +=
        "; pointcloud_to_laserscan makes scans of a cloud: play the recording, and record the topic that it publishes";
  if (has_echoes) text += "; laser_proc makes scans of several echoes: record its topic `first`";
  return {text};
}

std::vector<Time> RosLaserLogBuilder::followed(const std::string& name, const std::vector<RecordedStamp>& stamps) {
  MendedStamps mended = mended_stamps(stamps);
  if (mended.mended > 0)
    log_.notes.push_back("the clock that stamps " + name + " jumps or stands: " + std::to_string(mended.mended) +
                         " of " + std::to_string(stamps.size()) + " stamps are moved by the times of the file");
  RisingStamps rising;
  for (Time& time : mended.times) time = rising.follow(time);
  if (rising.set_back() > 0)
    log_.notes.push_back("the clock that stamps " + name + " was set back: later stamps are moved as far");
  return std::move(mended.times);
}

FrameTree RosLaserLogBuilder::frames_of(const std::string& topic) const {
  FrameTree all;
  bool has_robot = false;
  for (std::string around = name_space_of(topic);; around = name_space_of(around)) {
    const bool is_robot = std::any_of(odometry_.begin(), odometry_.end(),
                                      [&](const auto& of) { return name_space_of(of.first) == around; });
    // What another robot says of its own frames, which may have the same names, is none of this one's.
    const auto frames = frames_.find(around);
    if (frames != frames_.end() && !(has_robot && is_robot)) all.add(frames->second);
    has_robot = has_robot || is_robot;
    if (around.empty()) return all;
  }
}

std::vector<std::string> RosLaserLogBuilder::bases() const {
  std::vector<std::string> all;
  for (const auto* const topics : {&odometry_, &tf_odometry_})
    for (const auto& [name, of] : *topics) all.push_back(of.child);
  return all;
}

void RosLaserLogBuilder::say_of_mount(const std::string& frame, const std::optional<Mount>& mount) {
  const std::string name = "the laser '" + frame + "' ";
  if (!mount)
    log_.notes.push_back("the place of the laser '" + frame + "' is unknown: the robot's centre is taken");
  else if (mount->moves)
    log_.notes.push_back(name + "moves on the robot: it is taken to be where it is in the end");
  else if (mount->tilt > kTilt)
    log_.notes.push_back(name + "is tilted by " + std::to_string(std::lround(mount->tilt * 180.0 / std::numbers::pi)) +
                         " degrees: its readings are taken to be level");
}

Result<void> RosLaserLogBuilder::choose() {
  RecordedTopics recorded;
  for (const auto& [topic, of] : odometry_) recorded.odometry[topic] = {of.readings.size(), of.parent, of.child};
  for (const auto& [name_space, of] : tf_odometry_) recorded.transforms[name_space] = of.readings.size();
  for (const auto& [topic, scans] : scans_) {
    const std::string& frame = scans.front().message.header.frame_id;
    const FrameTree frames = frames_of(topic);
    const std::vector<std::string> all = bases();
    const bool has_place =
        std::any_of(all.begin(), all.end(),
                    [&](const std::string& base) { return frames.mount_of(frame, base).has_value(); }) ||
        frames.mount_of(frame, "").has_value();
    recorded.scans[topic] = {scans.size(), frame, has_place};
  }
  auto chosen = choose_topics(recorded, options_.topics);
  if (!chosen) return tl::unexpected<Error>(chosen.error());
  chosen_ = std::move(*chosen);
  log_.notes.insert(log_.notes.end(), chosen_.notes.begin(), chosen_.notes.end());
  log_.sources =
      "scans of " + listed(chosen_.scans) +
      (!chosen_.odometry.empty()  ? ", odometry of " + chosen_.odometry
       : chosen_.is_by_transforms ? ", odometry of the transforms of " + tf_odometry_[chosen_.transforms].topic
                                  : ", no odometry");
  return {};
}

void RosLaserLogBuilder::use_odometry() {
  OdometryTopic none;
  OdometryTopic& of = !chosen_.odometry.empty()  ? odometry_[chosen_.odometry]
                      : chosen_.is_by_transforms ? tf_odometry_[chosen_.transforms]
                                                 : none;
  if (of.readings.empty())
    log_.notes.emplace_back("there is no odometry: the robot is taken to stand still between scans");
  base_frame_ = of.child;
  const std::string& name = of.topic;
  put_in_order(name, of.readings);
  std::vector<RecordedStamp> stamps;
  for (const Odometry& one : of.readings) stamps.push_back(one.stamp);
  const std::vector<Time> times = followed(name, stamps);
  odometry_clock_ = with_times(times, stamps);
  for (std::size_t i = 0; i < of.readings.size(); ++i) {
    of.readings[i].reading.time = times[i];
    log_.odometry.push_back(of.readings[i].reading);
  }
  const auto stands = [&](const LoggedOdometry& reading) {
    const Pose2 &pose = reading.odom_from_base, &first = log_.odometry.front().odom_from_base;
    return distance(pose.position(), first.position()) < kStill &&
           std::abs((pose.theta - first.theta).radians()) < kStill;
  };
  if (std::all_of(log_.odometry.begin(), log_.odometry.end(), stands) &&
      way_by_speeds(log_.odometry) > kLeastWayBySpeeds)
    log_.notes.push_back("the odometry of " + name + " says speeds, but its place stands: so does the robot here");
  take_out_jumps();
  std::stable_sort(log_.odometry.begin(), log_.odometry.end(),
                   [](const LoggedOdometry& a, const LoggedOdometry& b) { return a.time < b.time; });
}

void RosLaserLogBuilder::take_out_jumps() {
  LogOdometry unbroken{options_.times != LogTimes::index};
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
}

void RosLaserLogBuilder::use_scans(const std::string& topic) {
  std::vector<Scan>& scans = scans_[topic];
  put_in_order(topic, scans);
  std::vector<RecordedStamp> stamps;
  for (const Scan& one : scans) stamps.push_back(one.stamp);
  std::vector<Time> times = followed("the scans of " + topic, stamps);
  const Duration apart = clock_ahead(with_times(times, stamps), odometry_clock_);
  if (apart > kApart || apart < -kApart) {
    for (Time& time : times) time = time - apart;
    log_.notes.push_back("the scans of " + topic + " are stamped by a clock that is " +
                         std::to_string(std::llround(to_seconds(apart))) +
                         " s ahead of that of odometry: they are moved by the times of the file");
  }
  const std::string frame = scans.front().message.header.frame_id;
  const auto mount = frames_of(topic).mount_of(frame, base_frame_);
  say_of_mount(frame, mount);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const sensor_msgs::LaserScan& message = scans[i].message;
    const auto range_max = static_cast<double>(message.range_max);
    ranges_.add(topic, message.ranges, range_max);
    LoggedScan scan;
    scan.time = times[i];
    scan.first_bearing = Angle::radians(static_cast<double>(message.angle_min));
    scan.bearing_step = static_cast<double>(message.angle_increment);
    scan.ranges.reserve(message.ranges.size());
    for (const float range : message.ranges) {
      const bool no_return = range >= message.range_max;  // +infinity too
      const bool is_zero = range == 0.0F;                 // what it means is settled in the end
      const bool invalid = !is_zero && (!(range >= message.range_min) || !(range > 0.0F));
      scan.ranges.push_back(no_return ? std::numeric_limits<float>::infinity()
                                      : (invalid ? std::numeric_limits<float>::quiet_NaN() : range));
    }
    if (message.range_max < kFarthestReading) {
      scan.max_range = range_max;
      log_.max_range = std::max(log_.max_range, range_max);
    }
    if (mount) {
      scan.base_from_laser = mount->base_from_sensor;
      if (mount->is_upside_down) {
        scan.first_bearing = -scan.first_bearing;
        scan.bearing_step = -scan.bearing_step;
      }
    }
    scan.rear = std::abs(scan.base_from_laser.theta.degrees()) > 90.0;
    log_.scans.push_back(std::move(scan));
    scan_frames_.push_back(frame);
  }
}

Result<LaserLog> RosLaserLogBuilder::finish() {
  const std::string refused = refused_text();
  if (scans_.empty()) return tl::unexpected<Error>(no_scan());
  if (!refused.empty()) log_.notes.push_back("messages that cannot be were left out: " + refused);
  if (auto chosen = choose(); !chosen) return tl::unexpected<Error>(chosen.error());
  if (options_.times == LogTimes::index) {
    log_.times_are_invented = true;
    log_.notes.emplace_back("times go by the order of the messages alone, 0.02 s from one to the next");
  }
  use_odometry();
  for (const std::string& topic : chosen_.scans) use_scans(topic);
  if (const auto judged = ranges_.judge(log_.notes); !judged) return tl::unexpected<Error>(judged.error());
  std::vector<std::size_t> order(log_.scans.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return log_.scans[a].time < log_.scans[b].time; });
  std::vector<LoggedScan> scans;
  std::vector<std::string> frames;
  for (const std::size_t i : order) {
    LoggedScan& scan = log_.scans[i];
    scan.odom_from_base = odometry_at(log_, scan.time);
    scan.logged_pose = scan.odom_from_base;
    scans.push_back(std::move(scan));
    frames.push_back(scan_frames_[i]);
  }
  log_.scans = std::move(scans);
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
