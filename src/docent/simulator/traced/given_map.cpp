#include "docent/simulator/traced/given_map.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

/// `frame`, made larger by whole cells until it holds `other`.
GridFrame grown_to(const GridFrame& frame, const GridFrame& other) {
  const auto cells = [&](double length) {
    return std::max(0, static_cast<int>(std::ceil(length / frame.resolution - 1e-6)));
  };
  const auto end = [](const GridFrame& of) {
    return Point2{of.origin.x + of.columns * of.resolution, of.origin.y + of.rows * of.resolution};
  };
  const int left = cells(frame.origin.x - other.origin.x), below = cells(frame.origin.y - other.origin.y);
  const int right = cells(end(other).x - end(frame).x), above = cells(end(other).y - end(frame).y);
  GridFrame grown = frame;
  grown.columns += left + right;
  grown.rows += below + above;
  grown.origin = frame.origin - Point2{left * frame.resolution, below * frame.resolution};
  return grown;
}

}  // namespace

OccupancyGrid with_given_map(const OccupancyGrid& given, const GridFrame& traced, const std::vector<bool>& building,
                             const OccupancyGrid& surveyed) {
  OccupancyGrid map;
  map.frame = grown_to(surveyed.frame, given.frame);
  map.cells.resize(map.frame.size());
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const Point2 centre = map.frame.centre({column, row});
      const CellIndex in_traced = traced.cell_at(centre);
      const bool is_within = traced.holds(in_traced) && building[traced.index(in_traced)];
      const OccupancyGrid& from = is_within ? surveyed : given;
      map.cells[map.frame.index({column, row})] = from.at(from.frame.cell_at(centre));
    }
  }
  return map;
}

}  // namespace docent::simulator
