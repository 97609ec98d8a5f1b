#include "docent/simulator/sensing/laser.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {

LaserScanner::LaserScanner(const LaserParams& params, const Pose2& base_from_nominal, Rng rng)
    : params_{params}, rng_{rng} {
  const Pose2 error{rng_.uniform(-params.mount_offset, params.mount_offset) * 0.7,
                    rng_.uniform(-params.mount_offset, params.mount_offset) * 0.7,
                    Angle::radians(rng_.uniform(-params.mount_heading, params.mount_heading))};
  base_from_scanner_ = base_from_nominal * error;
  for (int i = 0; i < params.beams; ++i)
    rays_.push_back(unit(Angle::radians(params.first_bearing + i * params.bearing_step)));
}

void LaserScanner::limit_reach(double range) {
  params_.noise_far = params_.noise_near + (params_.noise_far - params_.noise_near) * range / params_.max_range;
  params_.max_range = range;
}

double LaserScanner::measure(double ideal, double neighbour) {
  const double max = params_.max_range;
  double range = ideal;
  if (std::abs(neighbour - ideal) > 0.3 && rng_.chance(params_.mixed)) {
    // The beam has a width: part of it ends on the near edge, part behind it.
    range = ideal + (std::min(neighbour, max) - ideal) * rng_.uniform(0.0, 0.6);
  }
  const double luck = rng_.uniform();
  if (luck < params_.lost) return max;
  if (luck < params_.lost + params_.stray) range = rng_.uniform(0.3, std::min(range, max));
  if (range >= max) return max;
  range += rng_.normal(0.0, params_.noise_near + (params_.noise_far - params_.noise_near) * range / max);
  range = params_.quantum * std::round(range / params_.quantum);
  return std::clamp(range, 0.05, max);
}

void LaserScanner::see_body(std::span<const Disc> parts) {
  parts_.clear();
  for (const Disc& part : parts) parts_.push_back({inverse(base_from_scanner_) * part.centre, part.radius});
}

void LaserScanner::meet(Point2 centre, double radius, std::int32_t disc) {
  const double away = norm(centre);
  const double half_angle = away > radius ? std::asin(radius / away) : 3.2;
  const double bearing = std::atan2(centre.y, centre.x);
  // A disc behind the scanner may reach into its field on both sides.
  for (const double turn : {-6.283185307179586, 0.0, 6.283185307179586}) {
    const double from = (bearing + turn - half_angle - params_.first_bearing) / params_.bearing_step;
    const double to = (bearing + turn + half_angle - params_.first_bearing) / params_.bearing_step;
    if (to < 0.0 || from > params_.beams - 1) continue;
    const auto last = static_cast<std::size_t>(std::min<double>(std::floor(to), params_.beams - 1));
    for (auto i = static_cast<std::size_t>(std::max(0.0, std::ceil(from))); i <= last; ++i) {
      const auto range = ray_distance({}, rays_[i], centre, radius);
      if (range && *range < ideal_[i]) {
        ideal_[i] = *range;
        sweep_.discs[i] = disc;
      }
    }
  }
}

const LaserScanner::Sweep& LaserScanner::sweep(const RayCaster& walls, std::span<const Disc> discs,
                                               const Pose2& world_from_base) {
  const auto beams = static_cast<std::size_t>(params_.beams);
  const Pose2 world_from_scanner = world_from_base * base_from_scanner_;
  const Point2 origin = world_from_scanner.position();
  const double heading = world_from_scanner.theta.radians();
  ideal_.resize(beams);
  sweep_.ranges.resize(beams);
  sweep_.discs.assign(beams, -1);

  for (std::size_t i = 0; i < beams; ++i) {
    const double bearing = heading + params_.first_bearing + static_cast<double>(i) * params_.bearing_step;
    const Point2 ray{std::cos(bearing), std::sin(bearing)};
    const RayHit hit = walls.cast(origin, ray, params_.max_range);
    ideal_[i] = std::min(hit.distance, params_.max_range);
    if (hit.glass_distance < ideal_[i] && hit.glass_cosine > 0.985 && rng_.chance(params_.glass_return)) {
      ideal_[i] = hit.glass_distance;
    }
  }
  const Pose2 scanner_from_world = inverse(world_from_scanner);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    const double reach = params_.max_range + disc.radius;
    const Point2 offset = disc.centre - origin;
    if (dot(offset, offset) > 1.01 * reach * reach) continue;  // most are out of reach
    const Point2 centre = scanner_from_world * disc.centre;
    if (norm(centre) <= reach) meet(centre, disc.radius, static_cast<std::int32_t>(i));
  }
  for (const Disc& part : parts_) meet(part.centre, part.radius, -1);
  for (std::size_t i = 0; i < beams; ++i) {
    const double left = i + 1 < beams ? ideal_[i + 1] : ideal_[i];
    const double right = i > 0 ? ideal_[i - 1] : ideal_[i];
    const double neighbour = std::abs(left - ideal_[i]) > std::abs(right - ideal_[i]) ? left : right;
    sweep_.ranges[i] = static_cast<float>(measure(ideal_[i], neighbour));
  }
  return sweep_;
}

}  // namespace docent::simulator
