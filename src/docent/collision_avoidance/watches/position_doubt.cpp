#include "docent/collision_avoidance/watches/position_doubt.h"

#include <cmath>

namespace docent::collision_avoidance {

std::optional<Complaint> PositionDoubt::judge(const BeliefOutline& belief) const {
  if (!belief.localized || belief.hypotheses.empty())
    return Complaint{params_.unknown_speed, "the position is not known"};
  if (belief.p_lost > params_.doubtful) return Complaint{params_.crippled_speed, "the position is doubtful"};
  const BelievedPose& best = belief.hypotheses.front();
  for (const BelievedPose& other : belief.hypotheses.subspan(1)) {
    const Pose2 between = inverse(best.map_from_robot) * other.map_from_robot;
    const bool elsewhere =
        norm(between.position()) > params_.rival_way || std::abs(between.theta.radians()) > params_.rival_turn;
    if (elsewhere && other.mass >= params_.rival_share * best.mass)
      return Complaint{params_.crippled_speed, "it may be in two places"};
  }
  if (const auto off = mean_offset(best.map_from_robot, belief.cells, params_)) {
    if (norm(off->position()) > params_.off || std::abs(off->theta.radians()) > params_.off_turn)
      return Complaint{params_.crippled_speed, "the best pose is not where the belief is"};
  }
  return std::nullopt;
}

std::optional<Pose2> mean_offset(const Pose2& pose, std::span<const BelievedPose> cells,
                                 const PositionDoubtParams& params) {
  double mass = 0.0;
  Point2 sum;
  double turn = 0.0;
  for (const BelievedPose& cell : cells) {
    const Point2 apart = cell.map_from_robot.position() - pose.position();
    const double turned = (cell.map_from_robot.theta - pose.theta).radians();
    if (norm(apart) > params.near || std::abs(turned) > params.near_turn) continue;
    mass += cell.mass;
    sum = sum + cell.mass * apart;
    turn += cell.mass * turned;
  }
  if (mass < params.least_mass) return std::nullopt;
  const Point2 mean = (1.0 / mass) * sum;
  return Pose2{mean.x, mean.y, Angle::radians(turn / mass)};
}

void PositionDoubt::believe(const BeliefOutline& belief) {
  const auto now = judge(belief);
  const bool stays = now && before_ && now->reason == before_->reason;
  const bool at_once = now && (!belief.localized || belief.p_lost > params_.doubtful);
  if (stays || at_once || !now) complaint_ = now;
  before_ = now;
}

}  // namespace docent::collision_avoidance
