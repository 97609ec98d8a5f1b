#pragma once

#include <optional>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// Virtual measurements, base frame at their stamp: a turn of those of hazards, from `first_bearing` on, then where
/// there is more another turn, of those of the area's border.
struct VirtualSweep {
  Time stamp;
  double first_bearing = 0.0;
  double bearing_step = 0.0;
  double max_range = 0.0;
  std::vector<float> ranges;
};

struct VirtualObstaclesParams {
  double hazard_margin = 0.15;  ///< [m] as DynamicWindowParams::virtual_margin
  double border_margin = 0.07;  ///< [m] as DynamicWindowParams::border_margin
  double least_range = 0.02;    ///< [m] nearer is taken for so much: a zero would lie in no direction at all
};

/// Hazards and the area's border as the newest virtual measurements have them, kept in the odometry's frame.
class VirtualObstacles {
 public:
  explicit VirtualObstacles(const VirtualObstaclesParams& params = {}) : params_{params} {}

  /// @param odom_from_base  at the sweep's stamp
  void take(VirtualSweep sweep, const Pose2& odom_from_base);
  /// Of the newest measurements.
  [[nodiscard]] std::optional<Time> stamp() const { return stamp_; }
  /// Adds those nearer than `reach` [m]. O(ranges).
  void add_to(std::vector<Obstacle>& obstacles, const Pose2& base_from_odom, double reach) const;

 private:
  VirtualObstaclesParams params_;
  std::optional<Time> stamp_;
  VirtualSweep sweep_;
  std::vector<Point2> places_;  ///< [ranges] base frame at its stamp, of those that are less than the greatest
  Pose2 odom_from_sweep_;
};

}  // namespace docent::collision_avoidance
