#pragma once

#include <vector>

#include "docent/simulator/sensing/camera/optics/lens_model.h"

namespace docent::simulator {

/// The rays of a lens at all corners of its pixels, worked out once.
class RayTable {
 public:
  explicit RayTable(const LensModel& lens);
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// [rad] across a pixel in the middle of the picture.
  [[nodiscard]] float pixel_angle() const { return pixel_angle_; }
  /// Whether light reaches the pixel. @pre 0 <= x < width, 0 <= y < height
  [[nodiscard]] bool sees(int x, int y) const { return sees_[static_cast<std::size_t>(y * width_ + x)]; }
  /// Camera's frame, of length nearly 1. @param u, v  place in the pixel, 0..1
  [[nodiscard]] Vec3 through(int x, int y, float u, float v) const {
    const Vec3* corner = &corners_[static_cast<std::size_t>(y * (width_ + 1) + x)];
    const Vec3* below = corner + width_ + 1;
    return (1.0F - v) * ((1.0F - u) * corner[0] + u * corner[1]) + v * ((1.0F - u) * below[0] + u * below[1]);
  }

 private:
  int width_, height_;
  float pixel_angle_;
  std::vector<Vec3> corners_;  ///< [height + 1][width + 1]
  std::vector<bool> sees_;     ///< [height][width]
};

}  // namespace docent::simulator
