#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"

namespace docent {

struct LiveMapParams {
  int coarsening = 3;           ///< live cell = so many cells of the static map
  double reach = 6.0;           ///< [m], farther endpoints are not believed
  double static_margin = 0.25;  ///< [m]: nearer to a mapped obstacle an endpoint is that obstacle
  int hits_to_block = 3;        ///< of the last four looks at a cell, 1..4
  double forget = 30.0;         ///< [s] until a cell that nobody looked at is free again
  double period = 0.5;          ///< [s] between looks
  template <class V>
  void visit(V& v) {
    v("coarsening", coarsening);
    v("reach", reach);
    v("static_margin", static_margin);
    v("hits_to_block", hits_to_block);
    v("forget", forget);
    v("period", period);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What stands in the hall now and not in the static map: a laser layer over it with decay, joined by the max rule
/// [Burgard1999, eq. (19)]. A person who walks by leaves no trace; who stands for two looks of four, does.
class LiveMap {
 public:
  LiveMap(const OccupancyGrid& static_map, LiveMapParams params);

  /// One look: rays from `sensor` to `endpoints` (map frame). An endpoint beyond the reach only clears. O(rays * cells
  /// on them).
  void look(Point2 sensor, std::span<const Point2> endpoints, Time now);
  /// Frees what nobody looked at for too long. O(cells).
  void forget(Time now);

  [[nodiscard]] const GridFrame& frame() const { return static_.frame; }
  /// The max rule: the larger of the static cell and the live one.
  [[nodiscard]] std::int8_t cell(std::size_t index) const;
  [[nodiscard]] bool is_blocked(std::size_t index) const;
  /// Cells [rows * columns] that are blocked now and not in the static map.
  [[nodiscard]] std::vector<bool> obstacles() const;
  /// Rectangle of the cells that changed since the last call; nullopt when none did.
  struct Rectangle {
    CellIndex low, high;  ///< both included
  };
  [[nodiscard]] std::optional<Rectangle> take_changes();

 private:
  void mark(CellIndex cell, bool hit, Time now);

  LiveMapParams params_;
  OccupancyGrid static_;               ///< coarsened
  std::vector<bool> near_static_;      ///< an endpoint here belongs to the static map
  std::vector<std::uint8_t> history_;  ///< the last eight looks, the newest in bit 0
  std::vector<Time> seen_;
  std::vector<std::uint32_t> look_of_;  ///< the last look that touched the cell: one entry in the history a look
  std::uint32_t look_ = 0;
  std::optional<Rectangle> changes_;
};

}  // namespace docent
