#include "docent/collision_avoidance/obstacle_field/seen_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace docent::collision_avoidance {

namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

}  // namespace

double SeenPlaces::beam_along(const SensorSweep& sweep, double bearing) const {
  double beam = std::fmod(bearing - sweep.first_bearing, kFullTurn) / sweep.bearing_step;
  const double turn = kFullTurn / sweep.bearing_step;
  if (beam < -params_.edge) beam += turn;
  return beam >= turn - params_.edge ? beam - turn : beam;
}

bool SeenPlaces::is_in_field(const SensorSweep& sweep, double beam) const {
  const double last = static_cast<double>(sweep.ranges.size()) - 1.0;
  if (beam < -params_.edge || beam > last + params_.edge) return false;
  return !is_own_body(sweep, static_cast<std::size_t>(std::clamp(std::round(beam), 0.0, last)));
}

void SeenPlaces::forget_slim_posts(SensorSweep& sweep) const {
  const auto end = sweep.own_body.end();
  for (auto from = std::find(sweep.own_body.begin(), end, true); from != end;) {
    const auto to = std::find(from, end, false);
    if (static_cast<double>(to - from) * sweep.bearing_step <= params_.widest_post) std::fill(from, to, false);
    from = std::find(to, end, true);
  }
}

void SeenPlaces::add(std::size_t sensor, SensorSweep sweep, const Pose2& odom_from_base) {
  if (sweep.ranges.empty()) return;
  forget_slim_posts(sweep);
  if (looks_.size() <= sensor) looks_.resize(sensor + 1);
  auto& looks = looks_[sensor];
  const bool is_as_before = !looks.empty() && looks.back().sweep.ranges.size() == sweep.ranges.size() &&
                            looks.back().sweep.first_bearing == sweep.first_bearing &&
                            looks.back().sweep.own_body == sweep.own_body &&
                            looks.back().sweep.bearing_step == sweep.bearing_step;
  const std::size_t count = looks.size();
  if (all_round_ && count > 0) {
    looks.clear();
  } else if (count > 1 && looks.back().sweep.stamp - looks[count - 2].sweep.stamp < seconds(params_.between_looks)) {
    looks.pop_back();
  }
  while (!looks.empty() && sweep.stamp - looks.front().sweep.stamp > seconds(params_.seen_for)) looks.pop_front();
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

SeenPlaces::View SeenPlaces::view_of(const Look& look, Point2 in_odom) const {
  const Point2 in_sensor = look.sensor_from_odom * in_odom;
  const SensorSweep& sweep = look.sweep;
  const double beam = beam_along(sweep, std::atan2(in_sensor.y, in_sensor.x));
  if (!is_in_field(sweep, beam)) return View::out_of_field;
  const auto last = static_cast<double>(sweep.ranges.size() - 1);
  const double range = sweep.ranges[static_cast<std::size_t>(std::clamp(std::round(beam), 0.0, last))];
  return range > norm(in_sensor) + params_.beyond ? View::passed : View::met;
}

bool SeenPlaces::is_known(Point2 in_odom, Time now) const {
  for (const auto& looks : looks_)
    if (!looks.empty() && view_of(looks.back(), in_odom) != View::out_of_field) return true;
  for (const auto& looks : looks_) {
    for (auto look = looks.rbegin(); look != looks.rend() && now - look->sweep.stamp <= seconds(params_.seen_for);
         ++look) {
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
  const Point2 centre = odom_from_base.position();
  const PointTransform base_from_odom{inverse(odom_from_base)};
  const double reach = limits.radius + margin + params_.past_margin;
  for (double x = std::ceil((centre.x - reach) / params_.lattice) * params_.lattice; x <= centre.x + reach;
       x += params_.lattice) {
    for (double y = std::ceil((centre.y - reach) / params_.lattice) * params_.lattice; y <= centre.y + reach;
         y += params_.lattice) {
      const Point2 in_base = base_from_odom * Point2{x, y};
      const double gap = limits.gap_to(in_base);
      const bool is_beside = limits.outline.empty() && in_base.x < 0.5 * norm(in_base);
      if (gap <= (is_beside ? margin + params_.uncovered : 0.0) || gap > margin + params_.past_margin) continue;
      if (!is_known({x, y}, now)) places.push_back(in_base);
    }
  }
}

std::vector<Point2> SeenPlaces::unknown(const Pose2& odom_from_base, const BaseLimits& limits, double margin,
                                        Time now) const {
  std::vector<Point2> places;
  if (all_round_) return places;
  add_beside(places, odom_from_base, limits, margin, now);
  const PointTransform odom_from_place{odom_from_base};
  for (const double beyond : params_.lines) {
    for (int i = 0; i < params_.places; ++i) {
      const Point2 in_base = limits.edge(Angle::radians(i * kFullTurn / params_.places), beyond);
      if (!is_known(odom_from_place * in_base, now)) places.push_back(in_base);
    }
  }
  return places;
}

}  // namespace docent::collision_avoidance
