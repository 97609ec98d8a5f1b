#include "docent/planning/navigator/lost_drive.h"

#include <vector>

namespace docent::planning {

LookAroundStep LostDrive::step(const Whereabouts& where, const PoseBelief& belief, std::span<const double> clearances,
                               double reach, Time now) {
  const auto telling = [&] { return telling_place(where, belief, clearances, reach); };
  return look_around_.step(*where.odom_from_base, clearances, telling, now);
}

std::optional<Point2> LostDrive::telling_place(const Whereabouts& where, const PoseBelief& belief,
                                               std::span<const double> clearances, double reach) {
  if (!active_ || !where.map_from_odom) return std::nullopt;
  const Pose2& odom_from_base = *where.odom_from_base;
  // The hypotheses are those of the last update: odometry carries them on.
  const Pose2 moved = inverse(belief.odom_from_base) * odom_from_base;
  std::vector<PossiblePose> possible;
  for (const auto& hypothesis : belief.hypotheses)
    possible.push_back({hypothesis.map_from_base * moved, hypothesis.mass});
  std::optional<Point2> last;
  if (goal_) last = inverse(odom_from_base) * *goal_;
  const auto place = tell_apart_.best_place(possible, clearances, reach, last);
  goal_.reset();
  if (!place) return std::nullopt;
  goal_ = odom_from_base * place->goal;
  return place->in_base;
}

}  // namespace docent::planning
