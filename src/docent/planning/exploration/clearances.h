#pragma once

#include <array>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::planning {

/// Free distance all round the robot, every 2 degrees from -180, of sweeps that were taken where it was a moment ago.
class Clearances {
 public:
  static constexpr std::size_t kDirections = 180;

  Clearances() { least_.fill(kUnread); }
  /// What lies between two directions counts for both, so that a base that has turned leaves no gap. A reading that is
  /// no number tells nothing. O(ranges).
  /// @param base_from_sensor  from where the sensor was at the sweep to where the base is now
  /// @param first_bearing, bearing_step  [rad], sensor frame
  /// @param ranges  [m]; max_range or more: free so far at least
  void add(const Pose2& base_from_sensor, double first_bearing, double bearing_step, double max_range,
           std::span<const float> ranges);
  /// Where nothing was read here, what was read there.
  void fill(const Clearances& older);
  /// [kDirections] [m]; 0 where nothing was read.
  [[nodiscard]] std::vector<double> free() const;

 private:
  static constexpr double kUnread = -1.0;
  std::array<double, kDirections> least_{};
};

}  // namespace docent::planning
