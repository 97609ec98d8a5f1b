#include "docent/mapping/scan_matching/surface_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::mapping {
namespace {

constexpr double kCell = 0.05;  // [m]

}  // namespace

SurfaceIndex::SurfaceIndex(std::span<const SurfacePoint> points) : points_(points.begin(), points.end()) {
  Point2 low = points.front().at;
  Point2 high = low;
  for (const SurfacePoint& p : points) {
    low = {std::min(low.x, p.at.x), std::min(low.y, p.at.y)};
    high = {std::max(high.x, p.at.x), std::max(high.y, p.at.y)};
  }
  frame_.resolution = kCell;
  frame_.origin = {low.x - kReach, low.y - kReach};
  frame_.columns = static_cast<int>(std::ceil((high.x + kReach - frame_.origin.x) / kCell)) + 1;
  frame_.rows = static_cast<int>(std::ceil((high.y + kReach - frame_.origin.y) / kCell)) + 1;
  nearest_.assign(frame_.size(), kNone);
  std::vector<float> squared(frame_.size(), std::numeric_limits<float>::infinity());
  const int reach = static_cast<int>(std::ceil(kReach / kCell));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const CellIndex centre = frame_.cell_at(points_[i].at);
    for (int row = std::max(0, centre.row - reach); row <= std::min(frame_.rows - 1, centre.row + reach); ++row) {
      for (int column = std::max(0, centre.column - reach);
           column <= std::min(frame_.columns - 1, centre.column + reach); ++column) {
        const std::size_t cell = frame_.index({column, row});
        const Point2 away = frame_.centre({column, row}) - points_[i].at;
        const auto d = static_cast<float>(dot(away, away));
        if (d < squared[cell] && d <= kReach * kReach) {
          squared[cell] = d;
          nearest_[cell] = static_cast<std::int32_t>(i);
        }
      }
    }
  }
}

const SurfacePoint* SurfaceIndex::nearest(Point2 at) const {
  const CellIndex cell = frame_.cell_at(at);
  if (!frame_.holds(cell)) return nullptr;
  const std::int32_t i = nearest_[frame_.index(cell)];
  return i == kNone ? nullptr : &points_[static_cast<std::size_t>(i)];
}

}  // namespace docent::mapping
