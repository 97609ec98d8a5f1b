#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// A place that a search of the whole map found.
struct FoundPlace {
  Pose2 map_from_robot;
  double fit = 0.0;  ///< 0..1, mean over the readings of how near they end to a wall
};

/// All poses of a map from which the readings of a sweep end near walls: branch and bound over cells and headings
/// ([Hess2016] IV, there for loops of a map). A belief that has lost a place cannot find it again by itself; this can.
class PlaceSearch {
 public:
  /// `standing`: its free cells are where a robot can be. O(cells). Maps of more than kMostCells cells are not
  /// searched.
  PlaceSearch(const sensor_models::RayCaster& caster, const OccupancyGrid& standing);

  struct Wanted {
    std::size_t most = 100;       ///< places
    double within = 0.4;          ///< of the best one's fit
    double max_range = 0.0;       ///< [m] readings from there on are left out
    std::size_t work = 30000000;  ///< readings looked up, at most; then what was found until then
  };
  /// By falling fit, each at least a metre or 20 degrees from the others; none where fewer than twenty readings remain.
  [[nodiscard]] std::vector<FoundPlace> find(const sensor_models::RangeSweep& sweep, const Wanted& wanted) const;

  static constexpr std::size_t kMostCells = 16000000;

 private:
  static constexpr int kLevels = 6;  // a node of the uppermost covers 32 cells a side

  struct Readings;
  struct Node;
  /// Mean over the readings of the best that any position in nodes of a level could give; side by side, for their
  /// readings end side by side.
  template <std::size_t Count>
  [[nodiscard]] std::array<double, Count> bounds(const std::array<CellIndex, Count>& corners, int level, int heading,
                                                 const Readings& readings) const;

  GridFrame frame_;                              ///< of the cells
  std::vector<std::vector<std::uint8_t>> best_;  ///< [kLevels][rows * columns] the best of 2^level cells right and up
  std::vector<bool> is_free_;                    ///< [rows * columns]
};

}  // namespace docent::localization
