#include "docent/simulator/world/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace docent::simulator {
namespace {

struct Bounds {
  Point2 low;
  Point2 high;
};

void extend(Bounds& bounds, const Polygon& polygon) {
  for (const Point2 p : polygon) {
    bounds.low = {std::min(bounds.low.x, p.x), std::min(bounds.low.y, p.y)};
    bounds.high = {std::max(bounds.high.x, p.x), std::max(bounds.high.y, p.y)};
  }
}

Bounds bounds_of(const Polygon& polygon) {
  Bounds bounds{polygon.front(), polygon.front()};
  extend(bounds, polygon);
  return bounds;
}

Polygon shifted(const Polygon& polygon, Point2 by) {
  Polygon result;
  for (const Point2 corner : polygon) result.push_back(corner + by);
  return result;
}

Point2 any_shift(Rng& rng, double least, double greatest) {
  return rng.uniform(least, greatest) * unit(Angle::radians(rng.uniform(-std::numbers::pi, std::numbers::pi)));
}

/// Calls f(index) for each cell whose centre lies within `reach` of the polygon.
template <class F>
void for_cells(const GridFrame& frame, const Polygon& polygon, double reach, F&& f) {
  const Bounds bounds = bounds_of(polygon);
  const CellIndex first = frame.cell_at(bounds.low - Point2{reach, reach});
  const CellIndex last = frame.cell_at(bounds.high + Point2{reach, reach});
  for (int row = std::max(0, first.row); row <= std::min(frame.rows - 1, last.row); ++row) {
    for (int column = std::max(0, first.column); column <= std::min(frame.columns - 1, last.column); ++column) {
      const CellIndex cell{column, row};
      if (distance(polygon, frame.centre(cell)) <= reach) f(frame.index(cell));
    }
  }
}

/// Calls f(index) for each cell whose centre lies inside the polygon. O(rows * corners + cells inside).
template <class F>
void for_cells_inside(const GridFrame& frame, const Polygon& polygon, F&& f) {
  std::vector<double> crossings;
  for (int row = 0; row < frame.rows; ++row) {
    const double y = frame.centre({0, row}).y;
    crossings.clear();
    for (const auto& [b, a] : sides(polygon)) {
      if ((a.y > y) != (b.y > y)) crossings.push_back((b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x);
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int first = std::max(0, frame.cell_at({crossings[i], y}).column);
      const int last = std::min(frame.columns - 1, frame.cell_at({crossings[i + 1], y}).column);
      for (int column = first; column <= last; ++column) {
        const double x = frame.centre({column, row}).x;
        if (x >= crossings[i] && x < crossings[i + 1]) f(frame.index({column, row}));
      }
    }
  }
}

/// A polygon that holds another needs no hazard for it: the podium under a glass case.
bool covers(const Polygon& outer, const Polygon& inner) {
  return std::all_of(inner.begin(), inner.end(), [&](Point2 corner) { return distance(outer, corner) < 0.02; });
}

bool is_covered_by_hazard(const World& world, const Solid& solid) {
  return std::any_of(world.solids.begin(), world.solids.end(), [&](const Solid& other) {
    const bool hazard = other.kind == SolidKind::glass || other.kind == SolidKind::plate;
    return hazard && &other != &solid && covers(other.polygon, solid.polygon);
  });
}

/// Low furniture has no kind of its own among hazards.
std::string hazard_kind(SolidKind kind) { return kind == SolidKind::furniture ? "other" : to_string(kind); }

enum class Fate { stays, moved, missing };

/// One fate per solid. With three movable pieces or more at least one is moved and at least one is missing.
std::vector<Fate> draw_fates(const World& world, const SurveyParams& params, Rng rng) {
  std::vector<Fate> fates(world.solids.size(), Fate::stays);
  std::vector<std::size_t> movable;
  for (std::size_t i = 0; i < world.solids.size(); ++i) {
    if (world.solids[i].movable && is_seen_by_laser(world.solids[i])) movable.push_back(i);
  }
  for (std::size_t i = movable.size(); i > 1; --i) {
    std::swap(movable[i - 1], movable[static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(i) - 1))]);
  }
  const auto share = [&](double of) {
    const auto count = static_cast<std::size_t>(std::lround(of * static_cast<double>(movable.size())));
    return movable.size() >= 3 && of > 0.0 ? std::max<std::size_t>(1, count) : count;
  };
  const std::size_t moved = std::min(movable.size(), share(params.moved_share));
  const std::size_t missing = std::min(movable.size() - moved, share(params.missing_share));
  for (std::size_t i = 0; i < moved; ++i) fates[movable[i]] = Fate::moved;
  for (std::size_t i = moved; i < moved + missing; ++i) fates[movable[i]] = Fate::missing;
  return fates;
}

}  // namespace

Survey survey(const World& world, const SurveyParams& params, const Rng& rng) {
  Bounds bounds = bounds_of(world.floor);
  for (const Solid& solid : world.solids) extend(bounds, solid.polygon);
  const double r = params.resolution;
  const double left = std::floor((bounds.low.x - params.margin) / r);
  const double bottom = std::floor((bounds.low.y - params.margin) / r);
  Survey result;
  GridFrame& frame = result.map.frame;
  frame.resolution = r;
  frame.origin = {left * r, bottom * r};
  frame.columns = static_cast<int>(std::ceil((bounds.high.x + params.margin) / r) - left);
  frame.rows = static_cast<int>(std::ceil((bounds.high.y + params.margin) / r) - bottom);
  result.map.cells.assign(frame.size(), OccupancyGrid::kUnknown);
  for_cells_inside(frame, world.floor, [&](std::size_t i) { result.map.cells[i] = OccupancyGrid::kFree; });

  const std::vector<Fate> fates = draw_fates(world, params, rng.stream("fates"));
  for (std::size_t i = 0; i < world.solids.size(); ++i) {
    const Solid& solid = world.solids[i];
    if (is_litter(solid)) continue;
    // A stream of its own: a new solid does not change the others' errors.
    Rng own = rng.stream(solid.id);
    Polygon polygon = shifted(solid.polygon, any_shift(own, params.least_error, params.greatest_error));
    if (!is_seen_by_laser(solid)) {
      const bool hangs_high = solid.kind == SolidKind::furniture && solid.bottom > kLaserHeight + 1.5;
      if (hangs_high || (solid.kind == SolidKind::furniture && is_covered_by_hazard(world, solid))) continue;
      for (Point2& corner : polygon) {
        corner = {std::round(corner.x * 100.0) / 100.0, std::round(corner.y * 100.0) / 100.0};
      }
      result.hazards.push_back({solid.id, hazard_kind(solid.kind), std::move(polygon)});
      continue;
    }
    if (fates[i] == Fate::missing) {
      result.missing.push_back(solid.id);
      continue;
    }
    if (fates[i] == Fate::moved) {
      polygon = shifted(polygon, any_shift(own, params.least_move, params.greatest_move));
      result.moved.push_back(solid.id);
    }
    for_cells(frame, polygon, 0.5 * r, [&](std::size_t cell) { result.map.cells[cell] = OccupancyGrid::kOccupied; });
  }
  return result;
}

std::string to_yaml(const std::vector<SurveyedHazard>& hazards) {
  std::string text = "hazards:\n";
  for (const SurveyedHazard& hazard : hazards) {
    text += "  - {id: " + hazard.id + ", kind: " + hazard.kind + ", polygon: [";
    for (std::size_t i = 0; i < hazard.polygon.size(); ++i) {
      std::array<char, 64> corner{};
      std::snprintf(corner.data(), corner.size(), "%s[%.2f, %.2f]", i == 0 ? "" : ", ", hazard.polygon[i].x,
                    hazard.polygon[i].y);
      text += corner.data();
    }
    text += "]}\n";
  }
  return text;
}

}  // namespace docent::simulator
