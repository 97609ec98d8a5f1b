#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "docent/geometry/pose2.h"
#include "docent/vision/lens/lens.h"

namespace docent::vision {

/// A picture's brightness, row after row from the top.
struct GrayPicture {
  int columns = 0;                      ///< [pixels]
  int rows = 0;                         ///< [pixels]
  std::span<const std::uint8_t> bytes;  ///< [rows * columns] 0 .. 255
};

/// Where a camera sits on the robot.
struct CameraMount {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] of the lens; x ahead, y to the left, z above the floor
  Eigen::Matrix3d robot_from_camera = Eigen::Matrix3d::Identity();  ///< takes rays of Lens to the robot's axes
};

/// Looks straight up; the picture's top lies ahead, as with a camera that is laid on its back.
/// @param roll   [rad] about the robot's x axis, then
/// @param pitch  [rad] about its y axis
[[nodiscard]] CameraMount looking_up(const Eigen::Vector3d& position, double roll = 0.0, double pitch = 0.0);

/// A camera that looks at the ceiling: lens and mount.
struct CeilingCamera {
  Lens lens;
  CameraMount mount;

  /// Where the ceiling, `height` [m] above the floor, falls into the picture. @param by_robot  d pixel / d (x, y,
  /// height) of the point as the robot sees it, unless null
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel_of(Point2 in_robot, double height,
                                                        Eigen::Matrix<double, 2, 3>* by_robot = nullptr) const {
    const Eigen::Vector3d ray{in_robot.x - mount.position.x(), in_robot.y - mount.position.y(),
                              height - mount.position.z()};
    PixelByRay by_ray;
    const auto pixel = lens.pixel_of(mount.robot_from_camera.transpose() * ray, by_robot ? &by_ray : nullptr);
    if (pixel && by_robot) *by_robot = by_ray * mount.robot_from_camera.transpose();
    return pixel;
  }
};

}  // namespace docent::vision
