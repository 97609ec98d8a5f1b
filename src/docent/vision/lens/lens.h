#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "docent/base/result.h"

namespace docent::vision {

/// How a lens bends light. The coefficients are those of sensor_msgs/CameraInfo and of OpenCV.
struct LensParams {
  enum class Kind {
    pinhole,  ///< [Brown1971]: coefficients k1, k2, p1, p2, k3 ("plumb_bob")
    fisheye   ///< [KannalaBrandt2006]: theta (1 + k1 theta^2 + ... + k4 theta^8), coefficients k1 .. k4 ("equidistant")
  };
  Kind kind = Kind::pinhole;
  int columns = 640;        ///< [pixels] of the picture, > 0
  int rows = 480;           ///< [pixels] > 0
  double focal_x = 500.0;   ///< [pixels] > 0
  double focal_y = 500.0;   ///< [pixels] > 0
  double centre_x = 319.5;  ///< [pixels] where the optical axis meets the picture; the centre of the first pixel is 0
  double centre_y = 239.5;  ///< [pixels]
  std::array<double, 5> bend{};  ///< the coefficients, in the order above
  double half_field =
      1.55;  ///< [rad] farthest a ray may lie from the axis: below pi / 2 for a pinhole, below pi for a fisheye
  [[nodiscard]] Result<void> validate() const;
};

/// d pixel / d ray: how the pixel moves with each coordinate of the ray.
using PixelByRay = Eigen::Matrix<double, 2, 3>;
/// d ray / d pixel, of the ray of length 1.
using RayByPixel = Eigen::Matrix<double, 3, 2>;

/// Pixels and rays of one camera. Rays stand in the camera's optical frame: x to the right of the picture, y down, z
/// along the axis, away from the camera.
class Lens {
 public:
  /// Error: a parameter out of its bounds.
  [[nodiscard]] static Result<Lens> make(const LensParams& params);

  [[nodiscard]] const LensParams& params() const { return params_; }
  /// [rad] What lies farther from the axis has no pixel: half_field, or where the distortion begins to fold.
  [[nodiscard]] double half_field() const { return half_field_; }

  /// Where a ray of any length falls; nothing for one from behind, or from outside the field. The pixel may lie outside
  /// the picture. @param by_ray  its Jacobian, unless null
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector3d& ray, PixelByRay* by_ray = nullptr) const;

  /// The ray of length 1 that falls there, to 1e-12; nothing where the lens sends no light.
  /// @param by_pixel  its Jacobian, unless null
  [[nodiscard]] std::optional<Eigen::Vector3d> ray_of(const Eigen::Vector2d& pixel,
                                                      RayByPixel* by_pixel = nullptr) const;

 private:
  explicit Lens(const LensParams& params);
  /// Of a picture at distance 1: for a pinhole the point (x / z, y / z), for a fisheye the point at distance theta.
  [[nodiscard]] Eigen::Vector2d bent(const Eigen::Vector2d& flat, Eigen::Matrix2d* by_flat) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> unbent(const Eigen::Vector2d& bent) const;
  [[nodiscard]] double radial_growth(double radius) const;

  LensParams params_;
  double half_field_ = 0.0;
  double most_radius_ = 0.0;  ///< of a flat point within the field
};

}  // namespace docent::vision
