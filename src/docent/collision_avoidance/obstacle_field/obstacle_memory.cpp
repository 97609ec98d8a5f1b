#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"

namespace docent::collision_avoidance {

namespace {

bool is_valid(double range) { return !std::isnan(range) && range >= 0.0; }

}  // namespace

void ObstacleMemory::watch_for_freeze(Sensor& sensor, const SensorSweep& sweep, const Pose2& odom_from_base) const {
  const auto equal = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  const auto& last = sensor.sweep.ranges;
  const bool same =
      last.size() == sweep.ranges.size() && std::equal(last.begin(), last.end(), sweep.ranges.begin(), equal);
  const auto hits = std::count_if(sweep.ranges.begin(), sweep.ranges.end(),
                                  [&](float range) { return is_valid(range) && range < sweep.max_range; });
  if (!same || hits < params_.frozen_hits) {
    sensor.repeats = 0;
    sensor.frozen = false;
    sensor.odom_from_base_at_change = odom_from_base;
    return;
  }
  ++sensor.repeats;
  const Pose2 moved = inverse(sensor.odom_from_base_at_change) * odom_from_base;
  const bool has_moved =
      norm(moved.position()) > params_.frozen_way || std::abs(moved.theta.radians()) > params_.frozen_turn;
  if (sensor.repeats >= params_.frozen_sweeps && hits * sensor.repeats >= params_.frozen_readings && has_moved)
    sensor.frozen = true;
}

std::vector<bool> ObstacleMemory::confirm(std::span<const Point2> points, std::span<const int> beams,
                                          std::span<const ObstaclePoint> before) const {
  std::vector<bool> confirmed(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = i + 1; k < points.size() && beams[k] - beams[i] <= 2; ++k) {
      if (distance(points[i], points[k]) < params_.neighbour) confirmed[i] = confirmed[k] = true;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    confirmed[i] = confirmed[i] || std::any_of(before.begin(), before.end(), [&](const ObstaclePoint& point) {
                     return distance(point.in_odom, points[i]) < params_.again;
                   });
  }
  return confirmed;
}

ObstacleMemory::View ObstacleMemory::view_of(const Sensor& sensor, const PointTransform& sensor_from_odom,
                                             Point2 in_odom) const {
  const Point2 in_sensor = sensor_from_odom * in_odom;
  const auto& sweep = sensor.sweep;
  const long beam = beam_to(in_sensor, sweep.first_bearing, sweep.bearing_step);
  if (beam < 0 || beam >= static_cast<long>(sweep.ranges.size())) return View::hidden;
  const double range = sweep.ranges[static_cast<std::size_t>(beam)];
  const double beyond = range - norm(in_sensor);
  if (!is_valid(range) || beyond <= -params_.same) return View::hidden;
  return beyond < params_.same ? View::met_again : View::looked_through;
}

ObstacleMemory::Readings ObstacleMemory::read(Sensor& sensor) const {
  const SensorSweep& sweep = sensor.sweep;
  const PointTransform odom_from_sensor{sensor.odom_from_sensor};
  Readings met;
  met.places.reserve(sweep.ranges.size());
  met.ranges.reserve(sweep.ranges.size());
  met.beams.reserve(sweep.ranges.size());
  std::size_t invalid = 0;
  std::size_t run = 0;  // beams without a reading in a row
  sensor.blind.clear();
  const auto end_run = [&](std::size_t end) {
    if (static_cast<double>(run) * sweep.bearing_step > params_.blind_gap) {
      for (std::size_t k = end - run; k < end; ++k) {
        if (is_own_body(sweep, k)) continue;  // as if it were out of the field: SeenPlaces knows what lies there
        const double bearing = sweep.first_bearing + static_cast<double>(k) * sweep.bearing_step;
        sensor.blind.push_back((sweep.base_from_sensor.theta + Angle::radians(bearing)).radians());
      }
    }
    run = 0;
  };
  const auto& directions = sensor.directions.of(sweep.first_bearing, sweep.bearing_step, sweep.ranges.size());
  for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
    const double range = sweep.ranges[i];
    if (!is_valid(range) || range < sweep.min_range) {  // covered, or the sensor's way to say "failed"
      if (!is_own_body(sweep, i)) ++invalid;
      ++run;
      continue;
    }
    end_run(i);
    if (range >= sweep.max_range || range > params_.reach) continue;
    met.places.push_back(odom_from_sensor * (range * directions[i]));
    met.ranges.push_back(range);
    met.beams.push_back(static_cast<int>(i));
  }
  end_run(sweep.ranges.size());
  sensor.invalid_share =
      sweep.ranges.empty() ? 1.0 : static_cast<double>(invalid) / static_cast<double>(sweep.ranges.size());
  return met;
}

std::vector<ObstaclePoint> ObstacleMemory::keep_confirmed(Sensor& sensor, Readings& readings,
                                                          std::span<const ObstaclePoint> before) const {
  auto& [places, ranges, beams] = readings;
  const Time stamp = sensor.sweep.stamp;
  const std::vector<bool> confirmed = confirm(places, beams, before);
  std::vector<ObstaclePoint> lone;
  sensor.points.reserve(places.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!confirmed[i]) {
      lone.push_back({.in_odom = places[i], .seen = stamp, .confirmed = false});
      continue;
    }
    sensor.points.push_back({places[i], {}, stamp, false});
    places[kept] = places[i];
    ranges[kept] = ranges[i];
    beams[kept++] = beams[i];
  }
  places.resize(kept);
  ranges.resize(kept);
  beams.resize(kept);
  return lone;
}

void ObstacleMemory::mark_what_moves(Sensor& sensor, const Readings& readings) {
  const SensorSweep& sweep = sensor.sweep;
  auto clusters = moving_.find(readings.places, readings.ranges, readings.beams, sweep.bearing_step);
  moving_.follow(sweep.stamp, clusters);
  for (const auto& cluster : clusters) {
    for (std::size_t k = cluster.first; k < cluster.first + cluster.count; ++k) {
      sensor.points[k].person = true;
      sensor.points[k].velocity = cluster.velocity;
    }
  }
  const std::vector<bool> straight =
      on_straight_pieces(readings.places, readings.ranges, sweep.bearing_step, params_.straight);
  for (std::size_t i = 0; i < readings.places.size(); ++i) sensor.points[i].straight = straight[i];
  let_come_nearer(sensor, readings);
}

void ObstacleMemory::revise_remembered(Sensor& sensor) const {
  const PointTransform sensor_from_odom{inverse(sensor.odom_from_sensor)};
  std::erase_if(sensor.remembered, [&](ObstaclePoint& point) {
    if (sensor.sweep.stamp - point.seen > seconds(params_.memory)) return true;
    const View view = view_of(sensor, sensor_from_odom, point.in_odom);
    if (view == View::met_again) return true;  // the new point stands for it
    if (view == View::hidden) return false;
    return point.velocity != Point2{} || ++point.missed >= params_.sweeps;
  });
}

void ObstacleMemory::add_sweep(std::size_t index, const SensorSweep& sweep, const Pose2& odom_from_base) {
  while (sensors_.size() <= index) sensors_.emplace_back().flow = RangeFlow{params_.flow};
  Sensor& sensor = sensors_[index];
  watch_for_freeze(sensor, sweep, odom_from_base);
  const std::vector<ObstaclePoint> before = std::exchange(sensor.points, {});
  std::copy_if(before.begin(), before.end(), std::back_inserter(sensor.remembered),
               [](const ObstaclePoint& point) { return point.confirmed; });
  sensor.sweep = sweep;
  sensor.odom_from_sensor = odom_from_base * sweep.base_from_sensor;
  Readings readings = read(sensor);
  const std::vector<ObstaclePoint> lone = keep_confirmed(sensor, readings, before);
  mark_what_moves(sensor, readings);
  sensor.points.insert(sensor.points.end(), lone.begin(), lone.end());
  revise_remembered(sensor);
}

void ObstacleMemory::let_come_nearer(Sensor& sensor, const Readings& readings) const {
  const std::vector<Point2>& places = readings.places;
  const SensorSweep& sweep = sensor.sweep;
  sensor.flow.add(sweep.stamp, sensor.odom_from_sensor, sweep.first_bearing, sweep.bearing_step, sweep.ranges, places,
                  readings.beams);
  const std::vector<Point2> nearer = sensor.flow.velocities();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (nearer[i] == Point2{}) continue;
    const Point2 to_sensor = sensor.odom_from_sensor.position() - places[i];
    const Point2 known = sensor.points[i].velocity;
    if (known != Point2{} && dot(nearer[i] - known, to_sensor) < params_.more_than_known * norm(to_sensor)) continue;
    sensor.points[i].velocity = nearer[i];
    sensor.points[i].person = true;
  }
}

void ObstacleMemory::add_sonar(std::size_t index, const SonarReading& reading, const Pose2& odom_from_base) {
  add_echo(sonars_, params_.sonar_reach, index, reading, odom_from_base);
}

void ObstacleMemory::add_infrared(std::size_t index, const SonarReading& reading, const Pose2& odom_from_base) {
  add_echo(infrareds_, params_.infrared_reach, index, reading, odom_from_base);
}

void ObstacleMemory::add_echo(Ring& ring, double reach, std::size_t index, const SonarReading& reading,
                              const Pose2& odom_from_base) {
  if (ring.last.size() <= index) ring.last.resize(index + 1);
  Echo& last = ring.last[index];
  const Pose2 odom_from_sensor = odom_from_base * reading.base_from_sensor;
  Echo echo{odom_from_sensor * Point2{reading.range, 0.0}, reading.stamp, false};
  echo.valid = is_valid(reading.range) && reading.range < std::min(reading.max_range, reach);
  const bool confirmed = echo.valid && last.valid && reading.stamp - last.stamp < seconds(params_.echo_time) &&
                         distance(echo.in_odom, last.in_odom) < params_.echo_again;
  last = echo;
  while (!ring.points.empty() && reading.stamp - ring.points.front().seen > seconds(params_.memory))
    ring.points.pop_front();
  if (!confirmed) return;
  const double half = 0.5 * reading.field_of_view;
  const double cone = std::max(half, params_.least_cone);
  const PointTransform sonar_from_odom{inverse(odom_from_sensor)};
  for (const auto& sensor : sensors_) {
    for (const auto& point : sensor.points) {
      const Point2 in_sonar = sonar_from_odom * point.in_odom;
      if (in_sonar.x <= 0.0) continue;
      // Half a cone more to each side, and nearer than the echo: it is what the sonar heard.
      if (norm(in_sonar) < reading.range + params_.explained &&
          std::abs(std::atan2(in_sonar.y, in_sonar.x)) < params_.explained_cones * cone)
        return;
    }
  }
  for (const double share : {-0.5, 0.0, 0.5}) {
    const Angle bearing = Angle::radians(share * half);
    ring.points.push_back(
        {.in_odom = odom_from_sensor * (reading.range * unit(bearing)), .seen = reading.stamp, .low = true});
  }
}

void ObstacleMemory::add_lines(const std::string& source, Time stamp, double lifetime, std::span<const Segment> in_base,
                               const Pose2& odom_from_base) {
  CameraView& view = cameras_[source];
  view.points.clear();
  view.until = stamp + seconds(std::clamp(lifetime, 0.0, params_.longest_life));
  for (const Segment& line : in_base) {
    const double length = std::min(distance(line.a, line.b), params_.longest_line);
    const int steps = 1 + static_cast<int>(length / params_.line_step);
    for (int i = 0; i <= steps; ++i) {
      const Point2 at = line.a + (static_cast<double>(i) / steps) * (line.b - line.a);
      view.points.push_back({odom_from_base * at, {}, stamp, false});
    }
  }
}

TouchedBy ObstacleMemory::add_touch(Time stamp, Point2 in_base, const Pose2& odom_from_base) {
  const Point2 in_odom = odom_from_base * in_base;
  bool is_seen = false;
  bool is_somebody = false;
  for (const Sensor& sensor : sensors_) {
    for (const ObstaclePoint& point : sensor.points) {
      const double away = distance(point.in_odom, in_odom);
      is_seen = is_seen || away < params_.touched;
      is_somebody = is_somebody || (away < params_.by_somebody && !point.straight);
    }
  }
  const double memory = is_seen ? params_.seen_touch : is_somebody ? params_.memory : params_.touch_memory;
  const bool low = !is_seen && !is_somebody;
  // A touch that lasts says the same again.
  std::erase_if(touches_, [&](const Touch& touch) {
    return stamp > touch.until ||
           (touch.point.low == low && distance(touch.point.in_odom, in_odom) < params_.same_touch);
  });
  touches_.push_back({{.in_odom = in_odom, .seen = stamp, .low = low}, stamp + seconds(memory)});
  return is_seen ? TouchedBy::seen : is_somebody ? TouchedBy::somebody : TouchedBy::thing;
}

void ObstacleMemory::stand(Point2 in_odom, double radius) {
  std::erase_if(touches_, [&](const Touch& touch) { return distance(touch.point.in_odom, in_odom) < radius; });
}

std::vector<Point2> ObstacleMemory::touched_things(Time now) const {
  std::vector<Point2> result;
  for (const auto& touch : touches_)
    if (touch.point.low && now <= touch.until) result.push_back(touch.point.in_odom);
  return result;
}

std::vector<ObstaclePoint> ObstacleMemory::points(Time now) const {
  std::vector<ObstaclePoint> result;
  std::size_t of_lasers = 0;
  for (const auto& sensor : sensors_) of_lasers += sensor.points.size() + sensor.remembered.size();
  result.reserve(of_lasers);
  const auto add = [&](const auto& points) {
    for (ObstaclePoint point : points) {
      const double age = to_seconds(now - point.seen);
      if (age > params_.memory || !point.confirmed) continue;
      if (point.velocity.x != 0.0 || point.velocity.y != 0.0) {
        point.in_odom = point.in_odom + std::min(age, params_.foreseen) * point.velocity;
      }
      result.push_back(point);
    }
  };
  for (const auto& sensor : sensors_) {
    add(sensor.points);
    add(sensor.remembered);
  }
  add(sonars_.points);
  add(infrareds_.points);
  for (const auto& touch : touches_) {
    if (now <= touch.until) result.push_back(touch.point);
  }
  for (const auto& [source, view] : cameras_) {
    if (now < view.until) result.insert(result.end(), view.points.begin(), view.points.end());
  }
  return result;
}

std::vector<double> ObstacleMemory::blind_directions() const {
  std::vector<double> result;
  for (const auto& sensor : sensors_) result.insert(result.end(), sensor.blind.begin(), sensor.blind.end());
  return result;
}

bool ObstacleMemory::is_frozen(std::size_t sensor) const { return sensor < sensors_.size() && sensors_[sensor].frozen; }

double ObstacleMemory::invalid_share(std::size_t sensor) const {
  return sensor < sensors_.size() ? sensors_[sensor].invalid_share : 1.0;
}

}  // namespace docent::collision_avoidance
