#include "docent/collision_avoidance/avoider/people_caution.h"

#include <algorithm>

namespace docent::collision_avoidance {

Obstacle PeopleCaution::obstacle_of(const SensedPoint& point) const {
  if (!foresees_people_) return {point.at, {}, margin_, point.known.person, false};
  const bool moves = point.known.velocity != Point2{};
  bool person = point.known.person;
  bool may_step = moves || !point.known.straight;
  bool is_somebody = moves;
  if (point.unmapped != nullptr && !moves && (person || point.away < point.steps_in)) {
    may_step = point.unmapped->is_near(point.known.in_odom);  // what the map explains is no person
    person = person && may_step;
    is_somebody = may_step && !point.known.straight && !point.known.low;
  }
  Obstacle obstacle{point.at, point.velocity, margin_, person, false};
  obstacle.may_step = may_step && point.away < point.steps_in;
  obstacle.is_low = point.known.low;
  if (is_somebody) {
    const UnseenBodies::Reach unseen = bodies_.reach(point.at, point.velocity);
    obstacle.margin += unseen.likely;
    obstacle.perhaps = unseen.most - unseen.likely;
  }
  return obstacle;
}

std::optional<Velocity> PeopleCaution::slowed_for_people(const Velocity& command,
                                                         std::span<const Obstacle> obstacles) const {
  if (!foresees_people_ || command.linear <= people_.harmless) return std::nullopt;
  const double curvature = std::clamp(command.angular / command.linear, -params_.sharpest, params_.sharpest);
  double speed = command.linear;
  BrakingWay braking{speed, curvature, limits_, people_};
  for (const auto& obstacle : obstacles) {
    if (!obstacle.may_step && !obstacle.person && obstacle.velocity == Point2{}) continue;
    const PersonPoint person{obstacle.at, obstacle.velocity, limits_.radius + obstacle.margin + obstacle.perhaps};
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
