#include "docent/mapping/occupancy/sight_layer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace docent::mapping {
namespace {

bool is_near_any(Point2 at, std::span<const LaserLook> lasers, double within) {
  for (const LaserLook& laser : lasers)
    for (const Point2& endpoint : laser.endpoints)
      if (distance(endpoint, at) < within) return true;
  return false;
}

/// Whether a line lies between two points.
bool is_between(Point2 from, Point2 to, std::span<const Segment> lines) {
  const auto side = [](Point2 a, Point2 b, Point2 p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  return std::any_of(lines.begin(), lines.end(), [&](const Segment& line) {
    return side(from, to, line.a) * side(from, to, line.b) < 0.0 &&
           side(line.a, line.b, from) * side(line.a, line.b, to) < 0.0;
  });
}

/// What of a line lies within a circle; nothing where it is none, or goes beyond any number.
std::optional<Segment> within(const Segment& line, Point2 centre, double radius) {
  const Point2 along = line.b - line.a, from = line.a - centre;
  const double a = along.x * along.x + along.y * along.y, b = from.x * along.x + from.y * along.y;
  const double c = from.x * from.x + from.y * from.y - radius * radius;
  if (!std::isfinite(a) || !std::isfinite(b * b) || !std::isfinite(c)) return std::nullopt;
  if (a == 0.0) return c <= 0.0 ? std::optional{line} : std::nullopt;
  const double root2 = b * b - a * c;
  if (root2 < 0.0) return std::nullopt;
  const double first = std::max(0.0, (-b - std::sqrt(root2)) / a), last = std::min(1.0, (-b + std::sqrt(root2)) / a);
  if (!(first <= last)) return std::nullopt;
  return Segment{line.a + first * along, line.a + last * along};
}

}  // namespace

Result<void> SightLayerParams::validate() const {
  if (!(reach > 0.0)) return fail("reach must be > 0");
  if (!(seen >= 0.0)) return fail("seen must be >= 0");
  if (!(looks >= 1 && looks <= 10)) return fail("looks must be 1..10");
  if (!(forget > 0.0)) return fail("forget must be > 0");
  return {};
}

SightLayer::SightLayer(const GridFrame& frame, std::vector<bool> known, const SightLayerParams& params)
    : frame_{frame},
      params_{params},
      known_{std::move(known)},
      strength_(frame.size()),
      blocked_(frame.size()),
      seen_(frame.size()),
      shown_(frame.size()) {}

void SightLayer::set(CellIndex cell, int strength) {
  const std::size_t index = frame_.index(cell);
  strength_[index] = static_cast<std::int8_t>(strength);
  const bool blocks = strength >= params_.looks || (strength > 0 && blocked_[index]);
  if (blocks == blocked_[index]) return;
  blocked_[index] = blocks;
  widen(changes_, cell);
}

void SightLayer::see(Point2 robot, std::span<const Segment> lines, std::span<const LaserLook> lasers, Time now) {
  ++message_;
  mark(robot, lines, lasers, now);
  free(robot, lines);
}

void SightLayer::mark(Point2 robot, std::span<const Segment> lines, std::span<const LaserLook> lasers, Time now) {
  const double step = 0.5 * frame_.resolution;
  for (const Segment& line : lines) {
    const auto near = within(line, robot, params_.reach);
    if (!near) continue;
    const int steps = 1 + static_cast<int>(distance(near->a, near->b) / step);
    for (int i = 0; i <= steps; ++i) {
      const Point2 at = near->a + (static_cast<double>(i) / steps) * (near->b - near->a);
      const CellIndex cell = frame_.cell_at(at);
      if (!frame_.holds(cell) || distance(at, robot) > params_.reach) continue;
      const std::size_t index = frame_.index(cell);
      if (shown_[index] == message_ || known_[index] || is_near_any(at, lasers, params_.seen)) continue;
      shown_[index] = message_;
      seen_[index] = now;
      if (strength_[index] == 0) marked_.push_back(index);
      set(cell, std::min(params_.looks, strength_[index] + 1));
    }
  }
}

void SightLayer::free(Point2 robot, std::span<const Segment> lines) {
  std::vector<std::size_t> left;
  const auto columns = static_cast<std::size_t>(frame_.columns);
  for (const std::size_t index : marked_) {
    const CellIndex cell{static_cast<int>(index % columns), static_cast<int>(index / columns)};
    const Point2 at = frame_.centre(cell);
    const bool is_told_of = distance(at, robot) < params_.reach && !is_between(robot, at, lines);
    if (shown_[index] != message_ && is_told_of) set(cell, strength_[index] - 1);
    if (strength_[index] > 0) left.push_back(index);
  }
  marked_ = std::move(left);
}

void SightLayer::forget(Time now) {
  std::vector<std::size_t> left;
  const auto columns = static_cast<std::size_t>(frame_.columns);
  for (const std::size_t index : marked_) {
    if (to_seconds(now - seen_[index]) >= params_.forget)
      set({static_cast<int>(index % columns), static_cast<int>(index / columns)}, 0);
    else
      left.push_back(index);
  }
  marked_ = std::move(left);
}

std::optional<CellRectangle> SightLayer::take_changes() { return std::exchange(changes_, std::nullopt); }

}  // namespace docent::mapping
