#include "docent/simulator/sensing/sonar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr int kRays = 17;               // across the lobe
constexpr int kBounces = 3;             // surfaces that one ray meets at most
constexpr double kMirrorLoss = 0.8;     // of the strength, a mirror
constexpr double kAntiparallel = 0.99;  // cosine; so straight must a corner send the ray back
constexpr double kEar = 0.12;           // [m] so near must it pass the sonar

double first_person(Point2 origin, Point2 direction, std::span<const Disc> people) {
  double range = std::numeric_limits<double>::infinity();
  for (const Disc& disc : people) {
    const Point2 offset = disc.centre - origin;
    const double along = dot(offset, direction);
    const double beside = dot(offset, offset) - along * along;
    const bool is_outside = dot(offset, offset) > disc.radius * disc.radius;
    if (is_outside && (along < 0.0 || beside > disc.radius * disc.radius)) continue;  // most are missed
    if (const auto hit = ray_distance(origin, direction, disc.centre, disc.radius)) range = std::min(range, *hit);
  }
  return range;
}

/// Whether a disc may reach between two rays, `off` [rad] to each side of the axis. Never false for one that does.
bool may_be_met(const Pose2& world_from_sonar, double off, const Disc& disc) {
  constexpr double kRounding = 1e-6;  // [m]
  const Point2 axis = unit(world_from_sonar.theta);
  const Point2 offset = disc.centre - world_from_sonar.position();
  const double beyond = std::cos(off) * std::abs(cross(axis, offset)) - std::sin(off) * dot(axis, offset);
  return beyond <= disc.radius + kRounding;
}

}  // namespace

SonarRing::SonarRing(const SonarParams& params, Rng rng) : params_{params}, rng_{rng} {
  sound_ = 1.0 + rng_.uniform(-params.sound_error, params.sound_error);
}

Pose2 SonarRing::place(int index, const Pose2& world_from_base) const {
  const Angle bearing = Angle::radians(2.0 * std::numbers::pi * index / params_.count);
  const Point2 in_base = params_.ring_radius * unit(bearing);
  return world_from_base * Pose2{in_base.x, in_base.y, bearing};
}

std::span<const Ping> SonarRing::fire(int group, const RayCaster& walls, std::span<const Disc> people,
                                      const Pose2& world_from_base) {
  near_.clear();
  for (const Disc& disc : people) {
    const double reach = params_.max_range + params_.ring_radius + disc.radius;
    if (distance(disc.centre, world_from_base.position()) < reach) near_.push_back(disc);
  }
  echoes_.clear();
  pings_.clear();
  for (int index = group; index < params_.count; index += groups()) {
    echoes_.push_back(listen(place(index, world_from_base), walls));
    pings_.push_back({index, params_.max_range, EchoKind::none});
  }
  for (std::size_t i = 0; i < pings_.size(); ++i) {
    Echo heard = echoes_[i];
    const Point2 ear = place(pings_[i].index, world_from_base).position();
    for (std::size_t other = 0; other < pings_.size(); ++other) {
      if (other == i || echoes_[other].kind == EchoKind::none || !rng_.chance(params_.cross_talk)) continue;
      const double way =
          0.5 * (echoes_[other].way + distance(echoes_[other].source, ear) + rng_.exponential(params_.detour));
      if (heard.kind == EchoKind::none || way < heard.way) heard = {way, echoes_[other].source, EchoKind::cross_talk};
    }
    if (heard.kind == EchoKind::none || heard.way >= params_.max_range) continue;
    pings_[i].range = measured(heard.way);
    pings_[i].kind = heard.kind;
  }
  return pings_;
}

SonarRing::Echo SonarRing::listen(const Pose2& world_from_sonar, const RayCaster& walls) {
  Echo nearest;
  const double gain = std::exp(rng_.normal(0.0, params_.flutter));
  const bool is_lost = rng_.chance(params_.lost);
  ahead_.clear();
  for (const Disc& disc : near_)
    if (may_be_met(world_from_sonar, params_.lobe, disc)) ahead_.push_back(disc);
  for (int i = 0; i < kRays; ++i) {
    trace(world_from_sonar, params_.lobe * (2.0 * i / (kRays - 1) - 1.0), gain, walls, nearest);
  }
  return is_lost ? Echo{} : nearest;
}

void SonarRing::trace(const Pose2& world_from_sonar, double off, double gain, const RayCaster& walls,
                      Echo& nearest) const {
  const Point2 ear = world_from_sonar.position();
  const Point2 sent = unit(world_from_sonar.theta + Angle::radians(off));
  const double spacing = 2.0 * params_.lobe / (kRays - 1);
  double strength = gain * std::exp(-(off / params_.beam) * (off / params_.beam));
  Point2 origin = ear;
  Point2 direction = sent;
  double way = 0.0;
  const auto answer = [&](double share, double at, Point2 source, int bounces) {
    const double received = share * strength * std::min(params_.strongest, params_.reach / std::max(at, 0.01));
    if (received < params_.threshold || (nearest.kind != EchoKind::none && nearest.way <= at)) return;
    nearest = {at, source, bounces == 0 ? EchoKind::direct : EchoKind::bounced};
  };
  for (int bounce = 0; bounce < kBounces; ++bounce) {
    const double left = params_.max_range - way;
    if (left <= 0.0) return;
    const RayHit hit = walls.cast(origin, direction, left);
    const double person = first_person(origin, direction, bounce == 0 ? ahead_ : near_);
    if (person < hit.distance && person < left) {
      answer(params_.clothes, way + person, origin + person * direction, bounce);
      return;
    }
    if (std::isinf(hit.distance)) return;
    const Footprint foot = walls.footprint(hit, origin, direction);
    const Point2 met = origin + hit.distance * direction;
    const double slant = std::acos(std::min(1.0, foot.cosine)) / params_.mirror;
    answer(std::max(std::exp(-0.5 * slant * slant), foot.roughness * foot.cosine), way + hit.distance, met, bounce);
    // An edge must not slip through between two rays.
    if (distance(met, foot.edge) < std::max(0.02, spacing * (way + hit.distance) / std::max(foot.cosine, 0.2))) {
      answer(params_.edge, way + distance(origin, foot.edge), foot.edge, bounce);
    }
    origin = met;
    way += hit.distance;

    direction = direction + 2.0 * foot.cosine * foot.normal;
    strength *= kMirrorLoss * (1.0 - foot.roughness);
    origin = origin + 1e-6 * foot.normal;
    // The inside of a corner sends sound back to where it came from.
    const Point2 home = ear - origin;
    if (bounce > 0 && dot(direction, sent) < -kAntiparallel && std::abs(cross(direction, home)) < kEar) {
      answer(1.0, 0.5 * (way + norm(home)), origin, bounce);
    }
  }
}

double SonarRing::measured(double way) {
  const double noise = params_.noise_near + (params_.noise_far - params_.noise_near) * way / params_.max_range;
  const double range = sound_ * way + rng_.normal(0.0, noise);
  return std::clamp(params_.quantum * std::round(range / params_.quantum), params_.min_range, params_.max_range);
}

}  // namespace docent::simulator
