#pragma once

#include "docent/geometry/pose2.h"
#include "docent/simulator/sensing/camera/mesh/mesh.h"

namespace docent::simulator {

/// Where a camera is and how it is turned: the axes of its frame in the world.
struct Viewpoint {
  Vec3 eye;                       ///< [m], world
  Vec3 right{0.0F, -1.0F, 0.0F};  ///< of length 1, as the others
  Vec3 down{0.0F, 0.0F, -1.0F};
  Vec3 ahead{1.0F, 0.0F, 0.0F};
  [[nodiscard]] Vec3 to_world(Vec3 in_camera) const {
    return in_camera.x * right + in_camera.y * down + in_camera.z * ahead;
  }
  /// A point of the world in the camera's frame.
  [[nodiscard]] Vec3 to_camera(Vec3 in_world) const {
    const Vec3 off = in_world - eye;
    return {dot(off, right), dot(off, down), dot(off, ahead)};
  }
};

/// How a camera sits on the robot. Base frame: x ahead, y to the left, z up from the floor.
struct CameraMount {
  double x = 0.0, y = 0.0, z = 1.0;  ///< [m]
  double pan = 0.0;                  ///< [rad] to the left
  double tilt = 0.0;                 ///< [rad] upwards; pi/2 looks at the ceiling, its picture's upper edge to the rear
  double roll = 0.0;                 ///< [rad] about its own axis, clockwise as it looks
};

/// How the base leans on an uneven floor, about the middle of its foot.
struct Lean {
  double roll = 0.0;   ///< [rad] about its x axis, to the right
  double pitch = 0.0;  ///< [rad] about its y axis, forwards
};

/// Level but for its tilt. @param pan  [rad] from the world's x axis, to the left; @param tilt  [rad] upwards
[[nodiscard]] Viewpoint viewpoint_at(Vec3 eye, double pan, double tilt);

[[nodiscard]] Viewpoint viewpoint_of(const CameraMount& mount, const Pose2& world_from_base, const Lean& lean = {});

}  // namespace docent::simulator
