#include "docent/localization/pose_watch/odometry_trail.h"

namespace docent::localization {

void OdometryTrail::add(Time stamp, const Pose2& raw_from_base) {
  const auto reading = unbroken_.add(stamp, raw_from_base);
  if (reading.is_late) return;
  if (reading.is_set_back) history_.forget();
  history_.add(stamp, reading.odom_from_base);
  has_jumped_ = has_jumped_ || reading.jumped;
}

std::optional<Pose2> OdometryTrail::at(Time stamp) const {
  constexpr Duration kLately = std::chrono::milliseconds{100};  // longer than stamps jitter
  auto then = history_.at(stamp);
  if (!then || stamp <= history_.latest_time()) return then;
  const auto before = history_.at(history_.latest_time() - kLately);
  if (!before) return then;
  const Pose2 motion = inverse(*before) * *then;
  const double share = to_seconds(stamp - history_.latest_time()) / to_seconds(kLately);
  return *then * Pose2{share * motion.x, share * motion.y, Angle::radians(share * motion.theta.radians())};
}

bool OdometryTrail::take_jump(Time stamp) {
  const bool is_torn = has_jumped_ && !(stamp < unbroken_.jumped());
  if (is_torn) has_jumped_ = false;
  return is_torn;
}

}  // namespace docent::localization
