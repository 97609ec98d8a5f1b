#pragma once

#include <optional>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/mapping/scan_matching/point_sweep.h"

namespace docent::mapping {

/// What all lasers of the robot saw at one moment.
struct MappingScan {
  Pose2 odom_from_base;              ///< raw odometry
  std::vector<SurfacePoint> points;  ///< [m], base frame
  std::vector<Point2> sensors;       ///< [m], base frame: where the lasers are
};

/// Which scans of a drive a map is learned from.
struct ScanChoiceParams {
  double way = 0.15;  ///< [m], >= 0: a scan is taken after this way since the last one taken,
  double turn = 8.0;  ///< [deg], >= 0: or this turn
};

/// Chooses scans where the robot has moved.
class ScanChoice {
 public:
  /// @pre both are >= 0
  explicit ScanChoice(const ScanChoiceParams& params) : params_{params} {}
  /// Whether the next scan is taken, by raw odometry; the first one always is. O(1).
  [[nodiscard]] bool takes(const Pose2& odom_from_base);

 private:
  ScanChoiceParams params_;
  std::optional<Pose2> last_;  ///< odom_from_base of the last one taken
};

}  // namespace docent::mapping
