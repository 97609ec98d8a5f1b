#pragma once

#include <array>

#include "docent/base/result.h"
#include "docent/motion_models/odometry_model.h"

namespace docent::planning {

/// How the degree of uncertainty grows with the way and shrinks by what the sensors tell.
struct UncertaintyParams {
  motion_models::OdometryModelParams motion;  ///< how the robot's odometry errs
  double heading_scale = 0.25;   ///< [rad/m], > 0: heading deviation that goes with a metre of position deviation
  double scans_per_metre = 4.0;  ///< > 0: updates of the belief
  template <class V>
  void visit(V& v) {
    v("motion", motion);
    v("heading_scale", heading_scale);
    v("scans_per_metre", scans_per_metre);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The degree of uncertainty of a pose, and all that coastal navigation knows of a belief besides its maximum: its
/// entropy [Minerva2000] eq. 22, kept as the variance s [m2] of the Gaussian diag(s, s, k^2 s) over (x, y, heading)
/// that has it; k is `heading_scale`. H = ln((2 pi e)^(3/2) k s^(3/2)).
class Uncertainty {
 public:
  explicit Uncertainty(const UncertaintyParams& params) : params_{params} {}

  /// The variance after `way` metres past places of this information.
  ///
  /// Motion: a heading that is wrong carries the robot sideways. The two errors grow together, correlated by
  /// sqrt(3) / 2 as an integrated random walk is with its walk; of that sideways growth, sqrt(3) k s a metre, each axis
  /// has half. Then n = scans_per_metre * way scans, of which each adds its information: s is divided by the cube root
  /// of prod_i (1 + n s l_i), the share by which det (Sigma^-1 + n I)^-1 is smaller than det Sigma.
  /// Grows with `variance` and falls with every eigenvalue. O(1).
  /// @param eigenvalues  [1/m2] of PoseInformation, of one scan
  [[nodiscard]] double after(double variance, const std::array<double, 3>& eigenvalues, double way) const;

  /// Entropy [nat] of the Gaussian.
  [[nodiscard]] double entropy(double variance) const;
  /// Of a covariance over (x, y, heading), row-major: the variance of the Gaussian that has its entropy.
  [[nodiscard]] double variance_of(const std::array<double, 9>& covariance) const;
  [[nodiscard]] double heading_scale() const { return params_.heading_scale; }

 private:
  UncertaintyParams params_;
};

}  // namespace docent::planning
