#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "docent/base/random.h"
#include "docent/mapping/graph_mapping/mapping_scan.h"

namespace docent::mapping::testing {

struct Wall {
  Point2 from;
  Point2 to;
};

inline void append_box(std::vector<Wall>& walls, Point2 low, Point2 high) {
  walls.push_back({{low.x, low.y}, {high.x, low.y}});
  walls.push_back({{high.x, low.y}, {high.x, high.y}});
  walls.push_back({{high.x, high.y}, {low.x, high.y}});
  walls.push_back({{low.x, high.y}, {low.x, low.y}});
}

/// A corridor of 3 m about a block of 18 x 12 m, with niches, pillars and cases at drawn places: no two stretches
/// alike.
inline std::vector<Wall> ring_corridor() {
  std::vector<Wall> walls;
  append_box(walls, {0.0, 0.0}, {24.0, 18.0});
  append_box(walls, {3.0, 3.0}, {21.0, 15.0});
  Rng rng{7};
  for (int i = 0; i < 12; ++i) {
    const double along = 1.0 + 20.0 * rng.uniform();
    const double size = 0.2 + 0.5 * rng.uniform();
    append_box(walls, {along, 0.0}, {along + size, 0.3 + 0.3 * rng.uniform()});
    append_box(walls, {along * 0.9, 18.0 - size}, {along * 0.9 + 0.4, 18.0});
    append_box(walls, {0.0, along * 0.7}, {0.3 * size + 0.2, along * 0.7 + size});
    append_box(walls, {24.0 - size, along * 0.75}, {24.0, along * 0.75 + 0.3});
  }
  return walls;
}

inline double range_to(const std::vector<Wall>& walls, Point2 from, Point2 along) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) {
    const Point2 side = wall.to - wall.from;
    const double across = cross(along, side);
    if (std::abs(across) < 1e-12) continue;
    const double range = cross(wall.from - from, side) / across;
    const double share = cross(wall.from - from, along) / across;
    if (range > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, range);
  }
  return nearest;
}

/// What a laser of 180 beams about the robot's heading sees, with a centimetre of noise.
inline std::vector<SurfacePoint> scan_of(const std::vector<Wall>& walls, const Pose2& pose, Rng& rng) {
  sensor_models::RangeSweep sweep;
  for (int i = -90; i <= 90; ++i) {
    const Angle bearing = Angle::degrees(i);
    const double range = range_to(walls, pose.position(), unit(pose.theta + bearing)) + rng.normal(0.0, 0.01);
    sweep.beams.push_back({bearing.radians(), range, false});
  }
  return surface_points(sweep, {});
}

struct Drive {
  std::vector<MappingScan> scans;
  std::vector<Pose2> truth;
};

/// `rounds` times about the ring, a scan every 0.4 m; odometry with so much veer [rad/m] and noise of each step.
inline Drive drive_round(double rounds, double veer, double noise, std::uint64_t seed) {
  const std::vector<Wall> walls = ring_corridor();
  constexpr Point2 kCorners[] = {{1.5, 1.5}, {22.5, 1.5}, {22.5, 16.5}, {1.5, 16.5}};
  Rng rng{seed};
  Drive drive;
  Pose2 odometry;
  std::size_t corner = 0;
  Point2 at = kCorners[0];
  double heading = 0.0;
  for (double way = 0.0; way < rounds * 72.0; way += 0.4) {
    const Point2 target = kCorners[(corner + 1) % 4];
    if (distance(at, target) < 0.6) ++corner;
    const double wanted = direction(at, kCorners[(corner + 1) % 4]).radians();
    heading += std::clamp(Angle::radians(wanted - heading).radians(), -0.5, 0.5);
    const Pose2 before = drive.truth.empty() ? Pose2{at.x, at.y, Angle::radians(heading)} : drive.truth.back();
    if (!drive.truth.empty()) at = at + 0.4 * unit(Angle::radians(heading));
    const Pose2 now{at.x, at.y, Angle::radians(heading)};
    Pose2 step = inverse(before) * now;
    const double length = norm(step.position());
    step.x *= 1.0 + rng.normal(0.0, noise);
    step.theta = step.theta + Angle::radians(veer * length + rng.normal(0.0, noise * 0.3));
    odometry = odometry * step;
    drive.truth.push_back(now);
    drive.scans.push_back({odometry, scan_of(walls, now, rng), {{0.0, 0.0}}});
  }
  return drive;
}

/// From scan `first` to before `end` nothing is near but one person, who walks along at the robot's side.
inline void walk_along(Drive& drive, std::size_t first, std::size_t end) {
  std::vector<SurfacePoint> person;
  for (int i = 0; i < 40; ++i) {
    const Angle round = Angle::degrees(180.0 + 4.5 * i);
    person.push_back({Point2{0.4, 1.2} + 0.2 * unit(round), unit(round)});
  }
  for (std::size_t i = first; i < end; ++i) drive.scans[i].points = person;
}

/// [m], mean over pairs `apart` scans from each other: how wrongly they lie to each other.
inline double relation_error(const std::vector<Pose2>& truth, const std::vector<Pose2>& found, std::size_t apart) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i + apart < truth.size(); ++i, ++count) {
    const Pose2 true_step = inverse(truth[i]) * truth[i + apart];
    const Pose2 found_step = inverse(found[i]) * found[i + apart];
    sum += norm((inverse(true_step) * found_step).position());
  }
  return sum / static_cast<double>(std::max<std::size_t>(count, 1));
}

}  // namespace docent::mapping::testing
