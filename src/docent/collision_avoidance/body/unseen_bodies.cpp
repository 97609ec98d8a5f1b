#include "docent/collision_avoidance/body/unseen_bodies.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

Result<void> UnseenBodyParams::validate() const {
  if (!(ahead >= 0.0 && ahead <= 0.5)) return fail("avoid.body.ahead must lie between 0 and 0.5 m");
  if (!(aside >= 0.0 && aside <= 0.5)) return fail("avoid.body.aside must lie between 0 and 0.5 m");
  if (!(waist >= 0.0 && waist <= 2.0)) return fail("avoid.body.waist must lie between 0 and 2 m");
  return {};
}

UnseenBodies::UnseenBodies(const UnseenBodyParams& params, double laser_height)
    : ahead_{laser_height < params.waist ? params.ahead : 0.0},
      aside_{laser_height < params.waist ? params.aside : 0.0} {}

UnseenBodies::Reach UnseenBodies::reach(Point2 at, Point2 velocity) const {
  const double most = std::max(ahead_, aside_);
  const double away = norm(at);
  const double speed = norm(velocity);
  if (speed == 0.0 || away == 0.0) return {ahead_, most};
  const double along = dot(at, velocity) / (away * speed);
  const double across = cross(at, velocity) / (away * speed);
  return {std::hypot(ahead_ * along, aside_ * across), most};
}

}  // namespace docent::collision_avoidance
