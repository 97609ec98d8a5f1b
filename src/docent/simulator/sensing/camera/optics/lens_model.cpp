#include "docent/simulator/sensing/camera/optics/lens_model.h"

#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kClose = 1e-10;
constexpr int kMostSteps = 50;

/// Brown's polynomial, from the place without distortion to the one with it.
Point2 distorted(const std::array<double, 5>& k, Point2 p) {
  const double r2 = dot(p, p);
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  return {p.x * radial + 2.0 * k[2] * p.x * p.y + k[3] * (r2 + 2.0 * p.x * p.x),
          p.y * radial + k[2] * (r2 + 2.0 * p.y * p.y) + 2.0 * k[3] * p.x * p.y};
}

/// Its inverse; nullopt: there is none near.
std::optional<Point2> undistorted(const std::array<double, 5>& k, Point2 seen) {
  Point2 p = seen;
  for (int i = 0; i < kMostSteps; ++i) {
    const Point2 off = seen - distorted(k, p);
    p = p + off;
    if (dot(off, off) < kClose * kClose) return p;
  }
  return std::nullopt;
}

double bent(const std::array<double, 4>& k, double angle) {
  const double t = angle * angle;
  return angle * (1.0 + t * (k[0] + t * (k[1] + t * (k[2] + t * k[3]))));
}

std::optional<double> straightened(const std::array<double, 4>& k, double seen) {
  double angle = seen;
  for (int i = 0; i < kMostSteps; ++i) {
    const double t = angle * angle;
    const double slope = 1.0 + t * (3.0 * k[0] + t * (5.0 * k[1] + t * (7.0 * k[2] + t * 9.0 * k[3])));
    if (!(slope > 0.05)) return std::nullopt;  // beyond the polynomial's turn
    const double off = (bent(k, angle) - seen) / slope;
    angle -= off;
    if (std::abs(off) < kClose) return angle;
  }
  return std::nullopt;
}

}  // namespace

Vec3 LensModel::ray(double u, double v) const {
  const Point2 seen{(u - centre_x) / focal_x, (v - centre_y) / focal_y};
  double x = 0.0, y = 0.0, z = 1.0;
  if (kind == LensKind::pinhole) {
    const bool is_straight = brown == std::array<double, 5>{};
    const auto p = is_straight ? seen : undistorted(brown, seen);
    if (!p) return {0.0F, 0.0F, 0.0F};
    x = p->x, y = p->y;
    if (!is_straight && std::atan(norm(*p)) > widest) return {0.0F, 0.0F, 0.0F};
  } else {
    const double bent_angle = norm(seen);
    const auto angle = straightened(fisheye, bent_angle);
    if (!angle || *angle > widest || *angle < 0.0) return {0.0F, 0.0F, 0.0F};
    const double aside = bent_angle > 0.0 ? std::sin(*angle) / bent_angle : 0.0;
    x = aside * seen.x, y = aside * seen.y, z = std::cos(*angle);
  }
  const double length = std::sqrt(x * x + y * y + z * z);
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

std::optional<Point2> LensModel::pixel(Vec3 in_camera) const {
  const double x = in_camera.x, y = in_camera.y, z = in_camera.z;
  const double across = std::sqrt(x * x + y * y);
  const double angle = std::atan2(across, z);
  const bool is_straight = kind == LensKind::pinhole && brown == std::array<double, 5>{};
  if (angle > widest && !is_straight) return std::nullopt;
  Point2 seen;
  if (kind == LensKind::pinhole) {
    if (!(z > 0.0)) return std::nullopt;
    seen = distorted(brown, {x / z, y / z});
  } else if (across > 0.0) {
    seen = (bent(fisheye, angle) / across) * Point2{x, y};
  }
  const Point2 at{centre_x + focal_x * seen.x, centre_y + focal_y * seen.y};
  if (at.x < 0.0 || at.y < 0.0 || at.x > width || at.y > height) return std::nullopt;
  return at;
}

LensModel plain_lens(int width, int height, double field_of_view) {
  LensModel lens;
  lens.width = width, lens.height = height;
  lens.focal_x = lens.focal_y = 0.5 * width / std::tan(0.5 * field_of_view);
  lens.centre_x = 0.5 * width, lens.centre_y = 0.5 * height;
  lens.widest = 0.5 * std::numbers::pi - 1e-3;
  return lens;
}

}  // namespace docent::simulator
