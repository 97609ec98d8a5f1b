#include "docent/collision_avoidance/crowd_steering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent {
namespace {

constexpr int kHeadings = 31;
constexpr double kWidest = 1.9;      // [rad] that is turned through at most by who may also drive tail first
constexpr double kMostChange = 1.0;  // [rad] a change by more costs no more
constexpr int kLeastSteps = 3;       // of a rollout
constexpr double kRemembered = 4.5;  // [m]
constexpr double kStandCell = 0.15;  // [m]
constexpr std::array<double, 4> kSpeeds{0.25, 0.5, 0.75, 1.0};  // shares of the cap
constexpr double kRolledOut = 2.4;                              // [s]
constexpr double kStands = 0.05;                                // [m/s]
constexpr double kRecovers = 2.0;                               // driving gives patience back so much faster
constexpr double kLongest = 4.0;                                // patiences
constexpr double kOpening = 0.5;                                // [m] so far on lies what is turned to while waiting

/// How much of its speed the base drives while it still has so far to turn; on the spot when the way lies behind.
double share_while_turning(double error) { return std::clamp(1.35 - std::abs(error) / 1.1, 0.0, 1.0); }

/// The same base, its back taken for its front.
BaseState turned_round(const BaseState& state) {
  Pose2 odom_from_back = state.odom_from_base;
  odom_from_back.theta = odom_from_back.theta + Angle::radians(std::numbers::pi);
  return {odom_from_back, {-state.velocity.linear, state.velocity.angular}};
}

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
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= steps; ++k) {
    const double error = (wanted - heading).radians();
    const double turn = std::clamp(error, -limits_.max_turn_rate * kDt, limits_.max_turn_rate * kDt);
    const double aimed = speed * share_while_turning(error);
    linear += std::clamp(aimed - linear, -limits_.deceleration * kDt, limits_.acceleration * kDt);
    at = at + (linear * kDt) * unit(heading + Angle::radians(0.5 * turn));
    heading = heading + Angle::radians(turn);
    cost += kDt * (1.0 + field_.cost(k, at));
    // From any moment on the way may bend.
    if (k >= kLeastSteps) least = std::min(least, cost + field_.value(k, at));
  }
  return least;
}

void CrowdSteering::place(const Pose2& odom_from_base, std::span<const Obstacle> obstacles) {
  in_odom_.clear();
  for (const auto& obstacle : obstacles) {
    Obstacle placed = obstacle;
    placed.at = odom_from_base * obstacle.at;
    placed.velocity = odom_from_base * obstacle.velocity - odom_from_base.position();
    in_odom_.push_back(placed);
  }
}

std::size_t CrowdSteering::index_of(Point2 in_odom) {
  const auto wrapped = [](double value) { return static_cast<std::size_t>(std::lround(value / kStandCell) & 63); };
  return wrapped(in_odom.y) * 64 + wrapped(in_odom.x);
}

void CrowdSteering::remember(Point2 robot, double cycle) {
  constexpr std::size_t kDirections = 180;
  constexpr double kToIndex = kDirections / (2.0 * std::numbers::pi);
  constexpr double kBehind = 0.2;  // [m]
  std::array<double, kDirections> seen{};
  seen.fill(std::numeric_limits<double>::infinity());
  const auto towards = [&](Point2 at) {
    const Point2 offset = at - robot;
    return static_cast<std::size_t>((std::atan2(offset.y, offset.x) + std::numbers::pi) * kToIndex) % kDirections;
  };
  for (const auto& obstacle : in_odom_) {
    if (obstacle.is_virtual) continue;
    double& range = seen[towards(obstacle.at)];
    range = std::min(range, distance(obstacle.at, robot));
  }
  const Stands before = stands_;
  for (Stand& stand : stands_) {
    if (stand.stood == 0.0) continue;
    const double away = distance(stand.at, robot);
    const bool is_hidden = away > seen[towards(stand.at)] + kBehind && away < kRemembered;
    stand.hidden += cycle;
    if (!is_hidden || stand.stood < params_.stands || stand.hidden > params_.memory) stand = {};
  }
  for (auto& obstacle : in_odom_) {
    if (obstacle.is_virtual || norm(obstacle.velocity) > params_.walks) continue;
    double stood = 0.0;
    for (const double dy : {-kStandCell, 0.0, kStandCell}) {
      for (const double dx : {-kStandCell, 0.0, kStandCell}) {
        const Stand& near = before[index_of(obstacle.at + Point2{dx, dy})];
        if (near.stood > stood && distance(near.at, obstacle.at) < kRemembered) stood = near.stood;
      }
    }
    obstacle.stood = stood + cycle;
    stands_[index_of(obstacle.at)] = {obstacle.at, obstacle.stood, 0.0};
  }
  for (const Stand& stand : stands_) {
    if (stand.hidden > 0.0) in_odom_.push_back({stand.at, {}, 0.0, true, false, stand.stood});
  }
}

CrowdAdvice CrowdSteering::steer(const BaseState& start, std::span<const Obstacle> obstacles, const CrowdPath& path,
                                 double speed_cap, double cycle) {
  const Pose2& odom_from_base = start.odom_from_base;
  place(odom_from_base, obstacles);
  remember(odom_from_base.position(), cycle);
  // Who has stood for long becomes less shy: personal space is kept where it can be, not at the price of never going
  // on.
  const bool stands = std::abs(start.velocity.linear) < kStands;
  stood_ = std::clamp(stood_ + (stands ? cycle : -kRecovers * cycle), 0.0, kLongest * params_.patience);
  field_.build(odom_from_base.position(), in_odom_, path, params_.patience / (params_.patience + stood_));

  CrowdAdvice best;
  best.waits = true;
  double least = cost_of(start, 0.0, 0.0);
  Angle towards = odom_from_base.theta;
  const double widest = limits_.outline.empty() ? kWidest : std::numbers::pi;
  for (const bool tail_first : {false, true}) {
    if (tail_first && !limits_.outline.empty()) continue;
    const BaseState facing = tail_first ? turned_round(start) : start;
    for (int i = 0; i < kHeadings; ++i) {
      const double bearing = widest * (2.0 * i / (kHeadings - 1) - 1.0);
      const Angle in_odom = facing.odom_from_base.theta + Angle::radians(bearing);
      const double change =
          last_in_odom_ ? params_.change_weight * std::min(kMostChange, std::abs((in_odom - *last_in_odom_).radians()))
                        : 0.0;
      for (const double share : kSpeeds) {
        const double cost = change + cost_of(facing, bearing, share * speed_cap);
        if (cost >= least) continue;
        least = cost;
        best = {bearing, share * speed_cap, false, tail_first};
        towards = in_odom;
      }
    }
  }
  if (best.waits) {
    if (const auto opening = field_.way_on(odom_from_base.position(), kOpening)) {
      towards = direction(odom_from_base.position(), *opening);
      best.bearing = (towards - odom_from_base.theta).radians();
      best.tail_first = limits_.outline.empty() && std::abs(best.bearing) > 0.5 * std::numbers::pi;
      if (best.tail_first) best.bearing = Angle::radians(best.bearing + std::numbers::pi).radians();
    }
  }
  last_in_odom_ = towards;
  return best;
}

}  // namespace docent
