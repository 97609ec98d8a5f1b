#include "docent/collision_avoidance/dynamic_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent {

namespace {

constexpr double kStep = 0.05;         // [s] of the simulated braking
constexpr double kStandsStill = 0.08;  // [m/s] towards a person: less is no push
constexpr double kNearestReal = 0.02;  // [m] the last bit of margin is never given up

struct Sample {
  Pose2 start_from_base;
  double time = 0.0;
  double linear = 0.0;
};

/// The manoeuvre "obey, then brake": at most 64 samples; `reach` is how far the base gets from its start.
struct Manoeuvre {
  std::array<Sample, 64> samples;
  std::size_t count = 0;
  double way = 0.0;
};

Manoeuvre simulate(const Velocity& velocity, const Velocity& command, double hold, const BaseLimits& limits) {
  Manoeuvre result;
  BaseState state{{}, velocity};
  double time = 0.0;
  while (result.count < result.samples.size()) {
    const bool obeys = time < hold - 1e-9;
    const double dt = obeys ? std::min(kStep, hold - time) : kStep;
    state = advance(state, obeys ? command : Velocity{}, limits, dt);
    time += dt;
    result.way += std::abs(state.velocity.linear) * dt;
    result.samples[result.count++] = {state.odom_from_base, time, state.velocity.linear};
    if (!obeys && state.velocity.linear == 0.0) break;
  }
  result.way += std::abs(velocity.linear) * kStep;
  return result;
}

}  // namespace

Result<void> DynamicWindowParams::validate() const {
  if (!(cycle >= 0.05 && cycle <= 1.0)) return fail("avoid.window.cycle must lie between 0.05 and 1 s");
  for (const double weight : {heading_weight, clearance_weight, speed_weight, change_weight}) {
    if (!(weight >= 0.0)) return fail("avoid.window: weights must be >= 0");
  }
  if (!(heading_time > 0.0)) return fail("avoid.window.heading_time must be > 0 s");
  if (linear_steps < 3 || linear_steps > 41 || angular_steps < 3 || angular_steps > 81) {
    return fail("avoid.window: linear_steps must lie in 3..41 and angular_steps in 3..81");
  }
  if (!(real_margin >= 0.03 && virtual_margin >= 0.03)) return fail("avoid.window: margins must be >= 0.03 m");
  if (!(security_time >= 0.0)) return fail("avoid.window.security_time must be >= 0 s");
  if (!(creep_speed > 0.0 && creep_speed <= 0.3)) return fail("avoid.window.creep_speed must lie in (0, 0.3] m/s");
  return {};
}

bool can_brake_in_time(const Velocity& velocity, const Velocity& command, double hold,
                       std::span<const Obstacle> obstacles, const BaseLimits& limits, double slack) {
  const Manoeuvre manoeuvre = simulate(velocity, command, hold, limits);
  const double duration = manoeuvre.samples[manoeuvre.count - 1].time;
  for (const auto& obstacle : obstacles) {
    const double now = norm(obstacle.at);
    const double speed = norm(obstacle.velocity);
    double required = limits.radius + obstacle.margin - slack;
    if (now - speed * duration - manoeuvre.way > required) continue;
    if (speed > 0.0) {
      for (std::size_t i = 0; i < manoeuvre.count; ++i) {
        const Sample& sample = manoeuvre.samples[i];
        const Point2 offset = obstacle.at + sample.time * obstacle.velocity - sample.start_from_base.position();
        const double away = norm(offset);
        if (away >= required) continue;
        const double towards = sample.linear * dot(unit(sample.start_from_base.theta), offset);
        if (towards > kStandsStill * away) return false;
      }
      continue;
    }
    // Too near already: not nearer still, but for a centimetre of noise where there is one to give.
    if (now - 0.01 < required) {
      required =
          now > limits.radius + kNearestReal + 0.01 ? std::max(now - 0.01, limits.radius + kNearestReal) : now - 0.001;
    }
    for (std::size_t i = 0; i < manoeuvre.count; ++i) {
      if (distance(obstacle.at, manoeuvre.samples[i].start_from_base.position()) < required) return false;
    }
  }
  return true;
}

double straight_free_way(double bearing, std::span<const Obstacle> obstacles, double body_radius, double horizon) {
  const Point2 ahead = unit(Angle::radians(bearing));
  double least = horizon;
  for (const auto& obstacle : obstacles) {
    const ReachPoint turned{{dot(ahead, obstacle.at), cross(ahead, obstacle.at)}, body_radius + obstacle.margin};
    if (turned.at.x > least + turned.reach || turned.at.x < -turned.reach) continue;
    least = std::min(least, arc_distance(0.0, turned));
  }
  return least;
}

DynamicWindow::DynamicWindow(const BaseLimits& limits, const DynamicWindowParams& params)
    : limits_{limits}, params_{params} {}

double DynamicWindow::value_of(const Velocity& candidate, const Velocity& last, double free_way,
                               const Steering& steering) const {
  const double t = params_.heading_time;
  const double turn = candidate.angular * t;
  const Point2 place = candidate.linear * t * unit(Angle::radians(0.5 * turn));
  // Where the steered-for point is nearly reached its bearing tells little: look at most from half way.
  const double far = std::max(steering.distance, 2.0 * norm(place));
  const Point2 goal = far * unit(Angle::radians(steering.bearing));
  const double error = std::abs((direction(place, goal) - Angle::radians(turn)).radians());
  const double heading = 1.0 - error / std::numbers::pi;
  const double speed = std::max(steering.speed_cap, 0.1);
  const double progress = candidate.linear * std::cos(error) / speed;
  const double clearance = std::min(free_way, 2.0) / 2.0;
  const double change = std::abs(candidate.linear - last.linear) / limits_.max_speed +
                        std::abs(candidate.angular - last.angular) / limits_.max_turn_rate;
  return params_.heading_weight * heading + params_.speed_weight * progress + params_.clearance_weight * clearance -
         params_.change_weight * change;
}

void DynamicWindow::smooth(std::vector<EvaluatedVelocity>& window, int rows, int columns) const {
  // A good velocity whose neighbours are bad is one that noise made: mean of the admissible 3 x 3 neighbours.
  const auto raw = window;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto here =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
      if (raw[here].value < 0.0) continue;
      double sum = 4.0 * raw[here].value;
      double weight = 4.0;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          const int r = row + dr;
          const int c = column + dc;
          if ((dr == 0 && dc == 0) || r < 0 || c < 0 || r >= rows || c >= columns) continue;
          sum += std::max(
              0.0,
              raw[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)].value);
          weight += 1.0;
        }
      }
      window[here].value = sum / weight;
    }
  }
}

WindowChoice DynamicWindow::choose(const Velocity& velocity, const Velocity& last, std::span<const Obstacle> obstacles,
                                   const Steering& steering) {
  reach_points_.clear();
  for (const auto& obstacle : obstacles) {
    // A thing that comes nearer is met half way; one that goes away is taken as standing.
    const double way = norm(obstacle.at);
    const double closing = way > 0.0 ? std::max(0.0, -dot(obstacle.velocity, obstacle.at) / way) : 0.0;
    const double nearer = way > 0.0 ? std::max(0.2, 1.0 - closing * 0.5 / way) : 1.0;
    reach_points_.push_back({nearer * obstacle.at, limits_.radius + obstacle.margin});
  }
  const double cycle = params_.cycle;
  const double cap = std::clamp(steering.speed_cap, 0.0, limits_.max_speed);
  const double floor = steering.may_reverse ? -params_.creep_speed : 0.0;
  const double slowest = std::max(floor, velocity.linear - limits_.deceleration * cycle);
  const double low = std::min(slowest, std::max(cap, velocity.linear - limits_.deceleration * cycle));
  const double high = std::max(low, std::min(cap, velocity.linear + limits_.acceleration * cycle));
  const double turn = limits_.turn_acceleration * cycle;
  const double left = std::min(limits_.max_turn_rate, velocity.angular + turn);
  const double right = std::max(-limits_.max_turn_rate, velocity.angular - turn);

  forwards_.build(reach_points_, false);
  if (low < 0.0) backwards_.build(reach_points_, true);

  const double steered_way = straight_free_way(steering.bearing, obstacles, limits_.radius, 2.0);
  WindowChoice choice;
  const int rows = params_.linear_steps;
  const int columns = params_.angular_steps;
  choice.window.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int row = 0; row < rows; ++row) {
    const double linear = low + (high - low) * row / (rows - 1);
    for (int column = 0; column < columns; ++column) {
      const double angular = right + (left - right) * column / (columns - 1);
      EvaluatedVelocity& candidate = choice.window.emplace_back(EvaluatedVelocity{{linear, angular}, -1.0});
      const double free_way = (linear < 0.0 ? backwards_ : forwards_).free_way(linear, angular);
      const double stopping = std::abs(linear) * hold() + linear * linear / (2.0 * limits_.deceleration);
      if (stopping > free_way) continue;
      // On the spot every way is free: what counts is the way that is turned to.
      const double clearance = std::abs(linear) < 0.03 ? steered_way : free_way;
      candidate.value = std::max(1e-6, value_of(candidate.velocity, last, clearance, steering));
    }
  }
  smooth(choice.window, rows, columns);

  // The closed form takes the velocity as reached at once. The few best are checked with the real dynamics: kept until
  // the watchdog bites, and braked at the next scan.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < choice.window.size(); ++i) {
    if (choice.window[i].value >= 0.0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return choice.window[a].value > choice.window[b].value; });
  constexpr std::size_t kTries = 60;
  std::size_t tried = 0;
  // Of many refused ones only every so many is tried, so that the slow end of the window has its turn.
  for (std::size_t k = 0; k < order.size() && tried < kTries; k += 1 + tried / 8, ++tried) {
    EvaluatedVelocity& candidate = choice.window[order[k]];
    if (can_brake_in_time(velocity, candidate.velocity, hold(), obstacles, limits_, 0.0) &&
        can_brake_in_time(velocity, candidate.velocity, 0.1, obstacles, limits_, 0.0)) {
      choice.command = candidate.velocity;
      return choice;
    }
    candidate.value = -1.0;
  }
  // Standing still or turning on the spot is always right where it can be reached.
  choice.is_braking = true;
  if (std::abs(velocity.linear) < 0.02) {
    const double wanted = std::clamp(steering.bearing / params_.heading_time, right, left);
    choice.command = {0.0, wanted};
    choice.is_braking = false;
  }
  return choice;
}

}  // namespace docent
