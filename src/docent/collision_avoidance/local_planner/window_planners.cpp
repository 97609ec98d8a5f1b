#include "docent/collision_avoidance/local_planner/window_planners.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "docent/vocabulary/vocabulary.h"

namespace docent::collision_avoidance {

namespace {

constexpr double kBeside = -0.2;  // cosine of the bearing; what lies farther back slows nobody

Steering straight_for(Point2 carrot) {
  Steering steering;
  steering.bearing = std::atan2(carrot.y, carrot.x);
  steering.distance = norm(carrot);
  return steering;
}

LocalPlan choose(DynamicWindow& window, const LocalTask& task, Steering steering, SpeedCap cap,
                 const SharpTurnParams& turns) {
  const double turn = std::abs(steering.bearing);
  cap.lower(task.full_speed * std::clamp(turns.full_turn_cap - turn / turns.turn_scale, 0.0, 1.0), "");
  steering.speed_cap = cap.speed;
  WindowChoice choice = window.choose(task.velocity, task.last, task.obstacles, steering);
  LocalPlan plan{task};
  plan.command = choice.command;
  plan.is_braking = choice.is_braking;
  plan.cap = std::move(cap);
  plan.window = std::move(choice.window);
  return plan;
}

}  // namespace

LocalPlan PlainWindow::plan(const LocalTask& task) {
  return choose(window_, task, straight_for(task.carrot), task.cap, turns_);
}

LocalPlan CautiousWindow::plan(const LocalTask& task) {
  Steering steering = straight_for(task.carrot);
  steering.bearing = bearing_.choose(task.carrot, task.odom_from_base, task.obstacles);
  SpeedCap cap = task.cap;
  cap_by_surroundings(task.obstacles, cap);
  return choose(window_, task, steering, std::move(cap), turns_);
}

void CautiousWindow::cap_by_surroundings(std::span<const Obstacle> obstacles, SpeedCap& cap) const {
  for (const auto& obstacle : obstacles) {
    const double way = norm(obstacle.at);
    if (obstacle.is_unknown || way < 1e-6) continue;
    const double slack = slack_to(obstacle, limits_);
    const double ahead = obstacle.at.x / way;
    // The security distance grows with the speed [Buhmann1995]: read backwards, the speed with the distance. On the
    // border of its area, or beyond, the robot is slow whichever way it goes.
    if (ahead > kBeside || (obstacle.is_border && slack < 0.0)) {
      cap.lower(params_.speed_with(slack), to_text(obstacle.is_border    ? ReasonWord::border_near
                                                   : obstacle.is_virtual ? ReasonWord::hazard_near
                                                                         : ReasonWord::obstacle_near));
    }
  }
}

}  // namespace docent::collision_avoidance
