#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::mapping {

struct MatchGridParams {
  double resolution = 0.05;  ///< [m/cell], > 0
  double sigma = 0.07;  ///< [m], > 0: how far surfaces of two sweeps may lie apart by noise and the poses of a chain
  int levels = 5;       ///< 1..8: the coarsest cell of the search is 2^(levels-1) cells wide
};

/// How well a point fits known surfaces: 255 on one, falling like a Gaussian beside it; and, for bounds of a search,
/// the largest such value within squares of 2, 4, 8… cells.
///
/// Departures from E. Olson, Real-time correlative scan matching (ICRA 2009), and W. Hess et al., Real-time loop
/// closure in 2D lidar SLAM (ICRA 2016): one resolution for all levels, as the latter, over blurred points, as the
/// former.
class MatchGrid {
 public:
  /// @pre params are valid, points not empty
  MatchGrid(std::span<const Point2> points, const MatchGridParams& params);

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
  /// The largest value in the square of 2^level cells whose lower-left cell is this one. 0 outside. O(1).
  [[nodiscard]] std::uint8_t bound(int level, CellIndex cell) const {
    return frame_.holds(cell) ? levels_[static_cast<std::size_t>(level)][frame_.index(cell)] : std::uint8_t{0};
  }

 private:
  void blur(std::span<const Point2> points, double sigma);
  void add_level(int step);

  GridFrame frame_;
  std::vector<std::vector<std::uint8_t>> levels_;  ///< [levels][rows * columns]
};

}  // namespace docent::mapping
