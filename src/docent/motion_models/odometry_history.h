#pragma once

#include <deque>
#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::motion_models {

/// The odometry of the last moments, so that a scan can be asked where the robot was when it was taken.
class OdometryHistory {
 public:
  explicit OdometryHistory(Duration kept = std::chrono::seconds{3}) : kept_{kept} {}

  /// A reading older than the last one is left out, one of the same time takes its place; one that is older by two
  /// seconds begins anew: a stamp was wrong.
  void add(Time time, const Pose2& odom_from_robot);
  /// The clock was set: the times of what is kept are of another one.
  void forget() { readings_.clear(); }
  /// Interpolated; the newest when `time` is up to `ahead` later; nullopt when it is older than what is kept, or newer.
  [[nodiscard]] std::optional<Pose2> at(Time time, Duration ahead = std::chrono::milliseconds{200}) const;
  [[nodiscard]] bool empty() const { return readings_.empty(); }
  [[nodiscard]] const Pose2& latest() const { return readings_.back().odom_from_robot; }  ///< @pre not empty
  [[nodiscard]] Time latest_time() const { return readings_.back().time; }                ///< @pre not empty

 private:
  struct Reading {
    Time time;
    Pose2 odom_from_robot;
  };
  Duration kept_;
  std::deque<Reading> readings_;
};

}  // namespace docent::motion_models
