#include "docent/collision_avoidance/watches/contact_watch.h"

#include <cmath>

namespace docent::collision_avoidance {

void ContactWatch::feel(Time now, Angle from_in_odom) {
  const bool is_new = !last_ || now - *last_ > seconds(params_.stands_for) ||
                      std::abs((from_in_odom - from_).radians()) > params_.elsewhere;
  if (is_new) {
    since_ = now;
    from_ = from_in_odom;
  }
  last_ = now;
}

}  // namespace docent::collision_avoidance
