#include "docent/localization/localizer/update_cadence.h"

#include <algorithm>
#include <cmath>

namespace docent::localization {
namespace {

constexpr double kStands = 0.005;  // [m] or [rad]: less is the odometry's noise

}  // namespace

Motion::Motion(const Pose2& step)
    : before_from_after{step}, way{norm(step.position())}, turn{std::abs(step.theta.radians())} {}

double UpdateCadence::weight(const Motion& motion, Time now) const {
  if (waited(now) * params_.work_per_second < last_work_) return 0.0;
  const double moved = std::max(motion.way / params_.update_way, motion.turn / (params_.update_turn * kDegree));
  const bool shows_news = motion.way >= params_.update_way || !goes_round() || waited(now) >= params_.creeping_period;
  if (moved >= 1.0) return shows_news ? 1.0 : 0.0;
  const bool stands = motion.way < kStands && motion.turn < kStands;
  if (waited(now) < (stands ? params_.standing_period : params_.creeping_period)) return 0.0;
  return std::max(moved, params_.standing_weight);
}

void UpdateCadence::begin(const Motion& motion, Point2 position, Time now) {
  last_update_ = now;
  if (distance(position, turns_at_) >= params_.update_way) {
    turns_at_ = position;
    turned_here_ = 0.0;
  }
  turned_here_ += motion.turn;
}

}  // namespace docent::localization
