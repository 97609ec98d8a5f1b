#include "docent/simulator/sensing/camera/things/stairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::simulator {
namespace {

constexpr double kRise = 0.17;    // [m] of a step
constexpr double kGoing = 0.28;   // [m]
constexpr double kDeepest = 3.0;  // [m] where the file names no bottom
constexpr double kLook = 0.35;    // [m] so far before a side nothing may stand
constexpr double kNosing = 0.04;  // [m] at the edge of each tread: a strip that one shall see
constexpr Rgb kTread{0.34F, 0.33F, 0.31F};
constexpr Rgb kStrip{0.62F, 0.58F, 0.40F};
constexpr Look kRiser{{0.20F, 0.20F, 0.19F}};
constexpr Look kShaft{{0.30F, 0.29F, 0.28F}};

Polygon turned_left(Polygon polygon) {
  if (signed_area(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

bool is_open(const Segment& side, const Solid& stairs, const World& world) {
  const Point2 along = side.b - side.a;
  const Point2 out = (1.0 / norm(along)) * Point2{along.y, -along.x};  // of a counter-clockwise outline
  for (const double share : {0.25, 0.5, 0.75})
    for (double away = 0.04; away < kLook; away += 0.04) {
      const Point2 at = side.a + share * along + away * out;
      if (!contains(world.floor, at)) return false;
      for (const Solid& solid : world.solids)
        if (solid.id != stairs.id && solid.bottom < 1.0 && solid.top > 0.3 && contains(solid.polygon, at)) return false;
    }
  return true;
}

/// What of the polygon lies at `least` or more along the direction from the origin.
Polygon cut(const Polygon& polygon, Point2 origin, Point2 along, double least) {
  Polygon kept;
  for (const Segment& side : sides(polygon)) {
    const double a = dot(along, side.a - origin) - least, b = dot(along, side.b - origin) - least;
    if (a >= 0.0) kept.push_back(side.a);
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) kept.push_back(side.a + (a / (a - b)) * (side.b - side.a));
  }
  return kept;
}

}  // namespace

std::size_t entry_of(const Solid& stairs, const World& world) {
  const std::vector<Segment> all = sides(turned_left(stairs.polygon));
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double closed = is_open(all[i], stairs, world) ? 0.0 : 1e6;
    const double length = closed + distance(all[i].a, all[i].b);
    if (length < least) best = i, least = length;
  }
  return best;
}

void add_stairs(Mesh& mesh, const Solid& stairs, const World& world) {
  const Polygon outline = turned_left(stairs.polygon);
  const Segment entry = sides(outline)[entry_of(stairs, world)];
  const Point2 across = (1.0 / distance(entry.a, entry.b)) * (entry.b - entry.a);
  const Point2 down{-across.y, across.x};
  const double deepest = stairs.bottom < -0.1 ? -stairs.bottom : kDeepest;
  double reach = 0.0;
  for (const Point2 corner : outline) reach = std::max(reach, dot(down, corner - entry.a));
  double depth = 0.0;
  for (double from = 0.0; from < reach - 1e-6; from += kGoing) {
    const double next = std::min(deepest, depth + kRise);
    const bool is_landing = next >= deepest;
    Polygon tread = cut(outline, entry.a, down, from);
    if (tread.size() < 3) break;
    double left = 1e9, right = -1e9;
    for (const Point2 corner : tread)
      if (dot(down, corner - entry.a) < from + 1e-6) {
        left = std::min(left, dot(across, corner - entry.a));
        right = std::max(right, dot(across, corner - entry.a));
      }
    if (right > left) {
      const Point2 a = entry.a + from * down + left * across, b = entry.a + from * down + right * across;
      add_quad(mesh, {lifted(a, -depth), lifted(a, -next), lifted(b, -next), lifted(b, -depth)}, kRiser);
    }
    depth = next;
    if (!is_landing && from + kGoing < reach) tread = cut(tread, entry.a, -1.0 * down, -(from + kGoing));
    const float tone = static_cast<float>(1.0 - 0.03 * std::min(10.0, depth / kRise));  // darker down there
    const double nosing = is_landing ? reach : from + kGoing - kNosing;
    add_level(mesh, cut(tread, entry.a, -1.0 * down, -nosing), -depth, true, {tone * kTread});
    add_level(mesh, cut(tread, entry.a, down, nosing), -depth, true, {tone * kStrip});
    if (is_landing) break;
  }
  for (const auto& [a, b] : sides(outline))
    add_quad(mesh, {lifted(b, 0.0), lifted(b, -depth), lifted(a, -depth), lifted(a, 0.0)}, kShaft);
}

}  // namespace docent::simulator
