#include "docent/planning/exploration/standing_room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::planning {
namespace {

constexpr float kOutside = -1.0F;  // [m]

/// Where a row of cells crosses the outline, from left to right: it is inside between the first and the second.
std::vector<double> crossings(const std::vector<Segment>& sides, double y) {
  std::vector<double> at;
  for (const Segment& side : sides) {
    if ((side.a.y > y) == (side.b.y > y)) continue;
    at.push_back(side.a.x + (y - side.a.y) / (side.b.y - side.a.y) * (side.b.x - side.a.x));
  }
  std::sort(at.begin(), at.end());
  return at;
}

}  // namespace

StandingRoom::StandingRoom(const OccupancyGrid& map, const Polygon& area, double reach) : frame_{map.frame} {
  std::vector<bool> solid(frame_.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = map.cells[i] >= 65;
  walls_ = distance_transform(frame_, solid);
  if (!area.empty()) measure_border(area, reach);
}

void StandingRoom::measure_border(const Polygon& area, double reach) {
  border_.assign(frame_.size(), kOutside);
  const std::vector<Segment> outline = sides(area);
  const auto column_after = [&](double x) {  // the first whose middle lies there or to the right
    const double column = std::ceil((x - frame_.origin.x) / frame_.resolution - 0.5);
    return static_cast<std::size_t>(std::clamp(column, 0.0, static_cast<double>(frame_.columns)));
  };
  for (int row = 0; row < frame_.rows; ++row) {
    const std::vector<double> at = crossings(outline, frame_.centre({0, row}).y);
    float* cells = border_.data() + frame_.index({0, row});
    for (std::size_t i = 0; i + 1 < at.size(); i += 2)
      std::fill(cells + column_after(at[i]), cells + column_after(at[i + 1]), static_cast<float>(reach));
  }
  for (const Segment& side : outline) {
    const CellIndex low = frame_.cell_at({std::min(side.a.x, side.b.x) - reach, std::min(side.a.y, side.b.y) - reach});
    const CellIndex high = frame_.cell_at({std::max(side.a.x, side.b.x) + reach, std::max(side.a.y, side.b.y) + reach});
    for (int row = std::max(0, low.row); row <= std::min(frame_.rows - 1, high.row); ++row) {
      for (int column = std::max(0, low.column); column <= std::min(frame_.columns - 1, high.column); ++column) {
        float& there = border_[frame_.index({column, row})];
        if (there > 0.0F) there = std::min(there, static_cast<float>(distance(side, frame_.centre({column, row}))));
      }
    }
  }
}

StandingRoom::Place StandingRoom::best_in(CellIndex coarse, int coarsening, double beyond) const {
  constexpr double kPlenty = 0.6;  // [m] from walls: no matter where in the cell
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Place best{{}, -1.0, -1.0};
  double most = -kInfinity;
  double least = kInfinity;
  for (int row = coarse.row * coarsening; row < std::min(frame_.rows, (coarse.row + 1) * coarsening); ++row) {
    for (int column = coarse.column * coarsening; column < std::min(frame_.columns, (coarse.column + 1) * coarsening);
         ++column) {
      const std::size_t i = frame_.index({column, row});
      const auto walls = static_cast<double>(walls_[i]);
      const double border = border_.empty() ? kInfinity : static_cast<double>(border_[i]);
      const double room = std::min(walls, border + beyond);
      least = std::min(least, room);
      if (room > most) {
        most = room;
        best = {frame_.centre({column, row}), walls, border};
      }
    }
  }
  if (least >= kPlenty) {
    const double width = coarsening * frame_.resolution;
    best.at = {frame_.origin.x + (coarse.column + 0.5) * width, frame_.origin.y + (coarse.row + 0.5) * width};
  }
  return best;
}

}  // namespace docent::planning
