#include "docent/collision_avoidance/clocks/driver_stamps.h"

namespace docent::collision_avoidance {

Time OdometryStamps::mend(Time now, Time stamp, const Pose2& odom_from_base, bool stands) {
  if (stamp == Time{}) return now;
  const bool is_same = first_ && first_->stamp == stamp && first_->odom_from_base.x == odom_from_base.x &&
                       first_->odom_from_base.y == odom_from_base.y &&
                       first_->odom_from_base.theta.radians() == odom_from_base.theta.radians();
  if (!is_same) {
    first_ = {now, stamp, odom_from_base};
    repeated_ = 0;
    return stamp;
  }
  ++repeated_;
  return stands && repeated_ >= params_.enough ? stamp + (now - first_->came) : stamp;
}

}  // namespace docent::collision_avoidance
