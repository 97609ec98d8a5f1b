#include "docent/localization/pose_watch/odometry_trail.h"

namespace docent::localization {

void OdometryTrail::add(Time stamp, const Pose2& raw_from_base) {
  const auto reading = unbroken_.add(stamp, raw_from_base);
  if (reading.is_late) return;
  if (reading.is_set_back) history_.forget();
  history_.add(stamp, reading.odom_from_base);
  has_jumped_ = has_jumped_ || reading.jumped;
}

bool OdometryTrail::take_jump(Time stamp) {
  const bool is_torn = has_jumped_ && !(stamp < unbroken_.jumped());
  if (is_torn) has_jumped_ = false;
  return is_torn;
}

}  // namespace docent::localization
