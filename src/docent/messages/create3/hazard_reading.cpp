#include "docent/messages/create3/hazard_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace docent {
namespace {

using irobot_create_msgs::HazardDetection;

struct Sensor {
  std::string_view frame;
  double bearing;  // [deg] of its middle, counter-clockwise from the front
};
// Each of the five bumpers has a fifth of the front half.
constexpr std::array kBumpers{Sensor{"bump_right", -72.0}, Sensor{"bump_front_right", -36.0},
                              Sensor{"bump_front_center", 0.0}, Sensor{"bump_front_left", 36.0},
                              Sensor{"bump_left", 72.0}};
constexpr double kBumperWidth = 36.0;  // [deg]
constexpr std::array kCliffs{Sensor{"cliff_side_right", -60.0}, Sensor{"cliff_front_right", -17.0},
                             Sensor{"cliff_front_left", 17.0}, Sensor{"cliff_side_left", 60.0}};
constexpr std::uint8_t kNoReading = 255;

/// The last part of a frame's name: a base with a name space puts that before it.
std::string_view own_name(std::string_view frame) { return frame.substr(frame.rfind('/') + 1); }

/// nullopt: a sensor that is not known.
template <std::size_t N>
std::optional<double> bearing_of(const std::array<Sensor, N>& sensors, std::string_view frame) {
  for (const Sensor& sensor : sensors)
    if (sensor.frame == own_name(frame)) return sensor.bearing;
  return std::nullopt;
}

void press(std::vector<std::uint8_t>& segments, double bearing) {
  const double step = 360.0 / static_cast<double>(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    if (std::abs(std::remainder(step * static_cast<double>(i) - bearing, 360.0)) <= 0.5 * kBumperWidth) segments[i] = 1;
}

/// Across a direction, so far from the robot's centre.
Segment across(double bearing_deg, double distance, double width) {
  const double bearing = bearing_deg * std::numbers::pi / 180.0;
  const Point2 middle{distance * std::cos(bearing), distance * std::sin(bearing)};
  const Point2 half{-0.5 * width * std::sin(bearing), 0.5 * width * std::cos(bearing)};
  return {{middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y}};
}

Point2 middle_of(const Segment& segment) {
  return {0.5 * (segment.a.x + segment.b.x), 0.5 * (segment.a.y + segment.b.y)};
}

}  // namespace

HazardReading HazardReader::read(const irobot_create_msgs::HazardDetectionVector& hazards, bool is_kidnapped,
                                 const Pose2& odom_from_base, double speed, Time now) {
  HazardReading reading;
  reading.segments.assign(kSegments, 0);
  reading.is_lifted =
      is_kidnapped || std::any_of(hazards.detections.begin(), hazards.detections.end(),
                                  [](const auto& one) { return one.type == HazardDetection::kWheelDrop; });
  if (reading.is_lifted) {
    // A lifted base finds cliffs everywhere, and stands elsewhere afterwards.
    edges_.clear();
    reading.segments.assign(kSegments, kNoReading);
    return reading;
  }
  bool backs_no_farther = false;
  for (const HazardDetection& hazard : hazards.detections) {
    if (hazard.type == HazardDetection::kBump) {
      // Of a bumper that is not known nobody knows where it is: the whole front.
      if (const auto bearing = bearing_of(kBumpers, hazard.header.frame_id))
        press(reading.segments, *bearing);
      else
        for (const Sensor& bumper : kBumpers) press(reading.segments, bumper.bearing);
    } else if (hazard.type == HazardDetection::kStall) {
      press(reading.segments, speed < 0.0 ? 180.0 : 0.0);
    } else if (hazard.type == HazardDetection::kCliff) {
      const double bearing = bearing_of(kCliffs, hazard.header.frame_id).value_or(0.0);
      const Segment edge = across(bearing, radius_ + params_.edge_ahead, params_.edge_width);
      remember({odom_from_base * edge.a, odom_from_base * edge.b}, now);
    } else if (hazard.type == HazardDetection::kBackupLimit) {
      backs_no_farther = true;
    }
  }
  reading.is_touched = std::find(reading.segments.begin(), reading.segments.end(), 1) != reading.segments.end();
  std::erase_if(edges_, [&](const Edge& edge) { return now - edge.seen > seconds(params_.edge_memory); });
  const Pose2 base_from_odom = inverse(odom_from_base);
  for (const Edge& edge : edges_)
    reading.edges.push_back({base_from_odom * edge.in_odom.a, base_from_odom * edge.in_odom.b});
  if (backs_no_farther) reading.edges.push_back(across(180.0, radius_ + params_.back_margin, params_.edge_width));
  return reading;
}

void HazardReader::remember(const Segment& in_odom, Time now) {
  const Point2 middle = middle_of(in_odom);
  // The newest place counts: the same edge felt again.
  std::erase_if(edges_, [&](const Edge& edge) {
    const Point2 known = middle_of(edge.in_odom);
    return std::hypot(known.x - middle.x, known.y - middle.y) < params_.same_edge;
  });
  edges_.push_back({in_odom, now});
  if (edges_.size() > params_.most_edges) edges_.erase(edges_.begin());
}

}  // namespace docent
