#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// A stamp of zero is none, as of drivers that leave it out: then the message is of the moment at which it came.
[[nodiscard]] inline Time stamp_or(Time stamp, Time now) { return stamp == Time{} ? now : stamp; }

struct OdometryStampsParams {
  int enough = 2;  ///< repetitions in succession; one may be a message that was sent twice
};

/// Stamps of odometry as drivers mean them. Some leave them out. Others repeat their last message, stamp and all, as
/// long as the base stands: that it stands is news all the same, as of when it is said. One that repeats a message in
/// which the base moves says nothing new, it hangs.
class OdometryStamps {
 public:
  explicit OdometryStamps(const OdometryStampsParams& params = {}) : params_{params} {}

  /// Of the message that came just now. @param stands  no velocity is in it
  /// @returns the stamp that it should have, by the driver's clock
  [[nodiscard]] Time mend(Time now, Time stamp, const Pose2& odom_from_base, bool stands);

 private:
  struct Message {
    Time came, stamp;
    Pose2 odom_from_base;
  };
  OdometryStampsParams params_;
  std::optional<Message> first_;  ///< of those that are the same
  int repeated_ = 0;
};

}  // namespace docent::collision_avoidance
