#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "docent/collision_avoidance/obstacle_field/straight_pieces.h"

namespace docent {

namespace {

constexpr double kBlindGap = 0.105;  // [rad] 6 degrees
constexpr int kFrozenSweeps = 2;     // repeats: noise alone makes even one unlikely
constexpr int kFrozenHits = 3;       // beams that met something: fewer prove nothing
constexpr int kFrozenReadings = 9;   // noisy readings that were all repeated
constexpr double kTouched = 0.15;    // [m] a laser's point so near to a touch is what touches
constexpr double kSeenTouch = 0.3;   // [s] a touch of what a laser sees counts: from then on the laser knows better
constexpr double kBySomebody =
    0.4;  // [m] from a touch: who stood here in the last sweep may have walked into the robot

bool is_valid(double range) { return !std::isnan(range) && range >= 0.0; }

}  // namespace

void ObstacleMemory::watch_for_freeze(Sensor& sensor, const SensorSweep& sweep, const Pose2& odom_from_base) const {
  const auto equal = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  const auto& last = sensor.sweep.ranges;
  const bool same =
      last.size() == sweep.ranges.size() && std::equal(last.begin(), last.end(), sweep.ranges.begin(), equal);
  const auto hits = std::count_if(sweep.ranges.begin(), sweep.ranges.end(),
                                  [&](float range) { return is_valid(range) && range < sweep.max_range; });
  if (!same || hits < kFrozenHits) {
    sensor.repeats = 0;
    sensor.frozen = false;
    sensor.odom_from_base_at_change = odom_from_base;
    return;
  }
  ++sensor.repeats;
  const Pose2 moved = inverse(sensor.odom_from_base_at_change) * odom_from_base;
  const bool has_moved = norm(moved.position()) > 0.015 || std::abs(moved.theta.radians()) > 0.02;
  if (sensor.repeats >= kFrozenSweeps && hits * sensor.repeats >= kFrozenReadings && has_moved) sensor.frozen = true;
}

std::vector<bool> ObstacleMemory::confirm(std::span<const Point2> points, std::span<const int> beams,
                                          std::span<const ObstaclePoint> before) {
  constexpr double kNeighbour = 0.2;  // [m]
  constexpr double kAgain = 0.25;     // [m]
  std::vector<bool> confirmed(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = i + 1; k < points.size() && beams[k] - beams[i] <= 2; ++k) {
      if (distance(points[i], points[k]) < kNeighbour) confirmed[i] = confirmed[k] = true;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    confirmed[i] = confirmed[i] || std::any_of(before.begin(), before.end(), [&](const ObstaclePoint& point) {
                     return distance(point.in_odom, points[i]) < kAgain;
                   });
  }
  return confirmed;
}

ObstacleMemory::View ObstacleMemory::view_of(const Sensor& sensor, const PointTransform& sensor_from_odom,
                                             Point2 in_odom) {
  const Point2 in_sensor = sensor_from_odom * in_odom;
  const auto& sweep = sensor.sweep;
  const double bearing = std::atan2(in_sensor.y, in_sensor.x);
  const double place = Angle::radians(bearing - sweep.first_bearing).radians();
  const double unwrapped = place < -0.5 * sweep.bearing_step ? place + 6.283185307179586 : place;
  const auto beam = std::lround(unwrapped / sweep.bearing_step);
  if (beam < 0 || beam >= static_cast<long>(sweep.ranges.size())) return View::hidden;
  const double range = sweep.ranges[static_cast<std::size_t>(beam)];
  constexpr double kSame = 0.15;  // [m]
  const double beyond = range - norm(in_sensor);
  if (!is_valid(range) || beyond <= -kSame) return View::hidden;
  return beyond < kSame ? View::met_again : View::looked_through;
}

void ObstacleMemory::add_sweep(std::size_t index, const SensorSweep& sweep, const Pose2& odom_from_base) {
  if (sensors_.size() <= index) sensors_.resize(index + 1);
  Sensor& sensor = sensors_[index];
  watch_for_freeze(sensor, sweep, odom_from_base);

  const std::vector<ObstaclePoint> before = std::exchange(sensor.points, {});
  std::copy_if(before.begin(), before.end(), std::back_inserter(sensor.remembered),
               [](const ObstaclePoint& point) { return point.confirmed; });
  sensor.blind.clear();
  sensor.sweep = sweep;
  sensor.odom_from_sensor = odom_from_base * sweep.base_from_sensor;

  const PointTransform odom_from_sensor{sensor.odom_from_sensor};
  std::vector<Point2> places;
  std::vector<double> ranges;
  std::vector<int> beams;
  places.reserve(sweep.ranges.size());
  ranges.reserve(sweep.ranges.size());
  beams.reserve(sweep.ranges.size());
  std::size_t invalid = 0;
  std::size_t run = 0;  // beams without a reading in a row
  const auto end_run = [&](std::size_t end) {
    if (static_cast<double>(run) * sweep.bearing_step > kBlindGap) {
      for (std::size_t k = end - run; k < end; ++k) {
        const double bearing = sweep.first_bearing + static_cast<double>(k) * sweep.bearing_step;
        sensor.blind.push_back((sweep.base_from_sensor.theta + Angle::radians(bearing)).radians());
      }
    }
    run = 0;
  };
  for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
    const double range = sweep.ranges[i];
    if (!is_valid(range) || range < sweep.min_range) {  // covered, or the sensor's way to say "failed"
      ++invalid;
      ++run;
      continue;
    }
    end_run(i);
    if (range >= sweep.max_range || range > kReach) continue;
    const Angle bearing = Angle::radians(sweep.first_bearing + static_cast<double>(i) * sweep.bearing_step);
    places.push_back(odom_from_sensor * (range * unit(bearing)));
    ranges.push_back(range);
    beams.push_back(static_cast<int>(i));
  }
  end_run(sweep.ranges.size());
  sensor.invalid_share =
      sweep.ranges.empty() ? 1.0 : static_cast<double>(invalid) / static_cast<double>(sweep.ranges.size());

  const std::vector<bool> confirmed = confirm(places, beams, before);
  std::vector<ObstaclePoint> lone;
  sensor.points.reserve(places.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!confirmed[i]) {
      lone.push_back({.in_odom = places[i], .seen = sweep.stamp, .confirmed = false});
      continue;
    }
    sensor.points.push_back({places[i], {}, sweep.stamp, false});
    places[kept] = places[i];
    ranges[kept] = ranges[i];
    beams[kept++] = beams[i];
  }
  places.resize(kept);
  ranges.resize(kept);
  beams.resize(kept);
  auto clusters = MovingObjects::find(places, ranges, beams, sweep.bearing_step);
  moving_.follow(sweep.stamp, clusters);
  for (const auto& cluster : clusters) {
    for (std::size_t k = cluster.first; k < cluster.first + cluster.count; ++k) {
      sensor.points[k].person = true;
      sensor.points[k].velocity = cluster.velocity;
    }
  }
  const std::vector<bool> straight = on_straight_pieces(places, ranges, sweep.bearing_step);
  for (std::size_t i = 0; i < places.size(); ++i) sensor.points[i].straight = straight[i];
  let_come_nearer(sensor, places, beams);
  sensor.points.insert(sensor.points.end(), lone.begin(), lone.end());
  const PointTransform sensor_from_odom{inverse(sensor.odom_from_sensor)};
  std::erase_if(sensor.remembered, [&](ObstaclePoint& point) {
    if (sweep.stamp - point.seen > seconds(kMemory)) return true;
    const View view = view_of(sensor, sensor_from_odom, point.in_odom);
    if (view == View::met_again) return true;  // the new point stands for it
    if (view == View::hidden) return false;
    return point.velocity != Point2{} || ++point.missed >= kSweeps;
  });
}

void ObstacleMemory::let_come_nearer(Sensor& sensor, std::span<const Point2> places, std::span<const int> beams) {
  constexpr double kMore = 0.5;  // [m/s] than is known of who is followed: two were taken for one
  const SensorSweep& sweep = sensor.sweep;
  sensor.flow.add(sweep.stamp, sensor.odom_from_sensor, sweep.first_bearing, sweep.bearing_step, sweep.ranges, places,
                  beams);
  const std::vector<Point2> nearer = sensor.flow.velocities();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (nearer[i] == Point2{}) continue;
    const Point2 to_sensor = sensor.odom_from_sensor.position() - places[i];
    const Point2 known = sensor.points[i].velocity;
    if (known != Point2{} && dot(nearer[i] - known, to_sensor) < kMore * norm(to_sensor)) continue;
    sensor.points[i].velocity = nearer[i];
    sensor.points[i].person = true;
  }
}

void ObstacleMemory::add_sonar(std::size_t index, const SonarReading& reading, const Pose2& odom_from_base) {
  add_echo(sonars_, kSonarReach, index, reading, odom_from_base);
}

void ObstacleMemory::add_infrared(std::size_t index, const SonarReading& reading, const Pose2& odom_from_base) {
  add_echo(infrareds_, kInfraredReach, index, reading, odom_from_base);
}

void ObstacleMemory::add_echo(Ring& ring, double reach, std::size_t index, const SonarReading& reading,
                              const Pose2& odom_from_base) {
  if (ring.last.size() <= index) ring.last.resize(index + 1);
  Echo& last = ring.last[index];
  const Pose2 odom_from_sensor = odom_from_base * reading.base_from_sensor;
  Echo echo{odom_from_sensor * Point2{reading.range, 0.0}, reading.stamp, false};
  echo.valid = is_valid(reading.range) && reading.range < std::min(reading.max_range, reach);
  const bool confirmed = echo.valid && last.valid && reading.stamp - last.stamp < seconds(1.0) &&
                         distance(echo.in_odom, last.in_odom) < 0.2;
  last = echo;
  while (!ring.points.empty() && reading.stamp - ring.points.front().seen > seconds(kMemory)) ring.points.pop_front();
  if (!confirmed) return;
  const double half = 0.5 * reading.field_of_view;
  constexpr double kLeastCone = 0.13;  // [rad] a ring's places and axes are known no better
  const double cone = std::max(half, kLeastCone);
  const PointTransform sonar_from_odom{inverse(odom_from_sensor)};
  for (const auto& sensor : sensors_) {
    for (const auto& point : sensor.points) {
      const Point2 in_sonar = sonar_from_odom * point.in_odom;
      if (in_sonar.x <= 0.0) continue;
      // Half a cone more to each side, and nearer than the echo: it is what the sonar heard.
      if (norm(in_sonar) < reading.range + 0.25 && std::abs(std::atan2(in_sonar.y, in_sonar.x)) < 2.0 * cone) return;
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
  constexpr double kLongest = 20.0;  // [m]
  CameraView& view = cameras_[source];
  view.points.clear();
  view.until = stamp + seconds(std::clamp(lifetime, 0.0, kLongestLife));
  for (const Segment& line : in_base) {
    const double length = std::min(distance(line.a, line.b), kLongest);
    const int steps = 1 + static_cast<int>(length / kLineStep);
    for (int i = 0; i <= steps; ++i) {
      const Point2 at = line.a + (static_cast<double>(i) / steps) * (line.b - line.a);
      view.points.push_back({odom_from_base * at, {}, stamp, false});
    }
  }
}

void ObstacleMemory::add_touch(Time stamp, Point2 in_base, const Pose2& odom_from_base) {
  const Point2 in_odom = odom_from_base * in_base;
  bool is_seen = false;
  bool is_somebody = false;
  for (const Sensor& sensor : sensors_) {
    for (const ObstaclePoint& point : sensor.points) {
      const double away = distance(point.in_odom, in_odom);
      is_seen = is_seen || away < kTouched;
      is_somebody = is_somebody || (away < kBySomebody && !point.straight);
    }
  }
  const double memory = is_seen ? kSeenTouch : is_somebody ? kMemory : kTouchMemory;
  const bool low = !is_seen && !is_somebody;
  // Who goes on touching says the same again.
  std::erase_if(touches_, [&](const Touch& touch) {
    return stamp > touch.until || (touch.point.low == low && distance(touch.point.in_odom, in_odom) < 0.01);
  });
  touches_.push_back({{.in_odom = in_odom, .seen = stamp, .low = low}, stamp + seconds(memory)});
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
      if (age > kMemory || !point.confirmed) continue;
      if (point.velocity.x != 0.0 || point.velocity.y != 0.0) {
        point.in_odom = point.in_odom + std::min(age, 0.5) * point.velocity;
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

}  // namespace docent
