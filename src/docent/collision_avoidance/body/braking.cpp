#include "docent/collision_avoidance/body/braking.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::collision_avoidance {

namespace {

struct Sample {
  Pose2 start_from_base;
  double time = 0.0;
  Velocity velocity;
};

/// The manoeuvre "obey, then brake": at most 64 samples; `reach` is how far the base gets from its start.
struct Manoeuvre {
  std::array<Sample, 64> samples;
  std::size_t count = 0;
  double way = 0.0;
};

Manoeuvre simulate(const Velocity& velocity, const Velocity& command, double hold, const BaseLimits& limits,
                   const BrakingParams& params) {
  Manoeuvre result;
  BaseState state{{}, velocity};
  double time = 0.0;
  while (result.count < result.samples.size()) {
    const bool obeys = time < hold - 1e-9;
    const double dt = obeys ? std::min(params.step, hold - time) : params.step;
    state = advance(state, obeys ? command : Velocity{}, limits, dt);
    time += dt;
    result.way += std::abs(state.velocity.linear) * dt;
    result.samples[result.count++] = {state.odom_from_base, time, state.velocity};
    // What is left of a turn moves no disc, but it moves every other body.
    const bool stands = state.velocity.linear == 0.0 && (limits.outline.empty() || state.velocity.angular == 0.0);
    if (!obeys && stands) break;
  }
  result.way += std::abs(velocity.linear) * params.step;
  return result;
}

/// As can_brake_in_time, for a body with an outline, which may also touch something by turning.
bool can_outline_brake(const Manoeuvre& manoeuvre, std::span<const Obstacle> obstacles, const Outline& outline,
                       double slack, const BrakingParams& params) {
  const double duration = manoeuvre.samples[manoeuvre.count - 1].time;
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_border) continue;
    double required = obstacle.margin - slack;
    const double speed = norm(obstacle.velocity);
    if (norm(obstacle.at) - speed * duration - manoeuvre.way > outline.circumradius() + required) continue;
    const double now = outline.distance_to(obstacle.at);
    if (speed == 0.0 && now - params.noise < required) {
      required = now > params.last_margin + params.noise ? std::max(now - params.noise, params.last_margin)
                                                         : now - params.border_noise;
    }
    for (std::size_t i = 0; i < manoeuvre.count; ++i) {
      const Sample& sample = manoeuvre.samples[i];
      const Point2 at = inverse(sample.start_from_base) * (obstacle.at + sample.time * obstacle.velocity);
      if (outline.distance_to(at) >= required) continue;
      const Velocity& moves = sample.velocity;
      if (speed == 0.0 || outline.closing_speed(moves.linear, moves.angular, at) > params.harmless_speed) return false;
    }
  }
  return true;
}

}  // namespace

bool can_brake_in_time(const Velocity& velocity, const Velocity& command, double hold,
                       std::span<const Obstacle> obstacles, const BaseLimits& limits, double slack,
                       const BrakingParams& params) {
  const Manoeuvre manoeuvre = simulate(velocity, command, hold, limits, params);
  if (!limits.outline.empty() && !can_outline_brake(manoeuvre, obstacles, limits.outline, slack, params)) return false;
  const double duration = manoeuvre.samples[manoeuvre.count - 1].time;
  for (const auto& obstacle : obstacles) {
    if (!limits.outline.empty() && !obstacle.is_border) continue;
    const double now = norm(obstacle.at);
    const double speed = norm(obstacle.velocity);
    double required = reach_of(obstacle, limits.radius) - slack;
    if (now - speed * duration - manoeuvre.way > required) continue;
    if (speed > 0.0) {
      double walks = duration;  // who has come up to the robot stands there
      for (std::size_t i = 0; i < manoeuvre.count; ++i) {
        const Sample& sample = manoeuvre.samples[i];
        const double walked = std::min(walks, sample.time);
        const Point2 offset = obstacle.at + walked * obstacle.velocity - sample.start_from_base.position();
        const double away = norm(offset);
        if (away < limits.radius) walks = walked;
        if (away >= required) continue;
        const double towards = sample.velocity.linear * dot(unit(sample.start_from_base.theta), offset);
        if (towards > params.harmless_speed * away) return false;
      }
      continue;
    }
    // Too near already: not nearer still, but for a centimetre of noise where there is one to give.
    if (now - params.noise < required) {
      const double least = limits.radius + params.last_margin;
      required = !obstacle.is_border && now > least + params.noise ? std::max(now - params.noise, least)
                                                                   : now - params.border_noise;
    }
    for (std::size_t i = 0; i < manoeuvre.count; ++i) {
      if (distance(obstacle.at, manoeuvre.samples[i].start_from_base.position()) < required) return false;
    }
  }
  return true;
}

}  // namespace docent::collision_avoidance
