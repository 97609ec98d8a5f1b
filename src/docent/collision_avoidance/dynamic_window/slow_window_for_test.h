#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "docent/collision_avoidance/body/braking.h"
#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"

namespace docent::collision_avoidance {

/// The dynamic window as one would write it down: for every velocity the closed form of the arc to every point. The
/// slow, obvious twin of DynamicWindow::choose, for its tests and its benchmark.
class SlowWindow {
 public:
  SlowWindow(const BaseLimits& limits, const DynamicWindowParams& params) : limits_{limits}, params_{params} {}

  [[nodiscard]] WindowChoice choose(const Velocity& velocity, const Velocity& last, std::span<const Obstacle> obstacles,
                                    const Steering& steering) const {
    const double cycle = params_.cycle;
    const double cap = std::clamp(steering.speed_cap, 0.0, limits_.max_speed);
    const double braked = velocity.linear - limits_.deceleration * cycle;
    const double low =
        std::min(std::max(steering.may_reverse ? -params_.creep_speed : 0.0, braked), std::max(cap, braked));
    const double high = std::max(low, std::min(cap, velocity.linear + limits_.acceleration * cycle));
    const double turn = limits_.turn_acceleration * cycle;
    const double left = std::min(limits_.max_turn_rate, velocity.angular + turn);
    const double right = std::max(-limits_.max_turn_rate, velocity.angular - turn);
    const double steered_way = straight_free_way(steering.bearing, obstacles, limits_.radius, 2.0);

    std::vector<EvaluatedVelocity> raw;
    for (int row = 0; row < params_.linear_steps; ++row) {
      for (int column = 0; column < params_.angular_steps; ++column) {
        const double linear = low + (high - low) * row / (params_.linear_steps - 1);
        const double angular = right + (left - right) * column / (params_.angular_steps - 1);
        const double way = free_way(linear, angular, obstacles);
        double least = std::abs(linear) * (limits_.watchdog + 0.05) + linear * linear / (2.0 * limits_.deceleration);
        if (params_.two_second_rule) least = std::max(least, 2.0 * std::abs(linear));
        raw.push_back({{linear, angular}, -1.0});
        if (way < least) continue;
        const double clearance = std::abs(linear) < 0.03 ? steered_way : way;
        raw.back().value = std::max(1e-6, value_of(raw.back().velocity, last, clearance, steering));
      }
    }
    WindowChoice choice;
    choice.window = smoothed(raw);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i].value >= 0.0) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return choice.window[a].value > choice.window[b].value; });
    const double hold = limits_.watchdog + 0.05;
    for (std::size_t k = 0, tried = 0; k < order.size() && tried < 60; k += 1 + tried / 8, ++tried) {
      const Velocity& candidate = choice.window[order[k]].velocity;
      if (!can_brake_in_time(velocity, candidate, hold, obstacles, limits_, 0.0) ||
          !can_brake_in_time(velocity, candidate, 0.1, obstacles, limits_, 0.0))
        continue;
      choice.command = candidate;
      return choice;
    }
    choice.is_braking = std::abs(velocity.linear) >= 0.02;
    if (!choice.is_braking) choice.command = {0.0, std::clamp(steering.bearing / params_.heading_time, right, left)};
    return choice;
  }

 private:
  [[nodiscard]] double free_way(double linear, double angular, std::span<const Obstacle> obstacles) const {
    double least = FreeWays::kHorizon;
    if (std::abs(linear) < 1e-6) return least;
    const double curvature = std::clamp(angular / linear, -FreeWays::kMaxCurvature, FreeWays::kMaxCurvature);
    for (const auto& obstacle : obstacles) {
      const double side = linear < 0.0 ? -1.0 : 1.0;
      const ReachPoint point{{side * obstacle.at.x, obstacle.at.y}, limits_.radius + obstacle.margin};
      least = std::min(least, arc_distance(curvature, point));
    }
    return least;
  }

  [[nodiscard]] double value_of(const Velocity& candidate, const Velocity& last, double way,
                                const Steering& steering) const {
    const double t = params_.heading_time;
    const double turn = candidate.angular * t;
    const Point2 place = candidate.linear * t * unit(Angle::radians(0.5 * turn));
    const double far = std::max(steering.distance, 2.0 * norm(place));
    const Point2 goal = far * unit(Angle::radians(steering.bearing));
    const double error = std::abs((direction(place, goal) - Angle::radians(turn)).radians());
    const double change = std::abs(candidate.linear - last.linear) / limits_.max_speed +
                          std::abs(candidate.angular - last.angular) / limits_.max_turn_rate;
    return params_.heading_weight * (1.0 - error / std::numbers::pi) +
           params_.speed_weight * candidate.linear * std::cos(error) / std::max(steering.speed_cap, 0.1) +
           params_.clearance_weight * std::min(way, 2.0) / 2.0 - params_.change_weight * change;
  }

  [[nodiscard]] std::vector<EvaluatedVelocity> smoothed(const std::vector<EvaluatedVelocity>& raw) const {
    auto result = raw;
    const int rows = params_.linear_steps;
    const int columns = params_.angular_steps;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        auto& here = result[static_cast<std::size_t>(row * columns + column)];
        if (here.value < 0.0) continue;
        double sum = 3.0 * here.value;
        double weight = 3.0;
        for (const int r : {row, row - 1, row + 1}) {  // in this order, so that ties stay ties
          if (r < 0 || r >= rows) continue;
          double three = 0.0;
          for (int c = std::max(0, column - 1); c <= std::min(columns - 1, column + 1); ++c) {
            three += std::max(0.0, raw[static_cast<std::size_t>(r * columns + c)].value);
            weight += 1.0;
          }
          sum += three;
        }
        here.value = sum / weight;
      }
    }
    return result;
  }

  BaseLimits limits_;
  DynamicWindowParams params_;
};

}  // namespace docent::collision_avoidance
