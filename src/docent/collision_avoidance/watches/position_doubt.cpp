#include "docent/collision_avoidance/watches/position_doubt.h"

#include <cmath>
#include <numbers>

namespace docent {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kUnknownSpeed = 0.4;  // [m/s] looking around
constexpr double kDoubtful = 0.5;      // P(lost)
constexpr double kRivalShare = 1.0 / 3.0;
constexpr double kRivalWay = 0.5;  // [m] nearer modes are one place
constexpr double kRivalTurn = 20.0 * kDegree;
constexpr double kOff = 0.2;  // [m]
constexpr double kOffTurn = 6.5 * kDegree;

std::optional<Complaint> judge(const BeliefOutline& belief) {
  if (!belief.localized || belief.hypotheses.empty()) return Complaint{kUnknownSpeed, "the position is not known"};
  if (belief.p_lost > kDoubtful) return Complaint{kCrippledSpeed, "the position is doubtful"};
  const BelievedPose& best = belief.hypotheses.front();
  for (const BelievedPose& other : belief.hypotheses.subspan(1)) {
    const Pose2 between = inverse(best.map_from_robot) * other.map_from_robot;
    const bool elsewhere = norm(between.position()) > kRivalWay || std::abs(between.theta.radians()) > kRivalTurn;
    if (elsewhere && other.mass >= kRivalShare * best.mass) return Complaint{kCrippledSpeed, "it may be in two places"};
  }
  if (const auto off = mean_offset(best.map_from_robot, belief.cells)) {
    if (norm(off->position()) > kOff || std::abs(off->theta.radians()) > kOffTurn)
      return Complaint{kCrippledSpeed, "the best pose is not where the belief is"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Pose2> mean_offset(const Pose2& pose, std::span<const BelievedPose> cells) {
  constexpr double kNear = 1.5;  // [m]
  constexpr double kNearTurn = 45.0 * kDegree;
  constexpr double kLeast = 0.1;
  double mass = 0.0;
  Point2 sum;
  double turn = 0.0;
  for (const BelievedPose& cell : cells) {
    const Point2 apart = cell.map_from_robot.position() - pose.position();
    const double turned = (cell.map_from_robot.theta - pose.theta).radians();
    if (norm(apart) > kNear || std::abs(turned) > kNearTurn) continue;
    mass += cell.mass;
    sum = sum + cell.mass * apart;
    turn += cell.mass * turned;
  }
  if (mass < kLeast) return std::nullopt;
  const Point2 mean = (1.0 / mass) * sum;
  return Pose2{mean.x, mean.y, Angle::radians(turn / mass)};
}

void PositionDoubt::believe(const BeliefOutline& belief) {
  const auto now = judge(belief);
  const bool stays = now && before_ && now->reason == before_->reason;
  const bool at_once = now && (!belief.localized || belief.p_lost > kDoubtful);
  if (stays || at_once || !now) complaint_ = now;
  before_ = now;
}

}  // namespace docent
