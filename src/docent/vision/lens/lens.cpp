#include "docent/vision/lens/lens.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <string>

namespace docent::vision {
namespace {

constexpr double kSmallRadius = 1e-9;  // below this a point is the centre, and series take the place of quotients
constexpr double kNearEnough = 1e-13;  // of a point at distance 1, for Newton's method
constexpr int kMostSteps = 40;
constexpr int kFieldSteps = 2000;  // in which the radius is searched at which the distortion folds

}  // namespace

Result<void> LensParams::validate() const {
  if (!(columns > 0 && rows > 0 && columns <= 65536 && rows <= 65536))
    return fail("lens.columns and lens.rows must be 1 .. 65536");
  if (!(focal_x > 0.0 && focal_y > 0.0 && std::isfinite(focal_x) && std::isfinite(focal_y)))
    return fail("lens.focal_x and lens.focal_y must be > 0");
  if (!std::isfinite(centre_x) || !std::isfinite(centre_y))
    return fail("lens.centre_x and lens.centre_y must be finite");
  for (const double coefficient : bend)
    if (!std::isfinite(coefficient)) return fail("lens.bend must be finite");
  const double most = kind == Kind::pinhole ? 0.5 * std::numbers::pi : std::numbers::pi;
  if (!(half_field > 0.0 && half_field < most))
    return fail("lens.half_field must be > 0 and < " + std::to_string(most) + " rad for this kind of lens");
  return {};
}

Result<Lens> Lens::make(const LensParams& params) {
  if (const auto valid = params.validate(); !valid) return tl::unexpected<Error>(valid.error());
  return Lens{params};
}

/// d bent radius / d flat radius, without the tangential part.
double Lens::radial_growth(double radius) const {
  const double r2 = radius * radius;
  const auto& k = params_.bend;
  if (params_.kind == LensParams::Kind::pinhole) return 1.0 + r2 * (3.0 * k[0] + r2 * (5.0 * k[1] + r2 * 7.0 * k[4]));
  return 1.0 + r2 * (3.0 * k[0] + r2 * (5.0 * k[1] + r2 * (7.0 * k[2] + r2 * 9.0 * k[3])));
}

Lens::Lens(const LensParams& params) : params_{params}, half_field_{params.half_field} {
  const bool is_pinhole = params.kind == LensParams::Kind::pinhole;
  most_radius_ = is_pinhole ? std::tan(half_field_) : half_field_;
  // A wide pinhole's radius is all but endless; the steps follow the angle.
  for (int i = 1; i <= kFieldSteps; ++i) {
    const double angle = params.half_field * i / kFieldSteps;
    const double radius = is_pinhole ? std::tan(angle) : angle;
    if (radial_growth(radius) > 0.0) continue;
    half_field_ = params.half_field * (i - 1) / kFieldSteps;
    most_radius_ = is_pinhole ? std::tan(half_field_) : half_field_;
    break;
  }
}

Eigen::Vector2d Lens::bent(const Eigen::Vector2d& flat, Eigen::Matrix2d* by_flat) const {
  const double x = flat.x(), y = flat.y(), r2 = x * x + y * y;
  const auto& k = params_.bend;
  if (params_.kind == LensParams::Kind::fisheye) {
    const double scale = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * (k[2] + r2 * k[3])));
    const double by_r2 = k[0] + r2 * (2.0 * k[1] + r2 * (3.0 * k[2] + r2 * 4.0 * k[3]));
    if (by_flat) *by_flat = scale * Eigen::Matrix2d::Identity() + 2.0 * by_r2 * flat * flat.transpose();
    return scale * flat;
  }
  const double scale = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double by_r2 = k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k[4]);
  const double p1 = k[2], p2 = k[3];
  if (by_flat) {
    *by_flat = scale * Eigen::Matrix2d::Identity() + 2.0 * by_r2 * flat * flat.transpose();
    (*by_flat)(0, 0) += 2.0 * p1 * y + 6.0 * p2 * x;
    (*by_flat)(0, 1) += 2.0 * p1 * x + 2.0 * p2 * y;
    (*by_flat)(1, 0) += 2.0 * p1 * x + 2.0 * p2 * y;
    (*by_flat)(1, 1) += 6.0 * p1 * y + 2.0 * p2 * x;
  }
  return {scale * x + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          scale * y + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

/// Newton's method with steps that are halved until they help: from the centre of the picture outwards the distortion
/// grows alone, so there is one answer within the field.
std::optional<Eigen::Vector2d> Lens::unbent(const Eigen::Vector2d& wanted) const {
  Eigen::Vector2d flat = wanted;
  if (flat.norm() > most_radius_) flat *= most_radius_ / flat.norm();
  Eigen::Matrix2d by_flat;
  Eigen::Vector2d off = bent(flat, &by_flat) - wanted;
  for (int i = 0; i < kMostSteps && off.norm() > kNearEnough * (1.0 + wanted.norm()); ++i) {
    if (std::abs(by_flat.determinant()) < 1e-12) break;
    const Eigen::Vector2d step = by_flat.inverse() * off;
    double share = 1.0;
    Eigen::Vector2d next_off;
    for (int halvings = 0; halvings < 30; ++halvings, share *= 0.5) {
      next_off = bent(flat - share * step, &by_flat) - wanted;
      if (next_off.norm() < off.norm()) break;
    }
    if (!(next_off.norm() < off.norm())) break;
    flat -= share * step;
    off = next_off;
  }
  if (!(off.norm() <= 1e-11 * (1.0 + wanted.norm())) || flat.norm() > most_radius_ * (1.0 + 1e-9)) return std::nullopt;
  return flat;
}

std::optional<Eigen::Vector2d> Lens::pixel_of(const Eigen::Vector3d& ray, PixelByRay* by_ray) const {
  const double across = std::hypot(ray.x(), ray.y());
  const double angle = std::atan2(across, ray.z());
  if (!(angle <= half_field_) || !(across > 0.0 || ray.z() > 0.0) || !ray.allFinite()) return std::nullopt;
  Eigen::Vector2d flat;
  Eigen::Matrix<double, 2, 3> flat_by_ray;
  if (params_.kind == LensParams::Kind::pinhole) {
    flat = ray.head<2>() / ray.z();
    flat_by_ray << 1.0 / ray.z(), 0.0, -flat.x() / ray.z(), 0.0, 1.0 / ray.z(), -flat.y() / ray.z();
  } else if (across < kSmallRadius * ray.z()) {
    flat = ray.head<2>() / ray.z();
    flat_by_ray << 1.0 / ray.z(), 0.0, 0.0, 0.0, 1.0 / ray.z(), 0.0;
  } else {
    // flat = (x, y) angle / across; d angle = (z d across - across d z) / |ray|^2
    const double scale = angle / across, length2 = ray.squaredNorm();
    const Eigen::Vector2d outward = ray.head<2>() / across;
    flat = scale * ray.head<2>();
    flat_by_ray.leftCols<2>() = scale * (Eigen::Matrix2d::Identity() - outward * outward.transpose()) +
                                ray.z() / length2 * outward * outward.transpose();
    flat_by_ray.col(2) = -across / length2 * outward;
  }
  Eigen::Matrix2d by_flat;
  const Eigen::Vector2d at = bent(flat, by_ray ? &by_flat : nullptr);
  if (by_ray) *by_ray = Eigen::Vector2d{params_.focal_x, params_.focal_y}.asDiagonal() * by_flat * flat_by_ray;
  return Eigen::Vector2d{params_.focal_x * at.x() + params_.centre_x, params_.focal_y * at.y() + params_.centre_y};
}

std::optional<Eigen::Vector3d> Lens::ray_of(const Eigen::Vector2d& pixel, RayByPixel* by_pixel) const {
  if (!pixel.allFinite()) return std::nullopt;
  const Eigen::Vector2d wanted{(pixel.x() - params_.centre_x) / params_.focal_x,
                               (pixel.y() - params_.centre_y) / params_.focal_y};
  const auto flat = unbent(wanted);
  if (!flat) return std::nullopt;
  Eigen::Vector3d ray;
  const double radius = flat->norm();
  Eigen::Matrix<double, 3, 2> ray_by_flat;
  if (params_.kind == LensParams::Kind::pinhole) {
    ray = Eigen::Vector3d{flat->x(), flat->y(), 1.0}.normalized();
    ray_by_flat = (Eigen::Matrix3d::Identity() - ray * ray.transpose()).leftCols<2>() * ray.z();
  } else if (radius < kSmallRadius) {
    ray = Eigen::Vector3d{flat->x(), flat->y(), 1.0};
    ray_by_flat << 1.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  } else {
    const Eigen::Vector2d outward = *flat / radius;
    ray << std::sin(radius) * outward, std::cos(radius);
    ray_by_flat.topRows<2>() =
        std::sin(radius) / radius * (Eigen::Matrix2d::Identity() - outward * outward.transpose()) +
        std::cos(radius) * outward * outward.transpose();
    ray_by_flat.row(2) = -std::sin(radius) * outward.transpose();
  }
  if (by_pixel) {
    Eigen::Matrix2d by_flat;
    static_cast<void>(bent(*flat, &by_flat));
    *by_pixel =
        ray_by_flat * by_flat.inverse() * Eigen::Vector2d{1.0 / params_.focal_x, 1.0 / params_.focal_y}.asDiagonal();
  }
  return ray;
}

}  // namespace docent::vision
