#include "docent/telepresence/belief_raster.h"

#include <algorithm>
#include <cmath>

namespace docent {
namespace {

/// Mass on a grid that covers a box.
struct Field {
  Point2 origin;
  double cell;
  int columns;
  int rows;
  std::vector<double> mass;

  void add(Point2 at, double amount) {
    const int column = static_cast<int>(std::floor((at.x - origin.x) / cell));
    const int row = static_cast<int>(std::floor((at.y - origin.y) / cell));
    if (column < 0 || row < 0 || column >= columns || row >= rows) return;
    mass[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] +=
        amount;
  }
};

bool is_sane(const docent_msgs::CoarseBelief& rest) {
  return rest.cell_size > 0 && std::isfinite(rest.cell_size) && std::isfinite(rest.origin_x) &&
         std::isfinite(rest.origin_y) && rest.columns <= 4096 && rest.rows <= 4096 &&
         rest.mass.size() == static_cast<std::size_t>(rest.columns) * rest.rows;
}

}  // namespace

BeliefRaster belief_raster(const docent_msgs::Belief& belief, double cell, int max_cells) {
  Point2 low{INFINITY, INFINITY};
  Point2 high{-INFINITY, -INFINITY};
  const auto include = [&](double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    low = {std::min(low.x, x), std::min(low.y, y)};
    high = {std::max(high.x, x), std::max(high.y, y)};
  };
  for (const auto& entry : belief.cells) {
    if (entry.mass > 0) include(entry.x, entry.y);
  }
  const auto& rest = belief.rest;
  const bool has_rest = is_sane(rest);
  const auto corner = [&rest](std::size_t column, std::size_t row) {
    return Point2{rest.origin_x + static_cast<double>(column) * rest.cell_size,
                  rest.origin_y + static_cast<double>(row) * rest.cell_size};
  };
  double rest_total = 0.0;
  for (std::size_t i = 0; has_rest && i < rest.mass.size(); ++i) {
    if (!(rest.mass[i] > 0)) continue;
    rest_total += rest.mass[i];
  }
  const bool shows_rest = rest_total > 0.02;  // a localized robot's last half per cent would only blow up the box
  for (std::size_t i = 0; shows_rest && i < rest.mass.size(); ++i) {
    if (!(rest.mass[i] > 0)) continue;
    const Point2 a = corner(i % rest.columns, i / rest.columns);
    include(a.x, a.y);
    include(a.x + rest.cell_size * 0.999, a.y + rest.cell_size * 0.999);
  }
  BeliefRaster raster;
  if (!(low.x <= high.x) || high.x - low.x > 10000 || high.y - low.y > 10000) return raster;

  // Aligned with multiples of the cell, so that the picture does not crawl from one belief to the next.
  Field field{};
  for (;; cell *= 2.0) {
    const double left = std::floor(low.x / cell - 1.0);
    const double bottom = std::floor(low.y / cell - 1.0);
    field.columns = static_cast<int>(std::floor(high.x / cell) - left) + 2;
    field.rows = static_cast<int>(std::floor(high.y / cell) - bottom) + 2;
    field.origin = {left * cell, bottom * cell};
    field.cell = cell;
    if (static_cast<double>(field.columns) * field.rows <= max_cells) break;
  }
  field.mass.assign(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), 0.0);
  for (const auto& entry : belief.cells) {
    if (entry.mass > 0) field.add({entry.x, entry.y}, entry.mass);
  }
  for (std::size_t i = 0; shows_rest && i < rest.mass.size(); ++i) {
    if (!(rest.mass[i] > 0)) continue;
    const Point2 a = corner(i % rest.columns, i / rest.columns);
    const int parts = std::max(1, static_cast<int>(std::lround(static_cast<double>(rest.cell_size) / cell)));
    const double step = static_cast<double>(rest.cell_size) / parts;
    for (int k = 0; k < parts * parts; ++k) {
      field.add({a.x + (k % parts + 0.5) * step, a.y + (k / parts + 0.5) * step},
                static_cast<double>(rest.mass[i]) / (parts * parts));
    }
  }
  const double largest = *std::max_element(field.mass.begin(), field.mass.end());
  if (!(largest > 0.0)) return raster;
  raster.origin = field.origin;
  raster.cell = cell;
  raster.columns = field.columns;
  raster.rows = field.rows;
  raster.levels.reserve(field.mass.size());
  for (const double mass : field.mass) {
    raster.levels.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(mass / largest))));
  }
  return raster;
}

}  // namespace docent
