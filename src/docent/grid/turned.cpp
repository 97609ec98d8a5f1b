#include "docent/grid/turned.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent {

OccupancyGrid turned(const OccupancyGrid& map, double angle) {
  const GridFrame& frame = map.frame;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const auto forth = [&](Point2 at) { return Point2{cosine * at.x - sine * at.y, sine * at.x + cosine * at.y}; };
  const auto back = [&](Point2 at) { return Point2{cosine * at.x + sine * at.y, cosine * at.y - sine * at.x}; };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point2 least{kInfinity, kInfinity}, most{-kInfinity, -kInfinity};
  for (const double x : {0.0, frame.columns * frame.resolution}) {
    for (const double y : {0.0, frame.rows * frame.resolution}) {
      const Point2 corner = forth({frame.origin.x + x, frame.origin.y + y});
      least = {std::min(least.x, corner.x), std::min(least.y, corner.y)};
      most = {std::max(most.x, corner.x), std::max(most.y, corner.y)};
    }
  }
  constexpr double kRest = 1e-6;  // [cells] of rounding: a quarter turn needs no cell more
  const auto cells_of = [&](double length) { return static_cast<int>(std::ceil(length / frame.resolution - kRest)); };
  OccupancyGrid to;
  to.frame = {cells_of(most.x - least.x), cells_of(most.y - least.y), frame.resolution, least};
  to.cells.resize(to.frame.size());
  for (int row = 0; row < to.frame.rows; ++row) {
    for (int column = 0; column < to.frame.columns; ++column)
      to.cells[to.frame.index({column, row})] = map.at(frame.cell_at(back(to.frame.centre({column, row}))));
  }
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex at = to.frame.cell_at(forth(frame.centre({column, row})));
      if (map.is_occupied({column, row}) && to.frame.holds(at)) to.cells[to.frame.index(at)] = map.at({column, row});
    }
  }
  return to;
}

}  // namespace docent
