#pragma once

#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::mapping {

/// A point on a surface and, where its neighbours in the sweep show it, the direction square to that surface.
struct SurfacePoint {
  Point2 at;      ///< [m]
  Point2 normal;  ///< of length 1; (0, 0): not known
  [[nodiscard]] bool has_normal() const { return normal.x != 0.0 || normal.y != 0.0; }  ///< the direction is known
};

/// Which ends of beams are points of surfaces.
struct PointSweepParams {
  double reach = 20.0;        ///< [m], > 0: beyond it half a degree is 17 cm
  double nearest = 0.05;      ///< [m], >= 0: nearer returns are the robot's own body
  double widest_gap = 0.35;   ///< [m], > 0: neighbouring beams that end farther apart lie on two surfaces, or
  double steepest_gap = 4.0;  ///< > 0: by so many times the way between two beams at this range
  int neighbours = 3;         ///< > 0: on each side, that a normal is fitted to
  template <class V>
  void visit(V& v) {
    v("reach", reach);
    v("nearest", nearest);
    v("widest_gap", widest_gap);
    v("steepest_gap", steepest_gap);
    v("neighbours", neighbours);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The ends of the beams that came back, with normals fitted by least squares to their neighbours in the sweep. Beams
/// must be in the order of their bearings, as one laser gives them. Normals point towards the sensor. O(beams).
[[nodiscard]] std::vector<SurfacePoint> surface_points(const sensor_models::RangeSweep& sweep,
                                                       const PointSweepParams& params);

/// `b_from_a` applied to points and normals.
[[nodiscard]] SurfacePoint transformed(const Pose2& b_from_a, const SurfacePoint& point);

/// At most one point a cell of a grid of width `cell` [m], the first one. O(n).
[[nodiscard]] std::vector<Point2> thinned_points(std::span<const Point2> points, double cell);

}  // namespace docent::mapping
