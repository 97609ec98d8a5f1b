#pragma once

#include <Eigen/Core>

#include "docent/base/random.h"
#include "docent/vision/depth/depth_camera.h"

namespace docent::vision {

struct GroundPlaneParams {
  double tilt = 3.0;         ///< [deg] 0..10 that the floor may lie off what the mount's calibration says
  double offset = 0.04;      ///< [m] > 0, likewise: of its height below the base
  double within = 0.02;      ///< [m] > 0 that a point of the floor lies off the plane, beside the camera's noise
  double reach = 4.0;        ///< [m] > 0 along the axis: farther points say little
  int step = 4;              ///< [pixels] >= 1 from a point that is looked at to the next, both ways
  int trials = 60;           ///< >= 1 of three points each
  int judges = 400;          ///< >= 1 points that a trial's plane is judged by
  double least_share = 0.1;  ///< 0..1 of the points looked at that must lie on the plane
  [[nodiscard]] Result<void> validate() const;
};

/// The floor as a picture shows it: a point of the base frame is `normal` · point + `offset` above it.
struct GroundPlane {
  Eigen::Vector3d normal{0.0, 0.0, 1.0};  ///< of length 1, base frame
  double offset = 0.0;                    ///< [m]
  bool is_seen = false;                   ///< else it is where the calibration says
  double share = 0.0;                     ///< of the points looked at that lie on it
};

/// The plane that most points of the picture lie on, of all that the calibration allows: RANSAC
/// within `tilt` and `offset`, then least squares over what lies on it. A table's top is no floor, however large.
/// Deterministic for a seed. O(pixels / step² + trials * judges).
[[nodiscard]] GroundPlane find_ground_plane(const DepthPicture& picture, const DepthPoints& points,
                                            const GroundPlaneParams& params, Rng& rng);

}  // namespace docent::vision
