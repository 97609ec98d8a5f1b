#pragma once

#include <Eigen/Core>
#include <optional>

#include "docent/geometry/pose2.h"
#include "docent/pictures/image.h"
#include "docent/vision/lens/lens.h"

namespace docent::vision {

/// A colour camera on the robot.
struct FrontCamera {
  Lens lens;
  Eigen::Vector3d position;          ///< [m] base
  Eigen::Matrix3d base_from_camera;  ///< columns: the camera's right, down and axis

  /// Nothing: outside of the lens. The pixel may lie outside of the picture.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector3d& in_base) const {
    const Eigen::Vector3d ray = base_from_camera.transpose() * (in_base - position);
    if (!(ray.z() > 0.0)) return std::nullopt;
    return lens.pixel_of(ray);
  }
};

/// Where a thing stands and how large it is, as the depth camera has measured it.
struct ThingPlace {
  Point2 middle;        ///< [m] base, when the colour picture was taken
  double width = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
};

inline constexpr int kPatchSide = 144;     ///< [pixels], two to a site of features: JPEG halves colours
inline constexpr double kPatchSize = 0.4;  ///< [m]: a pixel is as large on near things as on far ones

/// The thing cut out of a colour picture as wide and as high as the depth camera has measured it, on a pale ground of
/// one colour and always to the same scale, so that shares of the picture are sizes in metres: as one would photograph
/// it on a sheet of paper to teach it with `docent learn-objects`. Nothing: it is not wholly in the picture. O(pixels
/// of the patch). @pre width and height > 0
[[nodiscard]] std::optional<pictures::Image> thing_patch(const pictures::Image& picture, const FrontCamera& camera,
                                                         const ThingPlace& place);

}  // namespace docent::vision
