#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/geometry/polygon.h"
#include "docent/sensor_models/range_sweep.h"

// For the tests of this folder: a hall with pillars, and a robot that drives about in it.

namespace docent::mapping::testing {

/// A hall of 12 x 9 m with pillars and an alcove.
inline std::vector<Segment> hall() {
  std::vector<Segment> walls;
  const auto add = [&walls](const Polygon& outline) {
    for (const Segment& side : sides(outline)) walls.push_back(side);
  };
  add({{0.0, 0.0}, {12.0, 0.0}, {12.0, 5.0}, {10.5, 5.0}, {10.5, 9.0}, {0.0, 9.0}});
  add({{3.0, 3.0}, {3.5, 3.0}, {3.5, 3.5}, {3.0, 3.5}});
  add({{8.0, 6.0}, {8.6, 6.2}, {8.4, 6.8}});
  add({{6.5, 1.2}, {7.0, 1.2}, {7.0, 1.7}, {6.5, 1.7}});
  return walls;
}

/// What odometry makes of a true drive.
struct OdometryErrors {
  double way = 1.0;      ///< metres counted for each true one
  double turn = 1.0;     ///< likewise of turns
  double noise = 0.005;  ///< [m / sqrt(m)] and [rad / sqrt(rad)]
};

/// Drives to and fro between places of the hall and looks with one scanner.
class TestDrive {
 public:
  TestDrive(Pose2 base_from_sensor, double late, OdometryErrors errors, std::uint64_t seed)
      : mount_{base_from_sensor}, late_{late}, errors_{errors}, rng_{seed} {}

  double field = std::numbers::pi;  ///< [rad] of the scanner
  std::vector<Segment> walls = hall();
  std::function<std::vector<Point2>(double)> people;  ///< [m], world, at a time: discs of 0.25 m

  using OnOdometry = std::function<void(Time, const Pose2&)>;
  using OnScan = std::function<void(Time, const sensor_models::LaserReading&)>;
  /// @param way  [m] after which it ends
  void go(double way, const OnOdometry& on_odometry, const OnScan& on_scan) {
    static const std::vector<Point2> kPlaces{{2.0, 2.0}, {9.5, 2.5}, {9.0, 4.0}, {5.0, 7.5}, {1.5, 6.0}, {5.0, 4.5}};
    std::size_t place = 1;
    double driven = 0.0;
    double linear = 0.0;
    double angular = 0.0;
    for (int tick = 0; driven < way && tick < 200000; ++tick) {
      const double now = 100.0 + 0.01 * tick;
      const Point2 goal = inverse(pose_) * kPlaces[place];
      if (norm(goal) < 0.3) place = (place + 1) % kPlaces.size();
      const double bearing = std::atan2(goal.y, goal.x);
      const double wanted_linear = std::abs(bearing) < 0.4 ? 0.6 : 0.0;
      const double wanted_angular = std::clamp(2.0 * bearing, -1.0, 1.0);
      linear += std::clamp(wanted_linear - linear, -0.01, 0.005);
      angular += std::clamp(wanted_angular - angular, -0.015, 0.015);
      const Pose2 step{0.01 * linear, 0.0, Angle::radians(0.01 * angular)};
      pose_ = pose_ * step;
      driven += step.x;
      const double slip = errors_.noise * std::sqrt(step.x) * rng_.normal();
      const double turned = errors_.noise * std::sqrt(std::abs(0.01 * angular)) * rng_.normal();
      odometry_ =
          odometry_ * Pose2{errors_.way * step.x + slip, 0.0, Angle::radians(errors_.turn * 0.01 * angular + turned)};
      if (tick % 5 == 0) on_odometry(time_from_seconds(now), odometry_);
      if (tick % 10 == 3) scan(now, on_scan);
    }
  }

 private:
  void scan(double now, const OnScan& on_scan) {
    constexpr double kStep = std::numbers::pi / 180.0;
    const auto count = static_cast<std::size_t>(std::lround(field / kStep));
    const double first = -0.5 * (static_cast<double>(count) - 1.0) * kStep;
    const Pose2 world_from_sensor = pose_ * mount_;
    const auto about = people ? people(now) : std::vector<Point2>{};
    std::vector<float> ranges;
    for (std::size_t i = 0; i < count; ++i) {
      const Point2 ray = unit(world_from_sensor.theta + Angle::radians(first + static_cast<double>(i) * kStep));
      double range = 10.0;
      for (const Segment& wall : walls)
        if (const auto hit = ray_distance(world_from_sensor.position(), ray, wall)) range = std::min(range, *hit);
      for (const Point2 person : about)
        if (const auto hit = ray_distance(world_from_sensor.position(), ray, person, 0.25))
          range = std::min(range, *hit);
      ranges.push_back(static_cast<float>(range < 10.0 ? range + rng_.normal(0.0, 0.015) : 10.0));
    }
    on_scan(time_from_seconds(now + late_), {ranges, Angle::radians(first), kStep, 0.05, 10.0});
  }

  Pose2 mount_;
  double late_;
  OdometryErrors errors_;
  Rng rng_;
  Pose2 pose_{2.0, 2.0, {}};
  Pose2 odometry_;
};

}  // namespace docent::mapping::testing
