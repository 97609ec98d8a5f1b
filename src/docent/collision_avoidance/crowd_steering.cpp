#include "docent/collision_avoidance/crowd_steering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent {
namespace {

constexpr int kHeadings = 48;
constexpr std::array<double, 4> kSpeeds{0.25, 0.5, 0.75, 1.0};  // shares of the cap
constexpr double kRolledOut = 2.4;                              // [s]
constexpr double kStands = 0.05;                                // [m/s]
constexpr double kRecovers = 2.0;                               // driving gives patience back so much faster
constexpr double kLongest = 4.0;                                // patiences
constexpr double kOpening = 0.5;                                // [m] so far on lies what is turned to while waiting

/// How much of its speed the base drives while it still has so far to turn; on the spot when the way lies behind.
double share_while_turning(double error) { return std::clamp(1.35 - std::abs(error) / 1.1, 0.0, 1.0); }

}  // namespace

CrowdSteering::CrowdSteering(const BaseLimits& limits, const CrowdFitParams& params)
    : limits_{limits}, params_{params}, field_{params, limits.radius} {}

double CrowdSteering::cost_of(const BaseState& start, double bearing, double speed) const {
  constexpr double kDt = CrowdField::kStep;
  const int steps = std::min(field_.layers(), static_cast<int>(std::lround(kRolledOut / kDt)));
  Point2 at = start.odom_from_base.position();
  Angle heading = start.odom_from_base.theta;
  const Angle wanted = heading + Angle::radians(bearing);
  double linear = start.velocity.linear;
  double cost = 0.0;
  for (int k = 1; k <= steps; ++k) {
    const double error = (wanted - heading).radians();
    const double turn = std::clamp(error, -limits_.max_turn_rate * kDt, limits_.max_turn_rate * kDt);
    const double aimed = speed * share_while_turning(error);
    linear += std::clamp(aimed - linear, -limits_.deceleration * kDt, limits_.acceleration * kDt);
    at = at + (linear * kDt) * unit(heading + Angle::radians(0.5 * turn));
    heading = heading + Angle::radians(turn);
    cost += kDt * (1.0 + field_.cost(k, at));
  }
  return cost + field_.value(steps, at);
}

CrowdAdvice CrowdSteering::steer(const BaseState& start, std::span<const Obstacle> obstacles, const CrowdPath& path,
                                 double speed_cap, double cycle) {
  const Pose2& odom_from_base = start.odom_from_base;
  in_odom_.clear();
  for (const auto& obstacle : obstacles) {
    Obstacle placed = obstacle;
    placed.at = odom_from_base * obstacle.at;
    placed.velocity = odom_from_base * obstacle.velocity - odom_from_base.position();
    in_odom_.push_back(placed);
  }
  // Who has stood for long becomes less shy: personal space is kept where it can be, not at the price of never going
  // on.
  const bool stands = std::abs(start.velocity.linear) < kStands;
  stood_ = std::clamp(stood_ + (stands ? cycle : -kRecovers * cycle), 0.0, kLongest * params_.patience);
  field_.build(odom_from_base.position(), in_odom_, path, params_.patience / (params_.patience + stood_));

  CrowdAdvice best;
  best.waits = true;
  double least = cost_of(start, 0.0, 0.0);
  for (int i = 0; i < kHeadings; ++i) {
    const double bearing = Angle::radians(2.0 * std::numbers::pi * i / kHeadings).radians();
    double change = 0.0;
    if (last_in_odom_)
      change =
          params_.change_weight * std::abs((odom_from_base.theta + Angle::radians(bearing) - *last_in_odom_).radians());
    for (const double share : kSpeeds) {
      const double cost = change + cost_of(start, bearing, share * speed_cap);
      if (cost >= least) continue;
      least = cost;
      best = {bearing, share * speed_cap, false};
    }
  }
  if (best.waits) {
    if (const auto opening = field_.way_on(odom_from_base.position(), kOpening))
      best.bearing = (direction(odom_from_base.position(), *opening) - odom_from_base.theta).radians();
  }
  last_in_odom_ = odom_from_base.theta + Angle::radians(best.bearing);
  return best;
}

}  // namespace docent
