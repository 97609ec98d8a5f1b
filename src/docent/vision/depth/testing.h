#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "docent/base/random.h"
#include "docent/vision/depth/depth_camera.h"

// A room of boxes for tests, and what a depth camera would measure in it.

namespace docent::vision::made_up_room {

/// A box, base frame at the start.
struct Box {
  Eigen::Vector3d low, high;  ///< [m]
};

/// @returns [m] along the unit-free ray to the box; infinity: missed
inline double ray_to_box(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& ray) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double a = (box.low[k] - from[k]) / ray[k], b = (box.high[k] - from[k]) / ray[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter > 0.0 && enter < leave ? enter : std::numeric_limits<double>::infinity();
}

struct Scene {
  std::vector<Box> boxes{};
  double floor_until =
      std::numeric_limits<double>::infinity();  ///< [m] x where it ends; behind it lies one 0.6 m deeper
  double shake = 0.0;                           ///< [deg] that the camera looks lower than it knows
  double noise = 1.0;                           ///< times depth_noise
};

/// What the camera measures from `x` metres ahead of the start.
inline DepthPicture picture_of(const Scene& scene, DepthCamera camera, double x, Rng& rng) {
  camera.mount.down = camera.mount.down + Angle::degrees(scene.shake);
  DepthPicture picture{camera.columns, camera.rows, {}};
  const Eigen::Vector3d from = camera.position() + Eigen::Vector3d{x, 0.0, 0.0};
  const Eigen::Matrix3d turn = camera.base_from_camera();
  for (int row = 0; row < camera.rows; ++row) {
    for (int column = 0; column < camera.columns; ++column) {
      const Eigen::Vector3d ray = turn * Eigen::Vector3d{(column - camera.centre_x) / camera.focal,
                                                         (row - camera.centre_y) / camera.focal, 1.0};
      double depth = ray.z() < 0.0 ? -from.z() / ray.z() : std::numeric_limits<double>::infinity();
      if (from.x() + depth * ray.x() > scene.floor_until) depth = (-0.6 - from.z()) / ray.z();
      for (const Box& box : scene.boxes) depth = std::min(depth, ray_to_box(box, from, ray));
      constexpr double kFarthest = 8.0;  // [m]
      const bool answers = depth > 0.3 && depth < kFarthest;
      const double noise = scene.noise * static_cast<double>(depth_noise(static_cast<float>(depth)));
      picture.depth.push_back(answers ? static_cast<float>(depth + noise * rng.normal()) : 0.0F);
    }
  }
  return picture;
}

/// One metre up, 35 degrees down, as a guide robot may carry it.
inline DepthCamera front_camera() {
  DepthCamera camera;
  camera.mount = {0.2, 0.0, 1.0, {}, Angle::degrees(35.0), {}};
  return camera;
}

}  // namespace docent::vision::made_up_room
