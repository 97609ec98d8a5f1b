#include "docent/planning/coastal/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::planning {

Result<void> UncertaintyParams::validate() const {
  if (!(heading_scale > 0.0)) return fail("heading_scale must be > 0");
  if (!(scans_per_metre > 0.0)) return fail("scans_per_metre must be > 0");
  return motion.validate();
}

double Uncertainty::after(double variance, const std::array<double, 3>& eigenvalues, double way) const {
  const double k = params_.heading_scale;
  const double sideways = 0.5 * std::sqrt(3.0) * k * variance;
  const double position = variance + way * (params_.motion.translation_per_metre + sideways);
  const double heading = variance + way * params_.motion.rotation_per_metre / (k * k);
  const double foretold = std::cbrt(position * position * heading);
  const double scans = params_.scans_per_metre * way;
  double told = 1.0;
  for (const double eigenvalue : eigenvalues) told *= 1.0 + scans * foretold * eigenvalue;
  return foretold / std::cbrt(told);
}

double Uncertainty::entropy(double variance) const {
  return 1.5 * std::log(2.0 * std::numbers::pi * std::numbers::e * variance) + std::log(params_.heading_scale);
}

double Uncertainty::variance_of(const std::array<double, 9>& c) const {
  const double determinant =
      c[0] * (c[4] * c[8] - c[5] * c[7]) - c[1] * (c[3] * c[8] - c[5] * c[6]) + c[2] * (c[3] * c[7] - c[4] * c[6]);
  const double k = params_.heading_scale;
  return std::cbrt(std::max(0.0, determinant) / (k * k));
}

}  // namespace docent::planning
