#include "docent/collision_avoidance/obstacle_field/seen_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace docent {

namespace {

constexpr double kBetweenLooks = 0.2;  // [s] at least, of those that are kept
constexpr double kEdge = 1.5;          // beams beyond the first and the last that the field still counts
constexpr double kBeyond = 0.05;       // [m] that a look must pass a place
constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// The beam that looks along a bearing [rad], sensor frame; negative or beyond the last: out of the field.
double beam_along(const SensorSweep& sweep, double bearing) {
  double beam = std::fmod(bearing - sweep.first_bearing, kFullTurn) / sweep.bearing_step;
  const double turn = kFullTurn / sweep.bearing_step;
  if (beam < -kEdge) beam += turn;
  return beam >= turn - kEdge ? beam - turn : beam;
}

bool is_in_field(const SensorSweep& sweep, double beam) {
  return beam >= -kEdge && beam <= static_cast<double>(sweep.ranges.size()) - 1.0 + kEdge;
}

}  // namespace

void SeenPlaces::add(std::size_t sensor, SensorSweep sweep, const Pose2& odom_from_base) {
  if (sweep.ranges.empty()) return;
  if (looks_.size() <= sensor) looks_.resize(sensor + 1);
  auto& looks = looks_[sensor];
  const bool is_as_before = !looks.empty() && looks.back().sweep.ranges.size() == sweep.ranges.size() &&
                            looks.back().sweep.first_bearing == sweep.first_bearing &&
                            looks.back().sweep.bearing_step == sweep.bearing_step;
  const std::size_t count = looks.size();
  if (all_round_ && count > 0) {
    looks.clear();
  } else if (count > 1 && looks.back().sweep.stamp - looks[count - 2].sweep.stamp < seconds(kBetweenLooks)) {
    looks.pop_back();
  }
  while (!looks.empty() && sweep.stamp - looks.front().sweep.stamp > seconds(seen_for_)) looks.pop_front();
  const Pose2 odom_from_sensor = odom_from_base * sweep.base_from_sensor;
  looks.push_back({std::move(sweep), PointTransform{inverse(odom_from_sensor)}});
  if (!is_as_before) all_round_ = look_all_round();
}

bool SeenPlaces::look_all_round() const {
  constexpr int kBearings = 360;
  for (int i = 0; i < kBearings; ++i) {
    const Angle bearing = Angle::radians(i * kFullTurn / kBearings);
    const bool is_seen = std::any_of(looks_.begin(), looks_.end(), [&](const auto& looks) {
      if (looks.empty()) return false;
      const SensorSweep& sweep = looks.back().sweep;
      return is_in_field(sweep, beam_along(sweep, (bearing - sweep.base_from_sensor.theta).radians()));
    });
    if (!is_seen) return false;
  }
  return true;
}

SeenPlaces::View SeenPlaces::view_of(const Look& look, Point2 in_odom) {
  const Point2 in_sensor = look.sensor_from_odom * in_odom;
  const SensorSweep& sweep = look.sweep;
  const double beam = beam_along(sweep, std::atan2(in_sensor.y, in_sensor.x));
  if (!is_in_field(sweep, beam)) return View::out_of_field;
  const auto last = static_cast<double>(sweep.ranges.size() - 1);
  const double range = sweep.ranges[static_cast<std::size_t>(std::clamp(std::round(beam), 0.0, last))];
  return range > norm(in_sensor) + kBeyond ? View::passed : View::met;
}

bool SeenPlaces::is_known(Point2 in_odom, Time now) const {
  for (const auto& looks : looks_)
    if (!looks.empty() && view_of(looks.back(), in_odom) != View::out_of_field) return true;
  for (const auto& looks : looks_) {
    for (auto look = looks.rbegin(); look != looks.rend() && now - look->sweep.stamp <= seconds(seen_for_); ++look) {
      const View view = view_of(*look, in_odom);
      if (view == View::passed) return true;
      if (view == View::met) break;
    }
  }
  return false;
}

void SeenPlaces::add_beside(std::vector<Point2>& places, const Pose2& odom_from_base, const BaseLimits& limits,
                            double margin, Time now) const {
  // A lattice that stays where it is in the odometry's frame: what came along with the robot could be crept into.
  constexpr double kStep = 0.05;        // [m]
  constexpr double kPastMargin = 0.08;  // [m]
  constexpr double kUncovered =
      0.02;  // [m] more at the sides of a disc: a turn uncovers places there between two sweeps
  const Point2 centre = odom_from_base.position();
  const PointTransform base_from_odom{inverse(odom_from_base)};
  const double reach = limits.radius + margin + kPastMargin;
  for (double x = std::ceil((centre.x - reach) / kStep) * kStep; x <= centre.x + reach; x += kStep) {
    for (double y = std::ceil((centre.y - reach) / kStep) * kStep; y <= centre.y + reach; y += kStep) {
      const Point2 in_base = base_from_odom * Point2{x, y};
      const double gap = limits.gap_to(in_base);
      const bool is_beside = limits.outline.empty() && in_base.x < 0.5 * norm(in_base);
      if (gap <= (is_beside ? margin + kUncovered : 0.0) || gap > margin + kPastMargin) continue;
      if (!is_known({x, y}, now)) places.push_back(in_base);
    }
  }
}

std::vector<Point2> SeenPlaces::unknown(const Pose2& odom_from_base, const BaseLimits& limits, double margin,
                                        Time now) const {
  std::vector<Point2> places;
  if (all_round_) return places;
  add_beside(places, odom_from_base, limits, margin, now);
  constexpr int kPlaces = 48;  // of a line round the body
  const PointTransform odom_from_place{odom_from_base};
  for (const double beyond : {0.25, 0.6, 1.0, 1.6, kReach}) {
    for (int i = 0; i < kPlaces; ++i) {
      const Point2 in_base = limits.edge(Angle::radians(i * kFullTurn / kPlaces), beyond);
      if (!is_known(odom_from_place * in_base, now)) places.push_back(in_base);
    }
  }
  return places;
}

}  // namespace docent
