#pragma once

#include <optional>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/watches/complaint.h"
#include "docent/collision_avoidance/watches/message_rhythm.h"

namespace docent::collision_avoidance {

struct OdometryWatchParams {
  ComplaintParams complaints{};
  double expected = 0.1;    ///< [m] of driving, or of the rim in turning, by commands, that no odometry can miss
  double rest = 8.0;        ///< [s] that a robot with a frozen odometry stands before it tries again
  double try_speed = 0.06;  ///< [m/s] with which it tries
  MessageRhythmParams rhythm{};
  double after_jump = 3.0;    ///< [s] in which the localizer looks several times
  double longest_step = 0.5;  ///< [s] between messages, for which the commands are still followed
  double begins_anew = 1.0;   ///< [s] a stamp so much older than the newest: the clock or the base began anew
};

/// Watches the odometry. Frozen: it says the very same although the commands must have moved the base;
/// the robot then stands, and tries again slowly after a while, for wheels that were held say the same. Missing
/// messages: too many of those that its own rhythm foretells. Jumps are found by UnbrokenOdometry and slow
/// the robot down until the localizer has had time to look.
class OdometryWatch {
 public:
  explicit OdometryWatch(const BaseLimits& limits, const OdometryWatchParams& params = {})
      : limits_{limits}, params_{params}, rhythm_{params.rhythm} {}

  /// @param state  as the base says it @param commands  given so far
  void receive(Time now, Time stamp, const BaseState& state, bool jumped, const CommandHistory& commands);

  [[nodiscard]] std::optional<Complaint> complaint(Time now) const;
  [[nodiscard]] const Freshness& freshness() const { return freshness_; }

 private:
  void watch_for_freeze(Time now, Time stamp, const BaseState& state, const CommandHistory& commands);

  BaseLimits limits_;
  OdometryWatchParams params_;
  Freshness freshness_;
  std::optional<Time> stamp_;
  BaseState state_;            ///< newest
  Velocity expected_;          ///< that the commands must have given the base
  double expected_way_ = 0.0;  ///< [m] of the rim, since the odometry last changed
  std::optional<Time> frozen_;
  std::optional<Time> jumped_;
  MessageRhythm rhythm_;
};

}  // namespace docent::collision_avoidance
