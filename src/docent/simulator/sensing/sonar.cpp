#include "docent/simulator/sensing/sonar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::simulator {

double SonarRing::ping(int index, const RayCaster& walls, std::span<const Disc> people, const Pose2& world_from_base) {
  const Angle bearing = world_from_base.theta + Angle::radians(2.0 * std::numbers::pi * index / params_.count);
  const Point2 origin = world_from_base.position() + params_.ring_radius * unit(bearing);
  const bool glass_echoes = rng_.chance(params_.glass);
  double range = params_.max_range;
  constexpr int kRays = 5;
  for (int i = 0; i < kRays; ++i) {
    const double off = params_.field_of_view * (static_cast<double>(i) / (kRays - 1) - 0.5);
    const RayHit hit = walls.cast(origin, unit(bearing + Angle::radians(off)), range);
    range = std::min(range, hit.distance);
    if (glass_echoes) range = std::min(range, hit.glass_distance);
  }
  for (const Disc& disc : people) {
    const Point2 offset = disc.centre - origin;
    const double away = norm(offset);
    if (away - disc.radius >= range) continue;
    const double half_angle = away > disc.radius ? std::asin(disc.radius / away) : std::numbers::pi;
    const double off = std::abs((direction(origin, disc.centre) - bearing).radians());
    if (off > half_angle + params_.field_of_view / 2.0) continue;
    range = std::max(away - disc.radius, 0.0);
  }
  if (rng_.chance(params_.lost) || range >= params_.max_range) return params_.max_range;
  range += rng_.normal(0.0, params_.noise);
  return std::clamp(params_.quantum * std::round(range / params_.quantum), params_.min_range, params_.max_range);
}

}  // namespace docent::simulator
