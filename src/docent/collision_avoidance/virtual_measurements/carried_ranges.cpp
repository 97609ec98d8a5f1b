#include "docent/collision_avoidance/virtual_measurements/carried_ranges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace docent::collision_avoidance {
namespace {

constexpr int kAll = VirtualMeasurements::kDirections;
constexpr double kBearingStep = 2.0 * std::numbers::pi / kAll;  // [rad]
constexpr double kOneEdge = 0.4;                                // [m] between neighbouring ends that belong together

double bearing_of(int direction) { return direction * kBearingStep - std::numbers::pi; }

void lower(VirtualMeasurements::Ranges& ranges, int direction, double range) {
  double& least = ranges[static_cast<std::size_t>((direction % kAll + kAll) % kAll)];
  least = std::min(least, range);
}

double direction_of(Point2 point) { return (std::atan2(point.y, point.x) + std::numbers::pi) / kBearingStep; }

/// The directions between the ends of an edge.
void lower_between(VirtualMeasurements::Ranges& ranges, const Segment& edge) {
  double from = direction_of(edge.a), to = direction_of(edge.b);
  if (from > to) std::swap(from, to);
  if (to - from > kAll / 2.0) {  // it lies behind, across the first direction
    std::swap(from, to);
    to += kAll;
  }
  for (int i = static_cast<int>(std::ceil(from)); i <= static_cast<int>(std::floor(to)); ++i)
    if (const auto range = ray_distance({}, unit(Angle::radians(bearing_of(i))), edge)) lower(ranges, i, *range);
}

}  // namespace

VirtualMeasurements::Ranges carried(const VirtualMeasurements::Ranges& measured, const Pose2& then_from_now) {
  const Pose2 now_from_then = inverse(then_from_now);
  std::array<std::optional<Point2>, kAll> ends;
  for (int i = 0; i < kAll; ++i) {
    const double range = measured[static_cast<std::size_t>(i)];
    if (range < VirtualMeasurements::kMaxRange)
      ends[static_cast<std::size_t>(i)] = now_from_then * (range * unit(Angle::radians(bearing_of(i))));
  }
  VirtualMeasurements::Ranges ranges;
  ranges.fill(VirtualMeasurements::kMaxRange);
  for (int i = 0; i < kAll; ++i) {
    const auto& end = ends[static_cast<std::size_t>(i)];
    if (!end) continue;
    lower(ranges, static_cast<int>(std::lround(direction_of(*end))), norm(*end));
    const auto& next = ends[static_cast<std::size_t>((i + 1) % kAll)];
    if (next && distance(*end, *next) < kOneEdge) lower_between(ranges, {*end, *next});
  }
  return ranges;
}

}  // namespace docent::collision_avoidance
