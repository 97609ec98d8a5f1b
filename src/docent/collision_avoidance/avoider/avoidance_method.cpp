#include "docent/collision_avoidance/avoider/avoidance_method.h"

#include <algorithm>
#include <cmath>

#include "docent/vocabulary/vocabulary.h"

namespace docent::collision_avoidance {

namespace {

Steering straight_for(Point2 carrot) {
  Steering steering;
  steering.bearing = std::atan2(carrot.y, carrot.x);
  steering.distance = norm(carrot);
  return steering;
}

}  // namespace

Obstacle PlainWindow::obstacle_of(const SensedPoint& point) const {
  return {point.at, {}, margin_, point.known.person, false};
}

Steering PlainWindow::steer(Point2 carrot, const Pose2& /*odom_from_base*/, std::span<const Obstacle> /*obstacles*/,
                            SpeedCap& /*cap*/) const {
  return straight_for(carrot);
}

std::optional<Velocity> PlainWindow::slowed_for_people(const Velocity& /*command*/,
                                                       std::span<const Obstacle> /*obstacles*/) const {
  return std::nullopt;
}

Obstacle CautiousWindow::obstacle_of(const SensedPoint& point) const {
  const bool moves = point.known.velocity != Point2{};
  bool person = point.known.person;
  bool may_step = moves || !point.known.straight;
  if (point.unmapped != nullptr && !moves && (person || point.away < point.steps_in)) {
    may_step = point.unmapped->is_near(point.known.in_odom);  // what the map explains is no person
    person = person && may_step;
  }
  Obstacle obstacle{point.at, point.velocity, window_.real_margin, person, false};
  obstacle.may_step = may_step && point.away < point.steps_in;
  obstacle.is_low = point.known.low;
  return obstacle;
}

Steering CautiousWindow::steer(Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                               SpeedCap& cap) {
  Steering steering = straight_for(carrot);
  steering.bearing = bearing_.choose(carrot, odom_from_base, obstacles);
  cap_by_surroundings(obstacles, cap);
  return steering;
}

void CautiousWindow::cap_by_surroundings(std::span<const Obstacle> obstacles, SpeedCap& cap) const {
  for (const auto& obstacle : obstacles) {
    const double way = norm(obstacle.at);
    if (obstacle.is_unknown || way < 1e-6) continue;
    const double slack = slack_to(obstacle, limits_);
    const double ahead = obstacle.at.x / way;
    // The security distance grows with the speed [Buhmann1995]: read backwards, the speed with the distance. On the
    // border of its area, or beyond, the robot is slow whichever way it goes.
    if (ahead > params_.beside || (obstacle.is_border && slack < 0.0)) {
      cap.lower(window_.speed_with(slack), to_text(obstacle.is_border    ? ReasonWord::border_near
                                                   : obstacle.is_virtual ? ReasonWord::hazard_near
                                                                         : ReasonWord::obstacle_near));
    }
  }
}

std::optional<Velocity> CautiousWindow::slowed_for_people(const Velocity& command,
                                                          std::span<const Obstacle> obstacles) const {
  if (command.linear <= people_.harmless) return std::nullopt;
  const double curvature = std::clamp(command.angular / command.linear, -params_.sharpest, params_.sharpest);
  double speed = command.linear;
  BrakingWay braking{speed, curvature, limits_, people_};
  for (const auto& obstacle : obstacles) {
    if (!obstacle.may_step && !obstacle.person && obstacle.velocity == Point2{}) continue;
    const PersonPoint person{obstacle.at, obstacle.velocity, limits_.radius + obstacle.margin};
    while (speed > people_.harmless && !braking.is_forgivable(person)) {
      speed -= params_.slowing_step;
      braking = {speed, curvature, limits_, people_};
    }
  }
  // The choice may be so much too bold; not where anything faster than harmless is too fast.
  if (speed > people_.harmless && speed > command.linear - params_.too_bold * params_.slowing_step) return std::nullopt;
  speed = std::max(speed, people_.harmless);
  return Velocity{speed, command.angular * speed / command.linear};
}

}  // namespace docent::collision_avoidance
