#include "docent/simulator/body/obstacles.h"

#include <algorithm>
#include <limits>

namespace docent::simulator {
namespace {

constexpr double kRobotHeight = 1.2;  // [m] it drives under what hangs higher
constexpr double kTouch = 0.001;      // [m]

Point2 nearest_on_outline(const Polygon& polygon, Point2 point) {
  Point2 best = polygon.front();
  for (const Segment& side : sides(polygon)) {
    const Point2 candidate = nearest_point(side, point);
    if (distance(candidate, point) < distance(best, point)) best = candidate;
  }
  return best;
}

}  // namespace

std::string contact_kind(SolidKind kind) {
  switch (kind) {
    case SolidKind::wall:
      return "walls";
    case SolidKind::furniture:
      return "furniture";
    case SolidKind::glass:
    case SolidKind::plate:
    case SolidKind::stairs:
      return "hazards";
  }
  return "hazards";
}

Obstacles::Obstacles(const World& world) {
  for (std::size_t i = 0; i < world.solids.size(); ++i) {
    const Solid& solid = world.solids[i];
    if (solid.polygon.size() < 3) continue;
    // A plate hangs or lies where the robot cannot see it, but it is there.
    if (solid.kind != SolidKind::plate && solid.bottom >= kRobotHeight) continue;
    Item item{i, solid.polygon, solid.polygon.front(), solid.polygon.front(), solid.kind == SolidKind::stairs};
    for (const Point2 corner : solid.polygon) {
      item.low = {std::min(item.low.x, corner.x), std::min(item.low.y, corner.y)};
      item.high = {std::max(item.high.x, corner.x), std::max(item.high.y, corner.y)};
    }
    items_.push_back(std::move(item));
  }
}

void Obstacles::resolve(Point2& centre, double radius, std::vector<Touch>& touches) const {
  touches.clear();
  constexpr int kRounds = 3;  // in a corner each side pushes in turn
  for (int round = 0; round < kRounds; ++round) {
    bool moved = false;
    for (const Item& item : items_) {
      if (centre.x < item.low.x - radius || centre.x > item.high.x + radius || centre.y < item.low.y - radius ||
          centre.y > item.high.y + radius) {
        continue;
      }
      const Point2 nearest = nearest_on_outline(item.polygon, centre);
      const bool inside = contains(item.polygon, centre);
      const double gap = distance(nearest, centre);
      if (!inside && gap >= radius + kTouch) continue;
      Point2 towards = gap > 1e-9 ? (1.0 / gap) * (nearest - centre) : Point2{1.0, 0.0};
      if (inside) towards = Point2{} - towards;
      if (round == 0) touches.push_back({item.solid, nearest, towards});
      if (item.is_stairs || (!inside && gap >= radius)) continue;
      centre = nearest - radius * towards;
      moved = true;
    }
    if (!moved) break;
  }
}

bool Obstacles::has_fallen(Point2 centre) const {
  return std::any_of(items_.begin(), items_.end(),
                     [&](const Item& item) { return item.is_stairs && contains(item.polygon, centre); });
}

double Obstacles::clearance(Point2 point) const {
  constexpr double kRounding = 1e-9;  // [m]
  double least = std::numeric_limits<double>::infinity();
  for (const Item& item : items_) {
    const double beside = std::max({item.low.x - point.x, point.x - item.high.x, 0.0});
    const double before = std::max({item.low.y - point.y, point.y - item.high.y, 0.0});
    if (std::max(beside, before) < least + kRounding) least = std::min(least, distance(item.polygon, point));
  }
  return least;
}

}  // namespace docent::simulator
