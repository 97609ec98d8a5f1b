#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "docent/localization/localizer/localizer.h"
#include "docent/localization/pose_watch/checkpoint_keeper.h"
#include "docent/localization/pose_watch/odometry_trail.h"
#include "docent/localization/pose_watch/scan_rounds.h"
#include "docent/localization/pose_watch/sweep_joiner.h"

namespace docent::localization {

struct PoseWatchParams {
  PersonFilterParams people;      ///< the inverse filter
  double max_range = 10.0;        ///< [m] of the lasers
  double person_range = 6.0;      ///< [m], > 0: how far away people are looked for
  motion_models::BaseReach base;  ///< what no base can do is a jump of its odometry
};

/// Watches where the robot is: gives its localizer the sweeps of all lasers and odometry as they come, and says when
/// the belief, the pose and the beams on people are worth telling. Deterministic; knows no wall clock.
class PoseWatch {
 public:
  static constexpr Duration kBeliefEvery = std::chrono::milliseconds{500};  ///< also of a robot that stands
  /// A look waits so long for odometry that is as young as the scans, then it makes do with what there is.
  static constexpr Duration kOdometryPatience = std::chrono::milliseconds{40};

  /// Goes on from the checkpoint of a moment ago, if there is one.
  PoseWatch(std::unique_ptr<Localizer> localizer, const std::vector<Pose2>& base_from_laser,
            CheckpointKeeper checkpoints, const PoseWatchParams& params, Time now);

  /// Odometry, in its own frame.
  void move(Time stamp, const Pose2& raw_from_base);
  /// A laser is found to be mounted elsewhere: where the robot thought to be follows.
  void mount(std::size_t laser, const Pose2& base_from_laser);
  void see(std::size_t laser, Time stamp, const sensor_models::LaserReading& reading, Time now) {
    sweeps_.keep(laser, stamp, reading);
    rounds_.hear(laser, now);
  }
  /// Whether to look now: a round of scans is whole, and odometry tells where the robot was then. To be asked when a
  /// scan or odometry has come, and kOdometryPatience after a scan.
  [[nodiscard]] bool is_look_due(Time now) const;
  /// A round of scans is whole, but odometry is older than its newest one.
  [[nodiscard]] bool awaits_odometry() const;

  /// A moment at which something may be told.
  struct Moment {
    Time stamp{};
    Pose2 odom_from_base;
  };
  struct Look {
    Moment moment;
    sensor_models::RangeSweep sweep;  ///< of all lasers, about the robot's centre
    bool is_belief_due = false;       ///< it has changed, or odometry has jumped, or it is time: see `tell_belief`
    bool is_pose_due = false;         ///< the robot knows its place, and looked anew
  };
  /// What came since the last look, or nothing. O(an update of the belief)
  [[nodiscard]] std::optional<Look> look(Time now);
  /// Somebody says where the robot stood at `stamp`; where nobody knows odometry of then, it stands there now. The
  /// belief is due. None: nothing was heard of odometry, so the robot cannot take it.
  [[nodiscard]] std::optional<Moment> start_where_told(const BeliefMode& mode, Time stamp);
  /// Another sensor has found the robot at `fix.time`; its odometry is filled in. Unheard where nobody knows odometry
  /// of then.
  void take_fix(PoseFix fix);
  /// Somebody has carried the robot, as its scans say.
  void uproot() { localizer_->uproot(); }
  /// The moment at which the belief is told before anything was seen.
  [[nodiscard]] Moment start(Time now) const { return {now, localizer_->odom_from_robot()}; }

  [[nodiscard]] bool is_localized() const { return localizer_->verdict().localized(); }
  /// The belief of the last update, carried on by odometry to the moment. It counts as told.
  [[nodiscard]] BeliefSummary tell_belief(const Moment& moment, Time now);
  /// Of the last update.
  [[nodiscard]] const Verdict& verdict() const { return localizer_->verdict(); }
  [[nodiscard]] const Localizer::Step& last_update() const { return last_update_; }
  [[nodiscard]] const BeliefMode& best_mode() const { return localizer_->summary().modes.front(); }  ///< @pre localized
  /// None: there is no place that is likelier than others.
  [[nodiscard]] std::optional<Pose2> map_from_base(const Moment& moment) const {
    return localizer_->map_from_robot(moment.odom_from_base);
  }
  /// In the odometry's own frame.
  [[nodiscard]] Pose2 raw_from_base(const Moment& moment) const {
    return odometry_.in_raw(moment.odom_from_base, moment.stamp);
  }
  [[nodiscard]] Pose2 map_from_raw(const Moment& moment) const;  ///< @pre localized
  [[nodiscard]] std::optional<Pose2> odom_from_base_at(Time stamp) const { return odometry_.at(stamp); }
  /// What the beams of a sweep ended on.
  struct Beams {
    std::vector<sensor_models::BeamOrigin> origins;  ///< [beams]
    std::vector<Point2> ends;                        ///< [m], base: of those near enough that the map does not hold
  };
  [[nodiscard]] Beams beams(const Look& look) const;

 private:
  std::unique_ptr<Localizer> localizer_;
  PoseWatchParams params_;
  SweepJoiner sweeps_;
  ScanRounds rounds_;
  OdometryTrail odometry_;
  CheckpointKeeper checkpoints_;
  Localizer::Step last_update_;
  Time belief_told_{};
};

}  // namespace docent::localization
