#pragma once

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
  explicit RayCaster(const OccupancyGrid& map);

  /// Distance [m] from `from` along the unit vector `direction` to the outline of the first occupied cell; `max_range`
  /// when none is nearer; nullopt when more than `unknown_allowance` [m] of the way is unknown or outside the map.
  [[nodiscard]] std::optional<double> cast(Point2 from, Point2 direction, double max_range,
                                           double unknown_allowance) const;

  /// Distance [m] to the nearest occupied cell's centre; +infinity outside the map.
  [[nodiscard]] float clearance(Point2 in_map) const;
  [[nodiscard]] const GridFrame& frame() const { return frame_; }

 private:
  enum class Kind : unsigned char { free, unknown, occupied };
  GridFrame frame_;
  std::vector<Kind> kinds_;
  std::vector<float> leap_;       ///< [m] a ray may go from anywhere in the cell and stays in free cells; <= 0: none
  std::vector<float> clearance_;  ///< [m]
};

}  // namespace docent::sensor_models
