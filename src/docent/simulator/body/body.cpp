#include "docent/simulator/body/body.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

/// Moves `value` towards `wanted`: at most `faster` away from zero, `slower` towards it.
double approach(double value, double wanted, double faster, double slower) {
  if (value * wanted < 0.0) wanted = 0.0;  // through a stop first
  const double change = wanted - value;
  const double limit = std::abs(wanted) > std::abs(value) ? faster : slower;
  return value + std::clamp(change, -limit, limit);
}

}  // namespace

Body::Body(const BodyParams& params, const Pose2& start, const Rng& rng) : params_{params}, rng_{rng}, pose_{start} {
  latency_ = params.latency * rng_.uniform(1.0 - params.latency_spread, 1.0 + params.latency_spread);
  const double common = rng_.uniform(-params.scale_error, params.scale_error);
  left_scale_ = 1.0 + common + rng_.uniform(-params.wheel_error, params.wheel_error);
  right_scale_ = 1.0 + common + rng_.uniform(-params.wheel_error, params.wheel_error);
  base_scale_ = 1.0 + rng_.uniform(-params.base_error, params.base_error);
}

void Body::command(Time now, double linear, double angular) {
  last_command_ = now;
  commands_.push_back(
      {now + seconds(latency_), std::isfinite(linear) ? linear : 0.0, std::isfinite(angular) ? angular : 0.0});
}

double Body::stopping_distance(double reaction) const {
  return std::abs(linear_) * reaction + linear_ * linear_ / (2.0 * params_.deceleration);
}

void Body::step(Time now, double dt, bool has_power) {
  while (!commands_.empty() && commands_.front().due <= now) {
    wanted_linear_ = std::clamp(commands_.front().linear, -params_.max_speed, params_.max_speed);
    wanted_angular_ = std::clamp(commands_.front().angular, -params_.max_turn_rate, params_.max_turn_rate);
    commands_.pop_front();
  }
  if (!has_power || now - last_command_ > seconds(params_.watchdog)) {
    wanted_linear_ = 0.0;
    wanted_angular_ = 0.0;
    commands_.clear();
  }
  const double before = linear_;
  linear_ = approach(linear_, wanted_linear_, params_.acceleration * dt, params_.deceleration * dt);
  angular_ = approach(angular_, wanted_angular_, params_.turn_acceleration * dt, params_.turn_acceleration * dt);
  const double slowed = std::abs(before) - std::abs(linear_);
  is_braking_ = std::abs(linear_) < 0.02 || slowed >= 0.95 * params_.deceleration * dt;

  // The floor is smooth: hard acceleration loses a little of the way.
  const double effort = std::min(1.0, std::abs(linear_ - before) / (params_.deceleration * dt));
  const double lost = effort > 0.0 ? params_.slip * effort * rng_.uniform() : 0.0;
  const double middle = angular_ * dt / 2.0;
  const double travel = linear_ * dt;
  pose_ = pose_ * Pose2{travel * (1.0 - lost) * std::cos(middle), travel * (1.0 - lost) * std::sin(middle),
                        Angle::radians(angular_ * dt)};

  if (linear_ == 0.0 && angular_ == 0.0) return;
  const double half_base = params_.wheel_base / 2.0;
  const auto measured = [&](double wheel, double scale) {
    return wheel * scale + rng_.normal(0.0, params_.travel_noise * std::sqrt(std::abs(wheel)));
  };
  // Encoders are finer than slip and play: what noise they share is noise of the way, not of the heading, so the
  // heading's noise is drawn apart.
  const double left = measured(travel - half_base * angular_ * dt, left_scale_);
  const double right = measured(travel + half_base * angular_ * dt, right_scale_);
  const double systematic =
      (travel + half_base * angular_ * dt) * right_scale_ - (travel - half_base * angular_ * dt) * left_scale_;
  const double turned =
      systematic / (params_.wheel_base * base_scale_) +
      rng_.normal(0.0, params_.turn_noise * std::sqrt(std::abs(angular_) * dt + 0.1 * std::abs(travel)));
  const double driven = (left + right) / 2.0;
  odom_ = odom_ * Pose2{driven * std::cos(turned / 2.0), driven * std::sin(turned / 2.0), Angle::radians(turned)};
}

}  // namespace docent::simulator
