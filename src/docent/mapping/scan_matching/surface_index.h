#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/scan_matching/point_sweep.h"

namespace docent::mapping {

/// The nearest known surface point of any place, looked up in a grid.
class SurfaceIndex {
 public:
  static constexpr double kReach = 0.4;  ///< [m]: nothing farther is found

  /// @pre points not empty
  explicit SurfaceIndex(std::span<const SurfacePoint> points);

  /// The nearest to the middle of the cell that `at` lies in; nullptr where none is within reach. O(1).
  [[nodiscard]] const SurfacePoint* nearest(Point2 at) const;

 private:
  static constexpr std::int32_t kNone = -1;

  std::vector<SurfacePoint> points_;
  GridFrame frame_;
  std::vector<std::int32_t> nearest_;  ///< [rows * columns], index of a point
};

}  // namespace docent::mapping
