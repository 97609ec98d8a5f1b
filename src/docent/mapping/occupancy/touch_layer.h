#pragma once

#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/occupancy/cell_rectangle.h"

namespace docent::mapping {

/// Part `touch` of section `map` of robot.yaml.
struct TouchLayerParams {
  double radius = 0.4;   ///< [m] > 0: what nothing but touch finds is believed to be so large
  double seen = 0.3;     ///< [m] >= 0: a laser's point so near is what touches, and moves by itself
  double forget = 1800;  ///< [s] > 0 until the place is tried again
  template <class V>
  void visit(V& v) {
    v("radius", radius);
    v("seen", seen);
    v("forget", forget);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where the body was touched by what no other sensor sees. A touch tells of one point of the thing and of no more, so
/// a disc is blocked that begins at the touched place of the outline and lies beyond it. Nothing but the body itself
/// can tell that the place is free: it stands there, untouched.
class TouchLayer {
 public:
  /// @param known  [rows * columns] cells where a touch is no news: near a mapped wall or hazard
  TouchLayer(const GridFrame& frame, std::vector<bool> known, const TouchLayerParams& params);

  /// @param at  [m], map: the touched place of the outline; @param outward  unit vector, map: from the body's centre
  void feel(Point2 at, Point2 outward, Time now);
  /// The body stands here: what lies within `radius` [m] of its centre is free.
  void stand(Point2 centre, double radius);
  /// O(cells).
  void forget(Time now);

  [[nodiscard]] bool is_blocked(std::size_t index) const { return touched_[index].has_value(); }
  /// Cells that became blocked or free since the last call.
  [[nodiscard]] std::optional<CellRectangle> take_changes();

 private:
  template <class Change>
  void change_within(Point2 centre, double radius, const Change& change);
  void set(CellIndex cell, std::optional<Time> touched);

  GridFrame frame_;
  TouchLayerParams params_;
  std::vector<bool> known_;
  std::vector<std::optional<Time>> touched_;  ///< [rows * columns] when last; nullopt: free
  std::optional<CellRectangle> changes_;
};

}  // namespace docent::mapping
