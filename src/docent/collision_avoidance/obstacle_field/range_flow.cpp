#include "docent/collision_avoidance/obstacle_field/range_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"

namespace docent::collision_avoidance {

namespace {

constexpr double kSurely = 1.0 + 1e-9;  // more than rounding may do

}  // namespace

void RangeFlow::add(Time stamp, const Pose2& odom_from_sensor, double first_bearing, double bearing_step,
                    std::span<const float> ranges, std::span<const Point2> places, std::span<const int> beams) {
  // A clock that stands still or was set back tells of no motion.
  if (!looks_.empty() && stamp <= looks_.back().stamp) looks_.clear();
  looks_.push_back({stamp,
                    odom_from_sensor,
                    first_bearing,
                    bearing_step,
                    {ranges.begin(), ranges.end()},
                    {places.begin(), places.end()},
                    {beams.begin(), beams.end()}});
  // One that is old enough is kept, the youngest of these.
  while (looks_.size() > 1 && stamp - looks_[1].stamp >= seconds(params_.look_back)) looks_.pop_front();
}

std::optional<Point2> RangeFlow::approach(const Look& before, const PointTransform& before_from_odom, const Look& now,
                                          Point2 place) const {
  const Point2 seen = before_from_odom * place;
  const double range = norm(seen);
  const auto beam = static_cast<int>(beam_to(seen, before.first_bearing, before.bearing_step));
  const auto count = static_cast<int>(before.ranges.size());
  for (int i = beam - 1; i <= beam + 1; ++i) {
    if (i < 0 || i >= count) return std::nullopt;
    if (!(before.ranges[static_cast<std::size_t>(i)] > range + params_.clear)) return std::nullopt;
  }
  const double dt = to_seconds(now.stamp - before.stamp);
  const double most = params_.most_speed * dt;
  // What lies farther aside, by the tangent, lies farther off than `most`.
  const double aside = range > most ? most / std::sqrt(range * range - most * most) : params_.window;
  const int width = static_cast<int>(std::min(params_.window, aside + 2.0 * before.bearing_step) / before.bearing_step);
  const auto first = std::lower_bound(before.beams.begin(), before.beams.end(), beam - width);
  const Point2* nearest = nullptr;
  double least = most;
  for (auto i = static_cast<std::size_t>(first - before.beams.begin());
       i < before.beams.size() && before.beams[i] <= beam + width; ++i) {
    const Point2 off = place - before.places[i];
    if (dot(off, off) > kSurely * least * least) continue;  // most: no root is needed for them
    const double away = norm(off);
    if (away >= least) continue;
    least = away;
    nearest = &before.places[i];
  }
  const auto towards_sensor = [&] {
    return unit(Angle::radians(std::atan2(place.y - before.odom_from_sensor.y, place.x - before.odom_from_sensor.x) +
                               std::numbers::pi));
  };
  const Point2 way = nearest != nullptr ? place - *nearest : most * towards_sensor();
  const Point2 velocity = (1.0 / dt) * way;
  if (norm(velocity) < params_.least_speed || dot(velocity, place - now.odom_from_sensor.position()) >= 0.0)
    return std::nullopt;
  return velocity;
}

Point2 RangeFlow::motion(std::span<const Point2> along_normals) const {
  // Least squares of n (n.v - s) over the normals n and speeds s; where these all point one way, v does so, too.
  const double stiff = params_.stiff * static_cast<double>(along_normals.size());
  double xx = stiff;
  double xy = 0.0;
  double yy = stiff;
  Point2 sum{};
  for (const Point2 flow : along_normals) {
    const double speed = norm(flow);
    const Point2 normal = (1.0 / speed) * flow;
    xx += normal.x * normal.x;
    xy += normal.x * normal.y;
    yy += normal.y * normal.y;
    sum = sum + flow;
  }
  const double determinant = xx * yy - xy * xy;
  const Point2 velocity{(yy * sum.x - xy * sum.y) / determinant, (xx * sum.y - xy * sum.x) / determinant};
  const double speed = norm(velocity);
  return speed > params_.most_speed ? (params_.most_speed / speed) * velocity : velocity;
}

std::vector<Point2> RangeFlow::velocities() const {
  if (looks_.empty()) return {};
  const Look& now = looks_.back();
  const Look& before = looks_.front();
  std::vector<Point2> result(now.places.size());
  const Duration age = now.stamp - before.stamp;
  if (age < seconds(params_.look_back) || age > seconds(params_.forget)) return result;
  const PointTransform before_from_odom{inverse(before.odom_from_sensor)};
  std::vector<std::size_t> reached;
  std::vector<Point2> flows;
  for (std::size_t i = 0; i < now.places.size(); ++i) {
    if (const auto flow = approach(before, before_from_odom, now, now.places[i])) {
      reached.push_back(i);
      flows.push_back(*flow);
    }
    if (i + 1 < now.places.size() && distance(now.places[i], now.places[i + 1]) < params_.side_by_side) continue;
    // Here a piece ends. A beam that grazes an edge meets nothing that is there: its neighbours do not bear it out.
    if (reached.size() >= params_.least_places) {
      const Point2 velocity = motion(flows);
      for (const std::size_t k : reached) result[k] = velocity;
    }
    reached.clear();
    flows.clear();
  }
  return result;
}

}  // namespace docent::collision_avoidance
