#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"
#include "docent/collision_avoidance/plausibility/ring_check.h"

namespace docent::collision_avoidance {

/// A ring of sonars that hears the nearest thing in each cone. For tests.
struct RingForTest {
  static constexpr int kSensors = 24;
  static constexpr double kField = 0.26;  // [rad]
  static constexpr double kReach = 5.0;   // [m]
  RingEchoes echoes;

  /// All of them at once. @param odom_from_base  where the ring truly is @param said  where odometry has it
  void hear(double time, const RoomForTest& room, const Pose2& odom_from_base, const Pose2& said) {
    for (int i = 0; i < kSensors; ++i) {
      const Angle bearing = Angle::radians(2.0 * std::numbers::pi * i / kSensors);
      const Pose2 base_from_sensor{0.25 * unit(bearing).x, 0.25 * unit(bearing).y, bearing};
      const double range = range_of(room, odom_from_base * base_from_sensor);
      echoes.hear(0, static_cast<std::size_t>(i), {time_from_seconds(time), base_from_sensor, kField, kReach, range},
                  said);
    }
  }

 private:
  static double range_of(const RoomForTest& room, const Pose2& odom_from_sensor) {
    double range = kReach;
    for (int ray = -3; ray <= 3; ++ray) {
      const Point2 along = unit(odom_from_sensor.theta + Angle::radians(ray / 6.0 * kField));
      for (const Segment& wall : room.walls)
        if (const auto hit = ray_distance(odom_from_sensor.position(), along, wall)) range = std::min(range, *hit);
      for (const RoomForTest::Disc& disc : room.discs)
        if (const auto hit = ray_distance(odom_from_sensor.position(), along, disc.centre, disc.radius))
          range = std::min(range, *hit);
    }
    return range;
  }
};

}  // namespace docent::collision_avoidance
