#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "docent/base/random.h"
#include "docent/vision/ceiling/ceiling_camera.h"

/// Ceilings and their pictures for tests: a renderer of its own, which shares nothing with what it tests but the lens.
namespace docent::vision::ceiling_testing {

struct Light {
  double gain = 1.0;
  double offset = 0.0;
  double noise = 0.0;  ///< standard deviation of a pixel, of 0 .. 1
  double lean = 0.0;   ///< [rad] about the robot's x axis
};

struct DrawnPicture {
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> bytes;
  [[nodiscard]] GrayPicture view() const { return {columns, rows, bytes}; }
};

/// A hall of 10 m x 8 m: panels, stains and lamps at irregular places, and an opening with a higher ceiling.
struct Hall {
  std::uint64_t seed = 1;
  double low = 3.0;         ///< [m]
  double high = 6.0;        ///< [m] in the opening
  Point2 corner{4.0, 3.0};  ///< [m] of the opening, lower left
  Point2 size{2.5, 2.0};    ///< [m]
  double period = 0.0;      ///< [m] after which the ceiling repeats itself, 0: never
  bool is_plain = false;
  bool lamps_are_lit = true;

  [[nodiscard]] bool is_high(Point2 at) const {
    return at.x > corner.x && at.y > corner.y && at.x < corner.x + size.x && at.y < corner.y + size.y;
  }
  /// Of 0 .. 1, between fixed random values: smooth patches of about 0.4 m, and lamps.
  [[nodiscard]] double brightness(Point2 at) const {
    if (is_plain) return 0.6;
    if (period > 0.0) at = {at.x - period * std::floor(at.x / period), at.y - period * std::floor(at.y / period)};
    const double patches = smooth(at, 0.35, 1) * 0.35 + smooth(at, 1.1, 2) * 0.25;
    const double lamp = smooth(at, 0.9, 3);
    return 0.15 + patches + (lamps_are_lit && lamp > 0.72 ? std::min(0.3, 4.0 * (lamp - 0.72)) : 0.0);
  }
  [[nodiscard]] DrawnPicture picture(const CeilingCamera& camera, const Pose2& map_from_robot, const Light& light,
                                     Rng& rng) const {
    const LensParams& lens = camera.lens.params();
    DrawnPicture drawn{lens.columns, lens.rows, {}};
    drawn.bytes.reserve(static_cast<std::size_t>(lens.columns) * static_cast<std::size_t>(lens.rows));
    const double c = std::cos(light.lean), s = std::sin(light.lean);
    for (int row = 0; row < lens.rows; ++row) {
      for (int column = 0; column < lens.columns; ++column) {
        double value = 0.0;
        if (const auto ray = camera.lens.ray_of({static_cast<double>(column), static_cast<double>(row)})) {
          Eigen::Vector3d up = camera.mount.robot_from_camera * *ray;
          up = {up.x(), c * up.y() - s * up.z(), s * up.y() + c * up.z()};
          if (up.z() > 0.02) value = seen(camera.mount.position, up, map_from_robot);
        }
        const double shown = light.gain * value + light.offset + light.noise * rng.normal();
        drawn.bytes.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * shown), 0L, 255L)));
      }
    }
    return drawn;
  }

 private:
  [[nodiscard]] double seen(const Eigen::Vector3d& from, const Eigen::Vector3d& up, const Pose2& map_from_robot) const {
    const auto at = [&](double height) {
      const double rise = (height - from.z()) / up.z();
      return map_from_robot * Point2{from.x() + rise * up.x(), from.y() + rise * up.y()};
    };
    const Point2 below = at(low);
    if (!is_high(below)) return brightness(below);
    const Point2 above = at(high);
    return is_high(above) ? brightness(above) : 0.3;  // else a vertical face of the opening
  }
  [[nodiscard]] double value_at(int x, int y, int layer) const {
    std::uint64_t mixed = seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(x + 1000) * 0xBF58476D1CE4E5B9ULL +
                          static_cast<std::uint64_t>(y + 1000) * 0x94D049BB133111EBULL +
                          static_cast<std::uint64_t>(layer) * 0xD6E8FEB86659FD93ULL;
    mixed ^= mixed >> 31U, mixed *= 0xBF58476D1CE4E5B9ULL, mixed ^= mixed >> 29U, mixed *= 0x94D049BB133111EBULL,
        mixed ^= mixed >> 32U;
    return static_cast<double>(mixed >> 11U) * 0x1.0p-53;
  }
  [[nodiscard]] double smooth(Point2 at, double step, int layer) const {
    const double x = at.x / step, y = at.y / step;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const auto eased = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double u = eased(x - column), v = eased(y - row);
    return (1.0 - v) * ((1.0 - u) * value_at(column, row, layer) + u * value_at(column + 1, row, layer)) +
           v * ((1.0 - u) * value_at(column, row + 1, layer) + u * value_at(column + 1, row + 1, layer));
  }
};

/// 240 x 180 pixels, 100 degrees from corner to corner, 1.2 m above the floor.
inline CeilingCamera camera() {
  const LensParams lens{.columns = 240,
                        .rows = 180,
                        .focal_x = 130.0,
                        .focal_y = 130.0,
                        .centre_x = 119.5,
                        .centre_y = 89.5,
                        .bend = {-0.05, 0.01, 0.0, 0.0, 0.0},
                        .half_field = 1.0};
  return {Lens::make(lens).value(), looking_up({0.1, 0.0, 1.2})};
}

inline bool near_to(const Pose2& a, const Pose2& b, double metres, double degrees) {
  return distance(a.position(), b.position()) < metres && std::abs((a.theta - b.theta).degrees()) < degrees;
}

}  // namespace docent::vision::ceiling_testing
