#include "docent/localization/belief/pose_fix.h"

#include <algorithm>
#include <cmath>

namespace docent::localization {
namespace {

constexpr double kLeastSigma = 0.08;      // [m]: as fine as the belief's states
constexpr double kLeastTurnSigma = 0.06;  // [rad] likewise
constexpr double kMostNats = 6.0;         // [nat] that a fix counts
constexpr double kWorthIt = 0.05;         // P(wrong) of a fix that is heard

}  // namespace

std::optional<PoseFix> FixEvidence::at(Time time, const Pose2& odom_from_robot) const {
  if (!fix_ || std::abs(to_seconds(time - fix_->time)) > kOldest) return std::nullopt;
  const Pose2 moved = inverse(fix_->odom_from_robot) * odom_from_robot;
  if (norm(moved.position()) > kFarthest) return std::nullopt;
  PoseFix now = *fix_;
  now.map_from_robot = fix_->map_from_robot * moved;
  now.odom_from_robot = odom_from_robot;
  now.time = time;
  return now;
}

bool FixEvidence::observe(const ObservationMoment& moment) {
  if (is_used_) return false;
  const auto now = at(moment.time, moment.odom_from_robot);
  if (!now || now->p_wrong > kWorthIt) return false;
  is_used_ = true;
  expected_ = now->map_from_robot;
  const double variance = std::max(kLeastSigma * kLeastSigma, 0.5 * (now->covariance[0] + now->covariance[4]));
  place_ = 0.5 / variance;
  heading_ = 0.5 / std::max(kLeastTurnSigma * kLeastTurnSigma, now->covariance[8]);
  most_ = std::min(kMostNats, -std::log(std::max(now->p_wrong, 1e-9)));
  return true;
}

void FixEvidence::add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const {
  for (std::size_t i = 0; i < nats.size(); ++i) {
    const Point2 off = map_from_robot[i].position() - expected_.position();
    const double turn = (map_from_robot[i].theta - expected_.theta).radians();
    nats[i] += static_cast<float>(std::min(most_, place_ * dot(off, off) + heading_ * turn * turn));
  }
}

}  // namespace docent::localization
