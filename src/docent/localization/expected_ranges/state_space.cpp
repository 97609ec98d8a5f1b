#include "docent/localization/expected_ranges/state_space.h"

#include <cmath>
#include <numbers>

namespace docent::localization {

Result<void> StateSpaceParams::validate() const {
  if (!(cell_size >= 0.02 && cell_size <= 2.0)) return fail("states.cell_size must be 0.02..2 m");
  const double headings = 360.0 / heading_step;
  if (!(heading_step >= 0.5 && heading_step <= 30.0) || std::abs(headings - std::round(headings)) > 1e-9)
    return fail("states.heading_step must be 0.5..30 degrees and divide 360");
  if (!(min_clearance >= 0.0)) return fail("states.min_clearance must be >= 0");
  if (!(wall_depth >= 0.0 && wall_depth <= 1.0)) return fail("states.wall_depth must be 0..1 m");
  return {};
}

StateSpace::StateSpace(const OccupancyGrid& map, const sensor_models::RayCaster& caster, const StateSpaceParams& params)
    : headings_{static_cast<int>(std::lround(360.0 / params.heading_step))} {
  frame_.resolution = params.cell_size;
  frame_.origin = map.frame.origin;
  frame_.columns = static_cast<int>(std::ceil(map.frame.columns * map.frame.resolution / params.cell_size - 1e-9));
  frame_.rows = static_cast<int>(std::ceil(map.frame.rows * map.frame.resolution / params.cell_size - 1e-9));
  place_of_cell_.assign(frame_.size(), kNoPlace);
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const CellIndex cell{column, row};
      const Point2 middle = frame_.centre(cell);
      if (!map.is_free(map.frame.cell_at(middle)) || caster.clearance(middle) < params.min_clearance) continue;
      place_of_cell_[frame_.index(cell)] = static_cast<std::int32_t>(cells_.size());
      cells_.push_back(cell);
    }
  }
}

double StateSpace::heading_step() const { return 2.0 * std::numbers::pi / headings_; }

}  // namespace docent::localization
