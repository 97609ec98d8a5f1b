#include "docent/telepresence/belief_raster.h"

#include <algorithm>
#include <cmath>

namespace docent::telepresence {
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

/// Where the belief has mass; empty while `low` lies beyond `high`.
struct Box {
  Point2 low{INFINITY, INFINITY};
  Point2 high{-INFINITY, -INFINITY};

  void include(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    low = {std::min(low.x, x), std::min(low.y, y)};
    high = {std::max(high.x, x), std::max(high.y, y)};
  }
};

/// Calls f(corner, mass) for each coarse cell that has some.
template <class F>
void for_each_coarse(const docent_msgs::CoarseBelief& rest, F&& f) {
  for (std::size_t i = 0; i < rest.mass.size(); ++i) {
    if (!(rest.mass[i] > 0)) continue;
    f(Point2{rest.origin_x + static_cast<double>(i % rest.columns) * rest.cell_size,
             rest.origin_y + static_cast<double>(i / rest.columns) * rest.cell_size},
      rest.mass[i]);
  }
}

/// A localized robot's last half per cent would only blow up the box.
bool shows(const docent_msgs::CoarseBelief& rest) {
  if (!is_sane(rest)) return false;
  double total = 0.0;
  for (const float mass : rest.mass) total += mass > 0 ? mass : 0.0F;
  return total > 0.02;
}

/// Aligned with multiples of the cell, so that the picture does not crawl from one belief to the next; the cell is
/// doubled until there are few enough.
Field field_over(const Box& box, double cell, int max_cells) {
  Field field{};
  for (;; cell *= 2.0) {
    const double left = std::floor(box.low.x / cell - 1.0);
    const double bottom = std::floor(box.low.y / cell - 1.0);
    field.columns = static_cast<int>(std::floor(box.high.x / cell) - left) + 2;
    field.rows = static_cast<int>(std::floor(box.high.y / cell) - bottom) + 2;
    field.origin = {left * cell, bottom * cell};
    field.cell = cell;
    if (static_cast<double>(field.columns) * field.rows <= max_cells) break;
  }
  field.mass.assign(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), 0.0);
  return field;
}

}  // namespace

BeliefRaster belief_raster(const docent_msgs::Belief& belief, double cell, int max_cells) {
  const auto& rest = belief.rest;
  const bool shows_rest = shows(rest);
  Box box;
  for (const auto& entry : belief.cells) {
    if (entry.mass > 0) box.include(entry.x, entry.y);
  }
  if (shows_rest) {
    for_each_coarse(rest, [&](Point2 corner, float /*mass*/) {
      box.include(corner.x, corner.y);
      box.include(corner.x + rest.cell_size * 0.999, corner.y + rest.cell_size * 0.999);
    });
  }
  BeliefRaster raster;
  if (!(box.low.x <= box.high.x) || box.high.x - box.low.x > 10000 || box.high.y - box.low.y > 10000) return raster;

  Field field = field_over(box, cell, max_cells);
  for (const auto& entry : belief.cells) {
    if (entry.mass > 0) field.add({entry.x, entry.y}, entry.mass);
  }
  if (shows_rest) {
    const int parts = std::max(1, static_cast<int>(std::lround(static_cast<double>(rest.cell_size) / field.cell)));
    const double step = static_cast<double>(rest.cell_size) / parts;
    for_each_coarse(rest, [&](Point2 corner, float mass) {
      for (int k = 0; k < parts * parts; ++k) {
        field.add({corner.x + (k % parts + 0.5) * step, corner.y + (k / parts + 0.5) * step},
                  static_cast<double>(mass) / (parts * parts));
      }
    });
  }
  const double largest = *std::max_element(field.mass.begin(), field.mass.end());
  if (!(largest > 0.0)) return raster;
  raster.origin = field.origin;
  raster.cell = field.cell;
  raster.columns = field.columns;
  raster.rows = field.rows;
  raster.levels.reserve(field.mass.size());
  for (const double mass : field.mass) {
    raster.levels.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(mass / largest))));
  }
  return raster;
}

}  // namespace docent::telepresence
