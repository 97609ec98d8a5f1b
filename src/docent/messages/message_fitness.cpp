#include "docent/messages/message_fitness.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

namespace docent {

MessageFault fault_of(const sensor_msgs::LaserScan& scan) {
  constexpr float kMostBearing = 4.0F * std::numbers::pi_v<float>;
  // [rad] The virtual scan goes round twice, once for hazards and once for the border; both ends may be the same.
  constexpr double kMostField = 4.0 * std::numbers::pi + 0.1;
  constexpr float kFinest = 1e-5F;  // [rad] between two beams
  if (const MessageFault fault = fault_of(scan.header)) return fault;
  if (scan.ranges.size() > kMostBeams) return {"ranges", "are more than any scanner has"};
  if (!(std::abs(scan.angle_min) <= kMostBearing)) return {"angle_min", "is no bearing"};
  const float step = std::abs(scan.angle_increment);  // below 0: the scanner turns clockwise
  if (!(step >= 0.0F)) return {"angle_increment", "is no angle"};
  if (scan.ranges.size() > 1 && step < kFinest) return {"angle_increment", "is too small for several beams"};
  if (!(static_cast<double>(step) * (static_cast<double>(scan.ranges.size()) - 1.0) <= kMostField))
    return {"angle_increment", "takes the beams more than twice round"};
  if (!(scan.range_min >= 0.0F)) return {"range_min", "is no distance"};
  if (!(scan.range_max > scan.range_min)) return {"range_max", "is not above range_min"};
  if (!(scan.range_max <= kFarthestReading)) return {"range_max", "is farther than any scanner reaches"};
  return {};
}

MessageFault fault_of_virtual_scan(const sensor_msgs::LaserScan& scan) {
  const auto step = static_cast<double>(scan.angle_increment);
  const double turns = step * static_cast<double>(scan.ranges.size()) / (2.0 * std::numbers::pi);
  // Half of the readings are one turn: the second begins where the first began, nearer than to any neighbour.
  if (scan.ranges.size() % 2 != 0 || !(std::abs(turns - 2.0) * 2.0 * std::numbers::pi < step))
    return {"ranges", "do not go round twice, for hazards and for the border"};
  if (std::any_of(scan.ranges.begin(), scan.ranges.end(), [](float range) { return std::isnan(range); }))
    return {"ranges", "have a direction without a number"};
  return {};
}

MessageFault fault_of_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& pose) {
  if (pose.header.frame_id != "map") return {"frame_id", "is not map"};
  const auto& covariance = pose.pose.covariance;
  constexpr std::array<std::size_t, 3> kVariances{0, 7, 35};  // x, y, yaw of six
  for (const std::size_t i : kVariances)
    if (!(covariance[i] >= 0.0)) return {"covariance", "has a variance below 0"};
  if (!(std::max(covariance[0], covariance[7]) <= kWidestPose * kWidestPose))
    return {"covariance", "is wider than 10 m: it names no place"};
  return {};
}

MessageFault fault_of_goal_pose(const geometry_msgs::PoseStamped& pose) {
  if (pose.header.frame_id != "map") return {"frame_id", "is not map"};
  return {};
}

MessageFault fault_of(const sensor_msgs::Range& range) {
  constexpr float kRound = 2.0F * std::numbers::pi_v<float>;
  if (const MessageFault fault = fault_of(range.header)) return fault;
  if (!(range.field_of_view >= 0.0F && range.field_of_view <= kRound)) return {"field_of_view", "is no angle"};
  if (!(std::abs(range.min_range) <= kFarthestReading)) return {"min_range", "is no distance"};
  if (!(range.max_range > 0.0F && range.max_range <= kFarthestReading)) return {"max_range", "is no reach"};
  return {};
}

MessageFault fault_of(const sensor_msgs::BatteryState& battery) {
  if (const MessageFault fault = fault_of(battery.header)) return fault;
  if (!(battery.percentage >= 0.0F && battery.percentage <= 1.01F)) return {"percentage", "is no share from 0 to 1"};
  return {};
}

MessageFault fault_of(const sensor_msgs::CompressedImage& picture) {
  if (const MessageFault fault = fault_of(picture.header)) return fault;
  if (picture.format.size() > kLongestFrame) return {"format", "is too long"};
  if (picture.data.size() > kMostPictureBytes) return {"data", "is more than 2 MB"};
  return {};
}

MessageFault fault_of(const sensor_msgs::Image& picture) {
  if (const MessageFault fault = fault_of(picture.header)) return fault;
  if (picture.encoding.size() > kLongestFrame) return {"encoding", "is too long"};
  if (picture.data.size() > kMostImageBytes) return {"data", "is more than 64 MB"};
  if (picture.data.size() != std::uint64_t{picture.step} * picture.height) return {"data", "does not fill the picture"};
  if (picture.width > picture.step) return {"step", "is less than a row has"};
  return {};
}

MessageFault fault_of(const docent_msgs::CameraView& view) {
  constexpr double kRound = 2.0 * std::numbers::pi;
  if (!(std::abs(view.pan) <= kRound)) return {"pan", "is no angle"};
  if (!(std::abs(view.tilt) <= kRound)) return {"tilt", "is no angle"};
  if (!(view.field_of_view > 0.0 && view.field_of_view < std::numbers::pi)) return {"field_of_view", "is none"};
  return fault_of(view.header);
}

MessageFault fault_of(const docent_msgs::Steering& steering) {
  if (!(std::abs(steering.forward) <= 1.0)) return {"forward", "is no share from -1 to 1"};
  if (!(std::abs(steering.turn) <= 1.0)) return {"turn", "is no share from -1 to 1"};
  return fault_of_fields(steering);
}

MessageFault fault_of(const nav_msgs::Odometry& odometry) {
  FitnessCheck check;
  check("header", odometry.header);
  check("child_frame_id", odometry.child_frame_id);
  check("pose", odometry.pose.pose);
  const auto& twist = odometry.twist.twist;
  if (!(std::abs(twist.linear.x) <= kFastest)) check.note("twist.linear.x", "is no velocity of a base");
  if (!(std::abs(twist.angular.z) <= kFastest)) check.note("twist.angular.z", "is no turn rate of a base");
  return check.fault();
}

MessageFault fault_of(const nav_msgs::OccupancyGrid& map) {
  if (const MessageFault fault = fault_of_fields(map)) return fault;
  if (!(map.info.resolution > 0.0F && map.info.resolution < 10.0F)) return {"resolution", "is none of a map"};
  if (map.data.size() != std::uint64_t{map.info.width} * map.info.height) return {"data", "does not fill the map"};
  return {};
}

MessageFault fault_of(const builtin_interfaces::Time& time) {
  constexpr std::uint32_t kSecond = 1000000000;
  if (time.nanosec >= kSecond) return {"nanosec", "is a second or more"};
  return {};
}

MessageFault fault_of(const std_msgs::Header& header) {
  if (header.frame_id.size() > kLongestFrame) return {"frame_id", "is too long"};
  return fault_of(header.stamp);
}

MessageFault fault_of(const geometry_msgs::Quaternion& q) {
  const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(square - 1.0) < 0.1)) return {"rotation", "is none: its length is not 1"};
  return {};
}

MessageFault fault_of(const docent_msgs::Belief& belief) {
  if (belief.cells.size() > kMostBelievedCells) return {"cells", "are more than a belief has"};
  if (belief.rest.mass.size() != std::uint64_t{belief.rest.columns} * belief.rest.rows)
    return {"rest.mass", "does not fill its squares"};
  return fault_of_fields(belief);
}

MessageFault fault_of(const docent_msgs::PersonBeams& beams) {
  if (beams.x.size() != beams.y.size()) return {"x", "and y are not of one length"};
  if (beams.ranges.size() != beams.bearings.size() || beams.origins.size() != beams.bearings.size())
    return {"bearings", "ranges and origins are not of one length"};
  if (beams.bearings.size() > 2 * kMostBeams || beams.x.size() > 2 * kMostBeams)
    return {"bearings", "are more than any scanners have"};
  return fault_of_fields(beams);
}

MessageFault fault_of(const docent_msgs::Limits& limits) {
  if (!(limits.max_speed >= 0.0 && limits.max_speed <= kFastest)) return {"max_speed", "is no speed"};
  // A volume beyond the loudest is no reason to be deaf to the speed: those who make sound take it for the loudest.
  return fault_of_fields(limits);
}

MessageFault fault_of(const docent_msgs::Calibration& calibration) {
  constexpr double kLargestRobot = 5.0;  // [m]
  constexpr double kMostDelay = 2.0;     // [s]
  constexpr double kMostScale = 5.0;
  if (const MessageFault fault = fault_of_fields(calibration)) return fault;
  for (const docent_msgs::CalibratedMount& mount : calibration.mounts) {
    if (!(std::abs(mount.x) <= kLargestRobot && std::abs(mount.y) <= kLargestRobot))
      return {"mounts", "lie off the robot"};
    if (!(std::abs(mount.heading) <= 4.0 * std::numbers::pi)) return {"mounts", "look nowhere"};
    if (!(std::abs(mount.delay) <= kMostDelay)) return {"mounts", "have a delay that none has"};
    if (!(mount.doubt_heading >= 0.0 && mount.doubt_heading <= std::numbers::pi && mount.doubt_position >= 0.0 &&
          mount.doubt_position <= kLargestRobot))
      return {"mounts", "have a doubt that is none"};
  }
  if (!(calibration.most_speed >= 0.0 && calibration.most_speed <= kFastest)) return {"most_speed", "is no speed"};
  for (const double scale : {calibration.way_scale, calibration.turn_scale})
    if (!(scale >= 1.0 / kMostScale && scale <= kMostScale)) return {"scale", "is that of no base"};
  return {};
}

MessageFault fault_of(const docent_msgs::LiveMapUpdate& update) {
  if (const MessageFault fault = fault_of_fields(update)) return fault;
  constexpr std::int32_t kMostCells = 1000000;  // along a side
  if (update.x < 0 || update.y < 0 || update.x > kMostCells || update.y > kMostCells) return {"x", "lies in no map"};
  if (update.width > static_cast<std::uint32_t>(kMostCells) || update.height > static_cast<std::uint32_t>(kMostCells))
    return {"width", "is that of no map"};
  if (update.data.size() != std::uint64_t{update.width} * update.height) return {"data", "does not fill the rectangle"};
  return {};
}

}  // namespace docent
