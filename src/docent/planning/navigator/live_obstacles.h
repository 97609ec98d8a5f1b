#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/value_iteration/route.h"

namespace docent::planning {

/// A numbered rectangle of the live map: what changed since the one before.
struct LivePatch {
  Time base{};               ///< the stamp of the whole map that it changes
  std::uint32_t number = 0;  ///< 1, 2, ... since that map
  CellIndex low{};           ///< its lower left cell
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::span<const std::int8_t> cells;  ///< [rows * columns] 0..100 or unknown
};

/// What stands in the building now and not in its map, as the live map has it. That comes whole now and then, and in
/// numbered rectangles between; after a gap only the next whole map counts.
class LiveObstacles {
 public:
  /// @param map  with the cells that planning has
  explicit LiveObstacles(OccupancyGrid map);

  /// @param cells  [rows * columns]; another number is of another building, and left out
  void take_map(Time stamp, std::span<const std::int8_t> cells);
  /// Left out when it does not follow the one before.
  void take_patch(const LivePatch& patch);

  /// [rows * columns] what stands there now.
  [[nodiscard]] const std::vector<bool>& standing() const { return standing_; }
  /// [rows * columns] those of them that have stood there for long.
  [[nodiscard]] const std::vector<bool>& settled() const { return settled_; }
  /// Something stands within `radius` [m] of the place.
  [[nodiscard]] bool stands_within(Point2 in_map, double radius) const;
  /// Where both may have changed since this was asked last; nullopt: nowhere.
  [[nodiscard]] std::optional<CellBox> take_changes();

 private:
  void take(std::size_t index, std::int8_t live);
  void note_change(CellIndex low, CellIndex high);

  OccupancyGrid map_;
  std::vector<bool> standing_;
  std::vector<bool> settled_;
  Time base_{};               ///< of the last whole map
  std::uint32_t number_ = 0;  ///< of the last rectangle
  std::optional<CellBox> changed_;
};

}  // namespace docent::planning
