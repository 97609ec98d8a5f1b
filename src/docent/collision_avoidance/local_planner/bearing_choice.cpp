#include "docent/collision_avoidance/local_planner/bearing_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::collision_avoidance {

bool BearingChoice::must_slide_off(double bearing, std::span<const Obstacle> obstacles) const {
  bool is_held = false;
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_unknown || straight_free_way(bearing, {&obstacle, 1}, radius_, 1.0) >= params_.begins) continue;
    const double off = std::abs(Angle::radians(std::atan2(obstacle.at.y, obstacle.at.x) - bearing).radians());
    if (off < params_.ahead && !obstacle.is_virtual) return false;
    is_held = true;
  }
  return is_held;
}

double BearingChoice::best_near(double wanted, double need, const Pose2& odom_from_base,
                                std::span<const Obstacle> obstacles) const {
  const bool slides = must_slide_off(wanted, obstacles);
  double best = wanted;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -params_.steps; i <= params_.steps; ++i) {
    const double bearing = wanted + i * params_.step;
    const double way = straight_free_way(bearing, obstacles, radius_, need);
    double cost = std::abs(i) * params_.step + params_.way_weight * (1.0 - way / need);
    if (slides && way < params_.begins) cost += params_.none;
    if (chosen_in_odom_) {
      const Angle in_odom = odom_from_base.theta + Angle::radians(bearing);
      cost += params_.change_weight * std::abs((in_odom - *chosen_in_odom_).radians());
    }
    if (cost < least) {
      least = cost;
      best = bearing;
    }
  }
  return best;
}

double BearingChoice::choose(Point2 wanted_in_base, const Pose2& odom_from_base, std::span<const Obstacle> obstacles) {
  const double wanted = std::atan2(wanted_in_base.y, wanted_in_base.x);
  const double need = std::clamp(norm(wanted_in_base), params_.least_way, params_.most_way);
  const double best = best_near(wanted, need, odom_from_base, obstacles);
  chosen_in_odom_ = odom_from_base.theta + Angle::radians(best);
  const double bearing = Angle::radians(best).radians();
  if (std::abs(bearing) < params_.beside) turning_side_ = 0.0;
  if (std::abs(bearing) < params_.behind) return bearing;
  if (turning_side_ == 0.0) turning_side_ = std::copysign(1.0, bearing);
  return turning_side_ * params_.behind;
}

}  // namespace docent::collision_avoidance
