#pragma once

#include <numbers>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/localization/localizer/localizer_params.h"

namespace docent::localization {

/// What odometry tells of the way since the last update.
struct Motion {
  Pose2 before_from_after;
  double way = 0.0;   ///< [m]
  double turn = 0.0;  ///< [rad], >= 0

  Motion() = default;
  explicit Motion(const Pose2& step);
};

/// Which sweeps are worth an update, and how much: after some way or turn a whole one, after some time without motion a
/// small one; never before the work of the last update is paid off ([Rhino1999] 3.1.5, any-time).
class UpdateCadence {
 public:
  /// `rounds_repeat`: a robot that has turned all round on the spot has seen what there is to see from there, until
  /// people have moved: further turns are news only once in a while.
  UpdateCadence(const LocalizerParams& params, bool rounds_repeat) : params_{params}, rounds_repeat_{rounds_repeat} {}

  void restart() { last_work_ = turned_here_ = 0.0; }
  /// The time that counts as that of the last update.
  void restart_at(Time time) {
    restart();
    last_update_ = time;
  }

  /// 0..1 of a full update now; 0: none is due. O(1).
  [[nodiscard]] double weight(const Motion& motion, Time now) const;
  /// LocalizerParams::views of a sweep after that motion.
  [[nodiscard]] double views(const Motion& motion) const {
    return params_.views(motion.way, goes_round() ? 0.0 : motion.turn);
  }
  [[nodiscard]] double waited(Time now) const { return to_seconds(now - last_update_); }  ///< [s]
  [[nodiscard]] Time last_update() const { return last_update_; }

  /// An update is made. `position`: of the robot [m], odom.
  void begin(const Motion& motion, Point2 position, Time now);
  /// Somebody has carried the robot: what it sees now it has not seen before.
  void come_elsewhere() { turned_here_ = 0.0; }
  /// What it cost, in states * beams.
  void pay(double work) { last_work_ = work; }

 private:
  [[nodiscard]] bool goes_round() const { return rounds_repeat_ && turned_here_ > 2.0 * std::numbers::pi; }

  LocalizerParams params_;
  bool rounds_repeat_;
  Time last_update_{};
  double last_work_ = 0.0;    ///< states * beams
  Point2 turns_at_{};         ///< [m], odom
  double turned_here_ = 0.0;  ///< [rad] since it came there
};

}  // namespace docent::localization
