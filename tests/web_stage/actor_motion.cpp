#include <algorithm>
#include <cmath>

#include "actor.h"

namespace docent::stage {

void Actor::move(double dt) {
  double wanted_speed = 0.0;
  double wanted_turn = 0.0;
  if (phase_ == Phase::lost) wanted_turn = 0.4;
  const auto face = [&](Angle heading) {
    wanted_turn = std::clamp(3.0 * (heading - map_from_base_.theta).radians(), -2.0, 2.0);
  };
  if (!way_.empty()) {
    while (way_.size() > 1 && distance(way_.front(), map_from_base_.position()) < 0.35) way_.erase(way_.begin());
    if (distance(way_.front(), map_from_base_.position()) < 0.12) {
      way_.clear();
    } else {
      const Angle heading = direction(map_from_base_.position(), way_.front());
      face(heading);
      const double off = std::abs((heading - map_from_base_.theta).radians());
      wanted_speed = options_.speed * std::max(0.0, 1.0 - 2.0 * off);
      for (const auto& walker : scenery_.walkers()) {
        const Point2 ahead = inverse(map_from_base_) * walker.at;
        if (ahead.x > 0 && ahead.x < 0.7 && std::abs(ahead.y) < 0.35) wanted_speed = 0.0;
      }
      if (way_.size() < 3)
        wanted_speed = std::min(wanted_speed, 0.8 * distance(way_.back(), map_from_base_.position()) + 0.1);
    }
  } else if (const auto* exhibit = museum_.find_exhibit(exhibit_)) {
    face(direction(map_from_base_.position(), exhibit->look_at));
  }
  speed_ += std::clamp(wanted_speed - speed_, -3.0 * dt, 0.8 * dt);
  turn_ += std::clamp(wanted_turn - turn_, -3.0 * dt, 3.0 * dt);
  map_from_base_ = map_from_base_ * Pose2{speed_ * dt, 0.0, Angle::radians(turn_ * dt)};
}

}  // namespace docent::stage
