#include "docent/simulator/sensing/ray_caster.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kCell = 0.5;  // [m]
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Shares of sound that come straight back: plaster and glass hardly scatter it, shelves and handles do.
constexpr double kWallRoughness = 0.03;
constexpr double kGlassRoughness = 0.0;
constexpr double kFurnitureRoughness = 0.25;

}  // namespace

std::vector<Surface> surfaces_at(const World& world, double height) {
  std::vector<Surface> surfaces;
  for (const Solid& solid : world.solids) {
    if (solid.kind == SolidKind::plate || solid.kind == SolidKind::stairs) continue;
    if (height < solid.bottom || height > solid.top) continue;
    for (const Segment& side : sides(solid.polygon)) surfaces.push_back({side, solid.kind == SolidKind::glass});
  }
  return surfaces;
}

std::vector<Surface> sonar_surfaces(const World& world) {
  std::vector<Surface> surfaces;
  for (const Solid& solid : world.solids) {
    if (solid.kind == SolidKind::plate || solid.kind == SolidKind::stairs) continue;
    if (kSonarHeight < solid.bottom || kSonarHeight > solid.top) continue;
    const double roughness = solid.kind == SolidKind::glass       ? kGlassRoughness
                             : solid.kind == SolidKind::furniture ? kFurnitureRoughness
                                                                  : kWallRoughness;
    for (const Segment& side : sides(solid.polygon)) surfaces.push_back({side, false, roughness});
  }
  return surfaces;
}

RayCaster::RayCaster(const std::vector<Surface>& surfaces) {
  if (surfaces.empty()) {
    starts_.assign(2, 0);
    return;
  }
  low_ = high_ = surfaces.front().segment.a;
  for (const Surface& surface : surfaces) {
    for (const Point2 end : {surface.segment.a, surface.segment.b}) {
      low_ = {std::min(low_.x, end.x), std::min(low_.y, end.y)};
      high_ = {std::max(high_.x, end.x), std::max(high_.y, end.y)};
    }
  }
  low_ = low_ - Point2{0.1, 0.1};
  columns_ = static_cast<int>(std::ceil((high_.x + 0.1 - low_.x) / kCell));
  rows_ = static_cast<int>(std::ceil((high_.y + 0.1 - low_.y) / kCell));
  high_ = low_ + Point2{columns_ * kCell, rows_ * kCell};

  std::vector<std::vector<Side>> cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const auto column_of = [&](double x) { return std::clamp(static_cast<int>((x - low_.x) / kCell), 0, columns_ - 1); };
  const auto row_of = [&](double y) { return std::clamp(static_cast<int>((y - low_.y) / kCell), 0, rows_ - 1); };
  constexpr double kReach = kCell * 0.7072;  // half a diagonal, rounded up
  for (const Surface& surface : surfaces) {
    const auto [a, b] = surface.segment;
    for (int row = row_of(std::min(a.y, b.y) - 1e-6); row <= row_of(std::max(a.y, b.y) + 1e-6); ++row) {
      for (int column = column_of(std::min(a.x, b.x) - 1e-6); column <= column_of(std::max(a.x, b.x) + 1e-6);
           ++column) {
        const Point2 centre = low_ + Point2{(column + 0.5) * kCell, (row + 0.5) * kCell};
        if (distance(surface.segment, centre) > kReach) continue;
        cells[static_cast<std::size_t>(row * columns_ + column)].push_back(
            {a.x, a.y, b.x - a.x, b.y - a.y, surface.glass, surface.roughness});
      }
    }
  }
  starts_.reserve(cells.size() + 1);
  for (const auto& cell : cells) {
    starts_.push_back(static_cast<std::uint32_t>(sides_.size()));
    sides_.insert(sides_.end(), cell.begin(), cell.end());
  }
  starts_.push_back(static_cast<std::uint32_t>(sides_.size()));
}

void RayCaster::test_cell(std::size_t cell, Point2 origin, Point2 direction, RayHit& hit) const {
  for (std::size_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
    const Side& side = sides_[i];
    const double denominator = direction.x * side.dy - direction.y * side.dx;
    if (denominator == 0.0) continue;
    const double ox = side.ax - origin.x;
    const double oy = side.ay - origin.y;
    const double u = (ox * direction.y - oy * direction.x) / denominator;
    if (u < -1e-9 || u > 1.0 + 1e-9) continue;  // the slack closes corners
    const double t = (ox * side.dy - oy * side.dx) / denominator;
    if (t < 0.0) continue;
    if (!side.glass) {
      if (t >= hit.distance) continue;
      hit.distance = t;
      hit.side = static_cast<std::uint32_t>(i);
    } else if (t < hit.glass_distance) {
      hit.glass_distance = t;
      hit.glass_cosine = std::abs(denominator) / std::sqrt(side.dx * side.dx + side.dy * side.dy);
    }
  }
}

RayHit RayCaster::cast(Point2 origin, Point2 direction, double max_range) const {
  RayHit hit;
  // The part of the ray inside the grid.
  double enter = 0.0;
  double leave = max_range;
  const auto clip = [&](double from, double along, double low, double high) {
    if (along == 0.0) {
      if (from < low || from >= high) leave = -1.0;
      return;
    }
    const double t0 = (low - from) / along;
    const double t1 = (high - from) / along;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  };
  clip(origin.x, direction.x, low_.x, high_.x);
  clip(origin.y, direction.y, low_.y, high_.y);
  if (enter > leave || sides_.empty()) return hit;

  const Point2 start = origin + enter * direction;
  int column = std::clamp(static_cast<int>((start.x - low_.x) / kCell), 0, columns_ - 1);
  int row = std::clamp(static_cast<int>((start.y - low_.y) / kCell), 0, rows_ - 1);
  const int column_step = direction.x > 0.0 ? 1 : -1;
  const int row_step = direction.y > 0.0 ? 1 : -1;
  const double column_stride = direction.x == 0.0 ? kInfinity : kCell / std::abs(direction.x);
  const double row_stride = direction.y == 0.0 ? kInfinity : kCell / std::abs(direction.y);
  double next_column =
      direction.x == 0.0 ? kInfinity : (low_.x + (column + (column_step > 0 ? 1 : 0)) * kCell - origin.x) / direction.x;
  double next_row =
      direction.y == 0.0 ? kInfinity : (low_.y + (row + (row_step > 0 ? 1 : 0)) * kCell - origin.y) / direction.y;
  while (true) {
    const auto cell = static_cast<std::size_t>(row * columns_ + column);
    if (starts_[cell] != starts_[cell + 1]) test_cell(cell, origin, direction, hit);
    const double exit = std::min(next_column, next_row);
    if (hit.distance <= exit || exit > leave) break;
    if (next_column < next_row) {
      column += column_step;
      next_column += column_stride;
    } else {
      row += row_step;
      next_row += row_stride;
    }
    if (column < 0 || column >= columns_ || row < 0 || row >= rows_) break;
  }
  if (hit.distance > max_range) hit.distance = kInfinity;
  if (hit.glass_distance > max_range || hit.glass_distance > hit.distance) hit.glass_distance = kInfinity;
  return hit;
}

Footprint RayCaster::footprint(const RayHit& hit, Point2 origin, Point2 direction) const {
  const Side& side = sides_[hit.side];
  const double length = std::hypot(side.dx, side.dy);
  Footprint foot;
  foot.normal = {-side.dy / length, side.dx / length};
  if (dot(foot.normal, direction) > 0.0) foot.normal = -1.0 * foot.normal;
  foot.cosine = -dot(foot.normal, direction);
  foot.roughness = side.roughness;
  const Point2 first{side.ax, side.ay};
  const Point2 second = first + Point2{side.dx, side.dy};
  const Point2 met = origin + hit.distance * direction;
  foot.edge = distance(met, first) < distance(met, second) ? first : second;
  return foot;
}

bool RayCaster::sees(Point2 from, Point2 to) const {
  const double range = distance(from, to);
  if (range < 1e-6) return true;
  return std::isinf(cast(from, (1.0 / range) * (to - from), range - 1e-6).distance);
}

}  // namespace docent::simulator
