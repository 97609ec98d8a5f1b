#include "docent/simulator/traced/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::simulator {
namespace {

// Directions along the sides of cells: east, north, west, south.
constexpr std::array<CellIndex, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Sides of cells between set and clear, as steps from lattice corner to lattice corner with the set cell on the left.
class Cracks {
 public:
  Cracks(const GridFrame& frame, const std::vector<bool>& cells) : frame_{frame}, cells_{cells} {
    done_.assign(4 * static_cast<std::size_t>(frame.columns + 1) * static_cast<std::size_t>(frame.rows + 1), false);
  }

  [[nodiscard]] bool is_crack(CellIndex corner, std::size_t direction) const {
    // Cells to the left and to the right of the step, as offsets of their index from the corner's.
    constexpr std::array<CellIndex, 4> kLeft{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    constexpr std::array<CellIndex, 4> kRight{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
    return is_set(corner, kLeft[direction]) && !is_set(corner, kRight[direction]);
  }
  [[nodiscard]] bool is_done(CellIndex corner, std::size_t direction) const { return done_[slot(corner, direction)]; }

  /// The outline that begins with this crack.
  Polygon follow(CellIndex corner, std::size_t direction) {
    Polygon outline;
    std::size_t last = 4;
    while (!is_done(corner, direction)) {
      done_[slot(corner, direction)] = true;
      if (direction != last) outline.push_back(point(corner));
      last = direction;
      corner = {corner.column + kSteps[direction].column, corner.row + kSteps[direction].row};
      for (const std::size_t turn : {1U, 0U, 3U}) {
        const std::size_t next = (direction + turn) % 4;
        if (!is_crack(corner, next)) continue;
        direction = next;
        break;
      }
    }
    return outline;
  }

 private:
  [[nodiscard]] bool is_set(CellIndex corner, CellIndex offset) const {
    const CellIndex cell{corner.column + offset.column, corner.row + offset.row};
    return frame_.holds(cell) && cells_[frame_.index(cell)];
  }
  [[nodiscard]] std::size_t slot(CellIndex corner, std::size_t direction) const {
    const auto width = static_cast<std::size_t>(frame_.columns + 1);
    return 4 * (static_cast<std::size_t>(corner.row) * width + static_cast<std::size_t>(corner.column)) + direction;
  }
  [[nodiscard]] Point2 point(CellIndex corner) const {
    return to_millimetre(frame_.origin + Point2{corner.column * frame_.resolution, corner.row * frame_.resolution});
  }

  const GridFrame& frame_;
  const std::vector<bool>& cells_;
  std::vector<bool> done_;
};

/// Marks the corners between `first` and `last` that must stay.
void keep_between(const Polygon& outline, std::size_t first, std::size_t last, double tolerance,
                  std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> spans{{first, last}};
  while (!spans.empty()) {
    const auto [from, to] = spans.back();
    spans.pop_back();
    const Segment chord{outline[from], outline[to % outline.size()]};
    double farthest = tolerance;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double away = distance(chord, outline[i]);
      if (away <= farthest) continue;
      farthest = away;
      at = i;
    }
    if (at == from) continue;
    kept[at] = true;
    spans.emplace_back(from, at);
    spans.emplace_back(at, to);
  }
}

/// Corners on both of which the outline is farthest from its first one: no line of it can be straight across them.
Polygon reduced(const Polygon& outline, double tolerance) {
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    if (distance(outline[i], outline[0]) > distance(outline[opposite], outline[0])) opposite = i;
  }
  std::vector<bool> kept(outline.size(), false);
  kept[0] = kept[opposite] = true;
  keep_between(outline, 0, opposite, tolerance, kept);
  keep_between(outline, opposite, outline.size(), tolerance, kept);
  Polygon result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (kept[i]) result.push_back(outline[i]);
  }
  return result;
}

}  // namespace

Point2 to_millimetre(Point2 point) {
  return {std::round(point.x * 1000.0) / 1000.0, std::round(point.y * 1000.0) / 1000.0};
}

void join_corners(const GridFrame& frame, std::vector<bool>& cells) {
  for (bool changed = true; changed;) {
    changed = false;
    for (int row = 0; row + 1 < frame.rows; ++row) {
      for (int column = 0; column + 1 < frame.columns; ++column) {
        const std::size_t a = frame.index({column, row});
        const std::size_t b = frame.index({column + 1, row});
        const std::size_t c = frame.index({column, row + 1});
        const std::size_t d = frame.index({column + 1, row + 1});
        if (cells[a] != cells[d] || cells[b] != cells[c] || cells[a] == cells[b]) continue;
        cells[a] = cells[b] = cells[c] = cells[d] = true;
        changed = true;
      }
    }
  }
}

std::vector<Polygon> trace_outlines(const GridFrame& frame, const std::vector<bool>& cells) {
  Cracks cracks{frame, cells};
  std::vector<Polygon> outlines;
  for (int row = 0; row <= frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex corner{column, row};
      // Every outline has a step east with the region above it, or west with the region below it.
      if (cracks.is_crack(corner, 0) && !cracks.is_done(corner, 0)) outlines.push_back(cracks.follow(corner, 0));
    }
  }
  return outlines;
}

Polygon simplified(const Polygon& outline, double tolerance) {
  constexpr double kLeastTolerance = 1e-3;  // [m]
  for (; tolerance > kLeastTolerance; tolerance *= 0.5) {
    Polygon result = reduced(outline, tolerance);
    if (result.size() >= 3 && is_simple(result) && signed_area(result) * signed_area(outline) > 0.0) return result;
  }
  return outline;
}

}  // namespace docent::simulator
