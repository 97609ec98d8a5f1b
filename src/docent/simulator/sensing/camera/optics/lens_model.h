#pragma once

#include <array>
#include <numbers>
#include <optional>

#include "docent/geometry/pose2.h"
#include "docent/simulator/sensing/camera/mesh/mesh.h"

namespace docent::simulator {

enum class LensKind : std::uint8_t { pinhole, fisheye };

/// What a glass does to light on its way to the sensor: a pinhole with radial and tangential distortion (Brown), or an
/// equidistant fisheye with a polynomial of the angle. Camera's frame: x to the right, y down, z ahead.
struct LensModel {
  LensKind kind = LensKind::pinhole;
  int width = 320;         ///< [pixels]
  int height = 240;        ///< [pixels]
  double focal_x = 200.0;  ///< [pixels]; of a fisheye [pixels/rad] at its middle
  double focal_y = 200.0;
  double centre_x = 160.0;  ///< [pixels] from the left edge of the picture
  double centre_y = 120.0;  ///< [pixels] from its upper edge
  /// k1, k2, p1, p2, k3: x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²), y' likewise.
  std::array<double, 5> brown{};
  /// k1..k4: θ' = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸).
  std::array<double, 4> fisheye{};
  /// [rad] off the axis: light from farther aside does not reach the sensor; of lenses that distort.
  double widest = 1.5;

  /// Where the light on a place of the picture comes from, of length 1; {0, 0, 0}: none does.
  [[nodiscard]] Vec3 ray(double u, double v) const;
  /// Where on the sensor a direction lies; nullopt: it does not reach it.
  [[nodiscard]] std::optional<Point2> pixel(Vec3 in_camera) const;
};

/// A pinhole without distortion. @param field_of_view  [rad] across
[[nodiscard]] LensModel plain_lens(int width, int height, double field_of_view);

}  // namespace docent::simulator
