#pragma once

#include <optional>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/watches/complaint.h"

namespace docent {

/// Watches the odometry. Frozen: it says the very same although the commands must have moved the base by kExpected;
/// the robot then stands, and tries again slowly after a while, for wheels that were held say the same. Missing
/// messages: more than a fifth of those that its own rhythm foretells. Jumps are found by UnbrokenOdometry and slow
/// the robot down until the localizer has had time to look.
class OdometryWatch {
 public:
  explicit OdometryWatch(const BaseLimits& limits) : limits_{limits} {}

  /// @param state  as the base says it @param commands  given so far
  void receive(Time now, Time stamp, const BaseState& state, bool jumped, const CommandHistory& commands);

  [[nodiscard]] std::optional<Complaint> complaint(Time now) const;
  [[nodiscard]] const Freshness& freshness() const { return freshness_; }

 private:
  void watch_for_freeze(Time now, Time stamp, const BaseState& state, const CommandHistory& commands);
  void watch_for_gaps(double gap);

  BaseLimits limits_;
  Freshness freshness_;
  std::optional<Time> stamp_;
  BaseState state_;            ///< newest
  Velocity expected_;          ///< that the commands must have given the base
  double expected_way_ = 0.0;  ///< [m] of the rim, since the odometry last changed
  std::optional<Time> frozen_;
  std::optional<Time> jumped_;
  double usual_gap_ = 0.0;  ///< [s] between stamps
  double missing_ = 0.0;    ///< share of the messages, lately
};

}  // namespace docent
