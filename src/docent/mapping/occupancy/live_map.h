#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"

namespace docent {

/// Section `map`: what stands in the hall now and not on the map.
struct LiveMapParams {
  int coarsening = 3;           ///< live cell = so many cells of the static map
  double reach = 6.0;           ///< [m], farther endpoints are not believed
  double static_margin = 0.25;  ///< [m]: nearer to a mapped obstacle an endpoint is that obstacle
  int hits_to_block = 3;        ///< of the last four looks at a cell, 1..4
  double forget = 30.0;         ///< [s] until a cell that nobody looked at is free again
  double settle = 20.0;         ///< [s] that a cell was seen blocked, then what stands there is no passer-by
  double forget_settled = 300;  ///< [s] until such a cell that nobody looked at is free again
  double period = 0.5;          ///< [s] between looks
  template <class V>
  void visit(V& v) {
    v("coarsening", coarsening);
    v("reach", reach);
    v("static_margin", static_margin);
    v("hits_to_block", hits_to_block);
    v("forget", forget);
    v("settle", settle);
    v("forget_settled", forget_settled);
    v("period", period);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What stands in the hall now and not in the static map: a laser layer over it with decay, joined by the max rule
/// [Burgard1999, eq. (19)]. A person who walks by leaves no trace; who stands for three looks of four, does. What was
/// seen to stand for longer, a stool or a closed passage, is settled: it is remembered for minutes while nobody looks,
/// and freed like all else by looks that pass through it.
class LiveMap {
 public:
  LiveMap(const OccupancyGrid& static_map, LiveMapParams params);

  /// One look: rays from `sensor` to `endpoints` (map frame). An endpoint beyond the reach only clears. O(rays * cells
  /// on them).
  void look(Point2 sensor, std::span<const Point2> endpoints, Time now);
  /// Frees what nobody looked at for too long. O(cells).
  void forget(Time now);

  [[nodiscard]] const GridFrame& frame() const { return static_.frame; }
  static constexpr std::int8_t kPassing = 80;  ///< blocked, as a person may block it
  static constexpr std::int8_t kSettled = OccupancyGrid::kOccupied;
  /// The max rule: the larger of the static cell and the live one.
  [[nodiscard]] std::int8_t cell(std::size_t index) const;
  [[nodiscard]] bool is_blocked(std::size_t index) const;
  [[nodiscard]] bool is_settled(std::size_t index) const { return is_blocked(index) && settled_[index]; }
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
  std::vector<Time> blocked_since_;
  std::vector<bool> settled_;
  std::vector<std::uint32_t> look_of_;  ///< the last look that touched the cell: one entry in the history a look
  std::uint32_t look_ = 0;
  std::optional<Rectangle> changes_;
};

}  // namespace docent
