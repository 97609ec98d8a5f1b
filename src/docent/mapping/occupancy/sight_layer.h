#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/occupancy/cell_rectangle.h"
#include "docent/mapping/occupancy/cone_layer.h"

namespace docent::mapping {

/// Part `sight` of section `map` of robot.yaml.
struct SightLayerParams {
  double reach = 3.0;    ///< [m] > 0 from the robot: nearer, a line that is no longer there frees what it had marked
  double seen = 0.3;     ///< [m] >= 0: what has a laser's point so near stands in the lasers' layer already
  int looks = 2;         ///< 1..10 messages in a row that mark a cell, or free it
  double forget = 1800;  ///< [s] > 0 until a place is tried again that nobody has looked at
  template <class V>
  void visit(V& v) {
    v("reach", reach);
    v("seen", seen);
    v("looks", looks);
    v("forget", forget);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Lines on the floor that cameras, or a base's sensors of edges, say nothing may touch. Each message holds all that
/// its source knows about the robot, so what it no longer says is gone, but for what a nearer line hides.
class SightLayer {
 public:
  /// @param known  [rows * columns] cells where a line is no news: near a mapped wall or hazard
  SightLayer(const GridFrame& frame, std::vector<bool> known, const SightLayerParams& params);

  /// @param lines  [m], map. O(cells within reach * lines)
  void see(Point2 robot, std::span<const Segment> lines, std::span<const LaserLook> lasers, Time now);
  /// O(cells).
  void forget(Time now);

  [[nodiscard]] bool is_blocked(std::size_t index) const { return blocked_[index]; }
  /// Cells that became blocked or free since the last call.
  [[nodiscard]] std::optional<CellRectangle> take_changes();

 private:
  void mark(Point2 robot, std::span<const Segment> lines, std::span<const LaserLook> lasers, Time now);
  void free(Point2 robot, std::span<const Segment> lines);
  void set(CellIndex cell, int strength);

  GridFrame frame_;
  SightLayerParams params_;
  std::vector<bool> known_;
  std::vector<std::int8_t> strength_;  ///< messages that say so, 0 .. `looks`
  std::vector<bool> blocked_;          ///< from `looks` on, until 0
  std::vector<Time> seen_;             ///< last
  std::vector<std::uint32_t> shown_;   ///< the last message that showed the cell
  std::vector<std::size_t> marked_{};  ///< cells with strength
  std::uint32_t message_ = 0;
  std::optional<CellRectangle> changes_;
};

}  // namespace docent::mapping
