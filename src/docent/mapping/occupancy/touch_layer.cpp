#include "docent/mapping/occupancy/touch_layer.h"

#include <utility>

namespace docent::mapping {

Result<void> TouchLayerParams::validate() const {
  if (!(radius > 0.0)) return fail("radius must be > 0");
  if (!(seen >= 0.0)) return fail("seen must be >= 0");
  if (!(forget > 0.0)) return fail("forget must be > 0");
  return {};
}

TouchLayer::TouchLayer(const GridFrame& frame, std::vector<bool> known, const TouchLayerParams& params)
    : frame_{frame}, params_{params}, known_{std::move(known)}, touched_(frame.size()) {}

template <class Change>
void TouchLayer::change_within(Point2 centre, double radius, const Change& change) {
  const CellIndex low = frame_.cell_at(centre - Point2{radius, radius});
  const CellIndex high = frame_.cell_at(centre + Point2{radius, radius});
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      const CellIndex cell{column, row};
      if (frame_.holds(cell) && distance(frame_.centre(cell), centre) <= radius) change(cell);
    }
  }
}

void TouchLayer::set(CellIndex cell, std::optional<Time> touched) {
  auto& before = touched_[frame_.index(cell)];
  if (before.has_value() != touched.has_value()) widen(changes_, cell);
  before = touched;
}

void TouchLayer::feel(Point2 at, Point2 outward, Time now) {
  const CellIndex touched = frame_.cell_at(at);
  if (!frame_.holds(touched) || known_[frame_.index(touched)]) return;
  change_within(at + params_.radius * outward, params_.radius, [&](CellIndex cell) { set(cell, now); });
}

void TouchLayer::stand(Point2 centre, double radius) {
  change_within(centre, radius, [&](CellIndex cell) { set(cell, std::nullopt); });
}

void TouchLayer::forget(Time now) {
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const auto& touched = touched_[frame_.index({column, row})];
      if (touched && to_seconds(now - *touched) >= params_.forget) set({column, row}, std::nullopt);
    }
  }
}

std::optional<CellRectangle> TouchLayer::take_changes() { return std::exchange(changes_, std::nullopt); }

}  // namespace docent::mapping
