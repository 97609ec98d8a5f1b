#include "docent/vision/depth/depth_camera.h"

#include <cmath>

namespace docent::vision {

Result<void> DepthCamera::validate() const {
  constexpr int kMostSide = 4096;
  if (!(columns >= 16 && rows >= 16 && columns <= kMostSide && rows <= kMostSide))
    return fail("depth camera: columns and rows must be in 16..4096");
  if (!(focal > 0.0)) return fail("depth camera: focal must be > 0");
  if (!std::isfinite(centre_x) || !std::isfinite(centre_y)) return fail("depth camera: centre must be finite");
  if (!(mount.z > 0.0)) return fail("depth camera: mount.z must be > 0");
  return {};
}

Eigen::Matrix3d DepthCamera::base_from_camera() const {
  const double down = mount.down.radians(), roll = mount.roll.radians(), pan = mount.pan.radians();
  const Eigen::Vector3d axis{std::cos(down), 0.0, -std::sin(down)};
  const Eigen::Vector3d level_right{0.0, -1.0, 0.0};
  const Eigen::Vector3d level_down{-std::sin(down), 0.0, -std::cos(down)};
  Eigen::Matrix3d turned;
  turned.col(0) = std::cos(roll) * level_right + std::sin(roll) * level_down;
  turned.col(1) = std::cos(roll) * level_down - std::sin(roll) * level_right;
  turned.col(2) = axis;
  Eigen::Matrix3d panned;
  panned << std::cos(pan), -std::sin(pan), 0.0, std::sin(pan), std::cos(pan), 0.0, 0.0, 0.0, 1.0;
  return panned * turned;
}

Eigen::Vector3d DepthCamera::ray(double column, double row) const {
  return base_from_camera() * Eigen::Vector3d{(column - centre_x) / focal, (row - centre_y) / focal, 1.0};
}

Projector::Projector(const DepthCamera& camera)
    : camera_{camera}, camera_from_base_{camera.base_from_camera().transpose()}, position_{camera.position()} {}

std::optional<PicturePlace> Projector::place_of(const Eigen::Vector3d& in_base) const {
  constexpr double kNearest = 0.05;  // [m]
  const Eigen::Vector3d seen = camera_from_base_ * (in_base - position_);
  if (!(seen.z() > kNearest)) return std::nullopt;
  const double column = camera_.centre_x + camera_.focal * seen.x() / seen.z();
  const double row = camera_.centre_y + camera_.focal * seen.y() / seen.z();
  if (!(column > -0.5 && row > -0.5 && column < camera_.columns - 0.5 && row < camera_.rows - 0.5)) return std::nullopt;
  return PicturePlace{column, row, seen.z()};
}

void DepthPoints::fill(const DepthCamera& camera, const DepthPicture& picture) {
  const std::size_t count = picture.depth.size();
  x.resize(count);
  y.resize(count);
  z.resize(count);
  const Eigen::Vector3f at = camera.position().cast<float>();
  const Eigen::Vector3f step = (camera.base_from_camera().col(0) / camera.focal).cast<float>();
  for (int row = 0; row < picture.rows; ++row) {
    const Eigen::Vector3f first = camera.ray(0.0, row).cast<float>();
    const std::size_t begin = picture.index(0, row);
    for (int column = 0; column < picture.columns; ++column) {
      const std::size_t i = begin + static_cast<std::size_t>(column);
      const float depth = picture.depth[i], right = static_cast<float>(column);
      x[i] = at.x() + depth * (first.x() + right * step.x());
      y[i] = at.y() + depth * (first.y() + right * step.y());
      z[i] = at.z() + depth * (first.z() + right * step.z());
    }
  }
}

}  // namespace docent::vision
