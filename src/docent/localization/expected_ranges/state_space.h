#pragma once

#include <cstdint>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// The cells of the belief.
struct StateSpaceParams {
  double cell_size = 0.15;      ///< [m], > 0
  double heading_step = 2.0;    ///< [deg], a divisor of 360
  double min_clearance = 0.10;  ///< [m], >= 0: nearer to an occupied cell's centre the robot's centre cannot be
  /// [m] by which walls are peeled before ranges are expected: learned maps have fat walls. The rest of half a map
  /// cell, where surfaces lie on average, always comes on top.
  double wall_depth = 0.0;
  template <class V>
  void visit(V& v) {
    v("wall_depth", wall_depth);
    v("cell_size", cell_size);
    v("heading_step", heading_step);
    v("min_clearance", min_clearance);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The states of grid Markov localization: (place, heading), where a place is a cell of the position grid whose middle
/// is free in the map [Markov1998] 3. Heading h is h * 2 pi / headings.
class StateSpace {
 public:
  static constexpr std::int32_t kNoPlace = -1;

  /// @pre params are valid
  StateSpace(const OccupancyGrid& map, const sensor_models::RayCaster& caster, const StateSpaceParams& params);

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] int headings() const { return headings_; }
  [[nodiscard]] double heading_step() const;  ///< [rad]
  [[nodiscard]] std::size_t places() const { return cells_.size(); }
  [[nodiscard]] std::size_t states() const { return cells_.size() * static_cast<std::size_t>(headings_); }
  [[nodiscard]] CellIndex cell(std::size_t place) const { return cells_[place]; }
  [[nodiscard]] Point2 centre(std::size_t place) const { return frame_.centre(cells_[place]); }
  [[nodiscard]] std::int32_t place_at(CellIndex cell) const {
    return frame_.holds(cell) ? place_of_cell_[frame_.index(cell)] : kNoPlace;
  }

 private:
  GridFrame frame_;
  int headings_;
  std::vector<CellIndex> cells_;             ///< of each place, row by row
  std::vector<std::int32_t> place_of_cell_;  ///< [rows * columns]
};

}  // namespace docent::localization
