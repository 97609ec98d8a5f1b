#include "docent/simulator/traced/wall_spots.h"

#include <algorithm>
#include <utility>

namespace docent::simulator {
namespace {

constexpr double kStep = 0.5;          // [m] between spots
constexpr double kSample = 0.1;        // [m]
constexpr double kBefore = 1.6;        // [m] of free floor
constexpr double kBeside = 0.9;        // [m]
constexpr double kWallOff = 0.15;      // [m] the wall bulges so far at most
constexpr double kShortestWall = 1.0;  // [m]

}  // namespace

WallSpots::WallSpots(const Polygon& outline, const WalkableFloor& floor, const Rng& rng) : floor_{floor} {
  for (const Segment& side : sides(outline)) {
    const double length = distance(side.a, side.b);
    if (length < kShortestWall) continue;
    const Angle inwards = direction(side.a, side.b) + Angle::degrees(90.0);
    for (double along = 0.5 * kStep; along < length; along += kStep) {
      const Point2 foot = side.a + (along / length) * (side.b - side.a);
      spots_.push_back({foot.x, foot.y, inwards});
    }
  }
  Rng own = rng;
  for (std::size_t i = spots_.size(); i > 1; --i) {
    std::swap(spots_[i - 1], spots_[static_cast<std::size_t>(own.integer(0, static_cast<std::int64_t>(i) - 1))]);
  }
}

bool WallSpots::is_free(const Pose2& world_from_spot, double width, double depth) const {
  const double side = 0.5 * width + kBeside;
  for (double x = kWallOff; x <= depth + kBefore; x += kSample) {
    for (double y = -side; y <= side; y += kSample) {
      const Point2 point = world_from_spot * Point2{x, y};
      if (floor_.clearance(point) <= 0.05) return false;
    }
  }
  return floor_.is_reachable(world_from_spot * Point2{depth + 0.5 * kBefore, 0.0});
}

std::optional<Polygon> WallSpots::place(double width, double depth, double apart,
                                        const std::function<bool(const Polygon&)>& accept) {
  for (const Pose2& spot : spots_) {
    const bool is_near = std::any_of(taken_.begin(), taken_.end(),
                                     [&](Point2 other) { return distance(other, spot.position()) < apart; });
    if (is_near || !is_free(spot, width, depth)) continue;
    constexpr double kGap = 0.02;  // [m] to the wall
    const double w = 0.5 * width;
    const Polygon box{spot * Point2{kGap, -w}, spot * Point2{kGap + depth, -w}, spot * Point2{kGap + depth, w},
                      spot * Point2{kGap, w}};
    if (!accept(box)) continue;
    taken_.push_back(spot.position());
    return box;
  }
  return std::nullopt;
}

}  // namespace docent::simulator
