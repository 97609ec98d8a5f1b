#include "docent/mapping/scan_matching/match_grid.h"

#include <algorithm>
#include <cmath>

namespace docent::mapping {
namespace {

constexpr double kBlurReach = 3.0;  ///< sigmas; beyond it less than 3 of 255

GridFrame frame_about(std::span<const Point2> points, double margin, double low_margin, double resolution) {
  Point2 low = points.front();
  Point2 high = points.front();
  for (const Point2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  GridFrame frame;
  frame.resolution = resolution;
  frame.origin = {low.x - margin - low_margin, low.y - margin - low_margin};
  frame.columns = static_cast<int>(std::ceil((high.x + margin - frame.origin.x) / resolution)) + 1;
  frame.rows = static_cast<int>(std::ceil((high.y + margin - frame.origin.y) / resolution)) + 1;
  return frame;
}

}  // namespace

MatchGrid::MatchGrid(std::span<const Point2> points, const MatchGridParams& params) {
  // A square that begins left of all points may still reach one.
  const double widest = static_cast<double>(1 << (params.levels - 1)) * params.resolution;
  frame_ = frame_about(points, kBlurReach * params.sigma, widest, params.resolution);
  levels_.emplace_back(frame_.size(), std::uint8_t{0});
  blur(points, params.sigma);
  for (int level = 1; level < params.levels; ++level) add_level(1 << (level - 1));
}

void MatchGrid::blur(std::span<const Point2> points, double sigma) {
  const int reach = static_cast<int>(std::ceil(kBlurReach * sigma / frame_.resolution));
  const double in_cells = sigma / frame_.resolution;
  std::vector<std::uint8_t> kernel;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const double squared = static_cast<double>(row * row + column * column) / (in_cells * in_cells);
      kernel.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * squared))));
    }
  }
  std::vector<std::uint8_t>& values = levels_.front();
  for (const Point2 p : points) {
    const CellIndex centre = frame_.cell_at(p);
    if (values[frame_.index(centre)] == 255) continue;
    std::size_t k = 0;
    for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
      for (int column = centre.column - reach; column <= centre.column + reach; ++column, ++k) {
        if (!frame_.holds({column, row})) continue;
        std::uint8_t& value = values[frame_.index({column, row})];
        value = std::max(value, kernel[k]);
      }
    }
  }
}

void MatchGrid::add_level(int step) {
  const std::vector<std::uint8_t>& finer = levels_.back();
  const auto columns = static_cast<std::size_t>(frame_.columns);
  const auto rows = static_cast<std::size_t>(frame_.rows);
  const auto shift = static_cast<std::size_t>(step);
  std::vector<std::uint8_t> wide(finer);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c + shift < columns; ++c) {
      wide[row * columns + c] = std::max(finer[row * columns + c], finer[row * columns + c + shift]);
    }
  }
  std::vector<std::uint8_t> square(wide);
  for (std::size_t i = 0; i + shift * columns < square.size(); ++i) {
    square[i] = std::max(wide[i], wide[i + shift * columns]);
  }
  levels_.push_back(std::move(square));
}

}  // namespace docent::mapping
