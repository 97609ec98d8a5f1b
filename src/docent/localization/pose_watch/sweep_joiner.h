#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/localization/pose_watch/odometry_trail.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// One sweep of what all lasers have seen since the last one. Of each laser it keeps the newest scan only: who is late
/// drops scans.
class SweepJoiner {
 public:
  static constexpr Duration kTogether = std::chrono::milliseconds{250};  ///< scans that make one sweep
  /// Likewise of what is new: one laser may be later than the other by as much as can be found out.
  static constexpr Duration kNewTogether = std::chrono::milliseconds{450};

  /// @param base_from_laser  [lasers] where they are mounted
  explicit SweepJoiner(const std::vector<Pose2>& base_from_laser);

  void keep(std::size_t laser, Time stamp, const sensor_models::LaserReading& reading);
  [[nodiscard]] bool has_new() const;  ///< since the last sweep
  [[nodiscard]] Time newest() const;   ///< stamp of the newest of what is new; of the beginning of time without any
  /// It is found to be mounted elsewhere. @returns where it was thought to be
  Pose2 mount(std::size_t laser, const Pose2& base_from_laser) {
    return std::exchange(lasers_[laser].base_from_laser, base_from_laser);
  }
  [[nodiscard]] std::size_t lasers() const { return lasers_.size(); }
  /// All scans about the robot's centre at the stamp of the newest.
  struct Joined {
    sensor_models::RangeSweep sweep;
    Pose2 odom_from_base;
    Time stamp{};
  };
  /// None: nothing is new, or it waits for odometry, or nothing came back. O(beams)
  [[nodiscard]] std::optional<Joined> join(const OdometryTrail& odometry);

 private:
  struct Laser {
    Pose2 base_from_laser;
    Time stamp{};
    sensor_models::LaserReading reading;  ///< without its ranges
    std::vector<float> ranges;            ///< [m]
    bool is_new = false;
  };
  std::vector<Laser> lasers_;
};

}  // namespace docent::localization
