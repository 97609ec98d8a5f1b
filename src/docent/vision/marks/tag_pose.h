#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "docent/vision/marks/tag_finder.h"

namespace docent::vision {

/// A pinhole whose first radial coefficient is known: x (1 + k r²). Camera frame: x to the right, y down, z ahead.
struct TagCamera {
  double focal = 600.0;     ///< [pixels]
  double centre_x = 320.0;  ///< [pixels] as Pixel counts
  double centre_y = 240.0;
  double radial = 0.0;  ///< k, r in units of the focal length

  /// Where a point of the camera frame is seen. @pre z > 0
  [[nodiscard]] Pixel pixel_of(const Eigen::Vector3d& point) const;
  /// Direction of a pixel, z = 1.
  [[nodiscard]] Eigen::Vector3d ray_of(Pixel pixel) const;
};

/// Where a tag may stand. Tag frame: x to the right of who looks at it, y up, z towards them.
struct TagPose {
  Eigen::Matrix3d camera_from_tag = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] of its middle, camera frame
  double error = 0.0;                                  ///< [pixels] root mean square of its corners
};

/// The one or two poses that explain a tag's corners: the first by its homography, the second with the plane mirrored
/// about the line of sight, both refined by least squares over the corners, as Schweighofer and Pinz found (2006). The
/// better one first, which means little where the tag is small or faces the camera: who uses them must know more of its
/// plane.
/// @param side  [m] of the black square, > 0
/// @returns empty: the corners are of no square before the camera
[[nodiscard]] std::vector<TagPose> tag_poses(const SeenTag& tag, const TagCamera& camera, double side);

/// The one whose plane is like a known direction, such as a wall's that is vertical, or a ceiling's. nullopt: none, or
/// both are.
/// @param camera_normal  of length 1: the direction that the tag's y axis (`is_up`) or z axis has, camera frame
/// @param apart  [rad] > 0: by so much one must fit better than the other
[[nodiscard]] std::optional<TagPose> resolved(const std::vector<TagPose>& poses, const Eigen::Vector3d& camera_normal,
                                              bool is_up, double apart);

}  // namespace docent::vision
