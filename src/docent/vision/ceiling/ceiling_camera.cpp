#include "docent/vision/ceiling/ceiling_camera.h"

#include <Eigen/Geometry>

namespace docent::vision {

CameraMount looking_up(const Eigen::Vector3d& position, double roll, double pitch) {
  // Laid on its back, its top ahead: what is lower in the picture lies behind, what is right lies to the left, for one
  // looks from below.
  Eigen::Matrix3d robot_from_camera;
  robot_from_camera << 0.0, -1.0, 0.0,  //
      1.0, 0.0, 0.0,                    //
      0.0, 0.0, 1.0;
  const Eigen::Matrix3d tilted =
      (Eigen::AngleAxisd{pitch, Eigen::Vector3d::UnitY()} * Eigen::AngleAxisd{roll, Eigen::Vector3d::UnitX()})
          .toRotationMatrix();
  return {position, tilted * robot_from_camera};
}

}  // namespace docent::vision
