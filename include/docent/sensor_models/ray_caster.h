#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "docent/grid/occupancy_grid.h"

namespace docent::sensor_models {

/// The map with its walls peeled: occupied cells whose middle is less than `depth` [m] from free space become free, but
/// for those in the middle of thin walls. Maps learned with wide sensor models have walls that stand out into the room,
/// and beams that graze such a wall come out far too short. O(cells).
[[nodiscard]] OccupancyGrid peeled(const OccupancyGrid& map, double depth);

/// Ranges that a perfect sensor would measure in a map: exact traversal of cells, with leaps over free space that the
/// distance transform allows.
class RayCaster {
 public:
  /// O(cells), once.
  explicit RayCaster(const OccupancyGrid& map);

  /// Distance [m] from `from` along the unit vector `direction` to the outline of the first occupied cell; `max_range`
  /// when none is nearer; nullopt when more than `unknown_allowance` [m] of the way is unknown or outside the map.
  [[nodiscard]] std::optional<double> cast(Point2 from, Point2 direction, double max_range,
                                           double unknown_allowance) const;

  /// Distance [m] to the nearest occupied cell's centre; +infinity outside the map.
  [[nodiscard]] float clearance(Point2 in_map) const;
  [[nodiscard]] const GridFrame& frame() const { return frame_; }  ///< of the map

 private:
  /// Where the cell stands in steps_.
  [[nodiscard]] std::size_t place_of(CellIndex cell) const {
    const auto column = static_cast<std::size_t>(cell.column);
    const auto row = static_cast<std::size_t>(cell.row);
    return ((row / kBlock * blocks_ + column / kBlock) * kBlock + row % kBlock) * kBlock + column % kBlock;
  }

  static constexpr std::size_t kBlock = 8;  ///< [cells] a side of what fits a cache line
  // What a ray meets in a cell. Most of its time goes into waiting for these: so they are bytes, and neighbours in both
  // directions lie together.
  static constexpr std::uint8_t kOccupied = 0;
  static constexpr std::uint8_t kUnknown = 1;
  static constexpr std::uint8_t kFree = 2;  ///< and above: half cells a ray may go on and stays in free cells

  GridFrame frame_;
  std::size_t blocks_ = 0;  ///< in a row of blocks
  std::vector<std::uint8_t> steps_;
  std::vector<float> clearance_;  ///< [m]
};

}  // namespace docent::sensor_models
