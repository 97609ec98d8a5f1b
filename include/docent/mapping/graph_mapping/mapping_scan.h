#pragma once

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

}  // namespace docent::mapping
