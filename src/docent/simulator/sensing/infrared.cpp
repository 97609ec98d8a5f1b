#include "docent/simulator/sensing/infrared.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::simulator {

InfraredRing::InfraredRing(const InfraredParams& params, Rng rng) : params_{params}, rng_{rng} {
  for (int i = 0; i < params.count; ++i) {
    slopes_.push_back(1.0 + rng_.uniform(-params.slope_error, params.slope_error));
  }
}

double InfraredRing::true_range(Point2 origin, Angle axis, const RayCaster& walls, std::span<const Disc> people) {
  constexpr int kRays = 3;  // across the cone
  double nearest = std::numeric_limits<double>::infinity();
  const bool is_dark = rng_.chance(params_.dark_clothes);
  for (int i = 0; i < kRays; ++i) {
    const double off = 0.5 * params_.field_of_view * (2.0 * i / (kRays - 1) - 1.0);
    const Point2 direction = unit(axis + Angle::radians(off));
    const RayHit hit = walls.cast(origin, direction, params_.max_range);
    double person = std::numeric_limits<double>::infinity();
    for (const Disc& disc : people) {
      if (const auto at = ray_distance(origin, direction, disc.centre, disc.radius)) person = std::min(person, *at);
    }
    if (person < hit.distance) {
      if (!is_dark || person < params_.dark_reach * params_.max_range) nearest = std::min(nearest, person);
      continue;
    }
    if (std::isinf(hit.distance)) continue;
    const Footprint foot = walls.footprint(hit, origin, direction);
    if (foot.cosine > params_.grazing * (1.0 - foot.roughness)) nearest = std::min(nearest, hit.distance);
  }
  return nearest;
}

double InfraredRing::read(int index, const RayCaster& walls, std::span<const Disc> people,
                          const Pose2& world_from_base) {
  const Angle bearing = Angle::radians(2.0 * std::numbers::pi * index / params_.count);
  const Point2 place = world_from_base * (params_.ring_radius * unit(bearing));
  const double range = true_range(place, world_from_base.theta + bearing, walls, people);
  const double flicker = rng_.uniform(params_.min_range, params_.max_range);
  if (rng_.chance(params_.glare)) return params_.max_range;
  if (rng_.chance(params_.flicker)) return std::min(flicker, std::min(range, params_.max_range));
  if (range >= params_.max_range) return params_.max_range;
  const double share = range / params_.max_range;
  const double noise = params_.noise_near + (params_.noise_far - params_.noise_near) * share * share;
  // Nearer than it can look the spot leaves the detector on the other side.
  const double seen = range < params_.min_range ? 2.0 * params_.min_range - range : range;
  const double measured = slopes_[static_cast<std::size_t>(index)] * seen + rng_.normal(0.0, noise);
  return std::clamp(params_.quantum * std::round(measured / params_.quantum), params_.min_range, params_.max_range);
}

}  // namespace docent::simulator
