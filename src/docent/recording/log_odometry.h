#pragma once

#include <optional>
#include <vector>

#include "docent/base/time.h"
#include "docent/motion_models/unbroken_odometry.h"
#include "docent/recording/laser_log.h"

namespace docent::recording {

/// The stamps of one topic of a recording, whose clock may have been set back on the way: from the third message in
/// succession on whose stamps rise but are older than those before, all are moved by as much as the clock was set. Lone
/// ones that were overtaken keep theirs.
class RisingStamps {
 public:
  /// Of the next message in the order of the file.
  Time follow(Time stamp);
  [[nodiscard]] int set_back() const { return set_back_; }  ///< how often

 private:
  static constexpr int kEnough = 3;  ///< messages that bear each other out
  bool is_first_ = true;
  Time newest_{};  ///< as it was given out
  Duration shift_{};
  Time late_{};     ///< stamp of the last one that was older
  int rising_ = 0;  ///< so many in succession
  int set_back_ = 0;
};

/// The odometry of a recording without its jumps, as the robot's modules take them out (`UnbrokenOdometry`), in the
/// order of the file. Nobody knows what that base can do, so it is taken for a quick one.
class LogOdometry {
 public:
  /// @param times_are_true  false: they tell nothing of speeds, and only a pose of zero far from the last is a jump
  explicit LogOdometry(bool times_are_true = true);

  /// Of the next reading; none: it is older than the one before, or a double.
  [[nodiscard]] std::optional<Pose2> follow(Time time, const Pose2& raw_from_base);
  /// Of what stands between readings, as a scan does that carries the pose of its own moment: that is never left out.
  [[nodiscard]] Pose2 follow_scan(Time time, const Pose2& raw_from_base);
  /// What to say of it; empty: nothing.
  [[nodiscard]] std::string note() const;

 private:
  motion_models::UnbrokenOdometry unbroken_;
  std::optional<Time> begins_;
  int jumps_ = 0;
  Time first_jump_{};
};

/// The log's odometry at that time, between its readings. Before the first and after the last it goes on as between the
/// two that are next, for as long as these are apart, 0.2 s at most, and stands then. Without readings: zero.
[[nodiscard]] Pose2 odometry_at(const LaserLog& log, Time time);

}  // namespace docent::recording
