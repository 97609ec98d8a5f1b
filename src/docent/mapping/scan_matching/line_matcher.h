#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "docent/base/result.h"
#include "docent/mapping/scan_matching/surface_index.h"

namespace docent::mapping {

/// How points are laid finely onto surfaces.
struct LineMatcherParams {
  int steps = 12;                  ///< > 0: at most
  double first_gate = 0.30;        ///< [m], up to SurfaceIndex::kReach: pairs farther apart do not count at first,
  double last_gate = 0.12;         ///< [m], > 0: and at last; between them it shrinks by halves
  double sigma = 0.03;             ///< [m], > 0: of a distance between a point and the line that it lies on
  double independent_points = 20;  ///< > 0: what all points of a sweep are worth; their errors hang together
  template <class V>
  void visit(V& v) {
    v("steps", steps);
    v("first_gate", first_gate);
    v("last_gate", last_gate);
    v("sigma", sigma);
    v("independent_points", independent_points);
  }
  [[nodiscard]] Result<void> validate() const;
};

struct LineMatch {
  Pose2 reference_from_sweep;
  Eigen::Matrix3d information;  ///< inverse covariance of (x, y, theta), the displacement seen in the sweep's frame
  double overlap = 0.0;         ///< 0..1: share of the points that met a line within the last gate
  double residual = 0.0;        ///< [m], root mean square of their distances
};

/// The pose at which the points lie best on the lines of the reference: Gauss-Newton over the distances of points to
/// the lines through their nearest neighbours (A. Censi, An ICP variant using a point-to-line metric, ICRA 2008), with
/// weights that fall with the distance (Tukey). A direction that no line bears out, as along a corridor, is left where
/// it was: its information is nought. None where too few points meet a line. O(steps * points).
[[nodiscard]] std::optional<LineMatch> line_match(const SurfaceIndex& reference, std::span<const SurfacePoint> sweep,
                                                  const Pose2& first, const LineMatcherParams& params);

}  // namespace docent::mapping
