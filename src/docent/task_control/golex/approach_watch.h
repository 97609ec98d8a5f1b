#pragma once

#include <limits>
#include <optional>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/task_control/tour_scheduler/programme.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// When a drive is in vain though it moves. Section `executive.approach` of robot.yaml.
struct ApproachParams {
  /// [s] > 0 to come nearer to the goal than ever before on this drive. More than the ladder's patience, which ends a
  /// drive that stands: a way round may lead away from the goal at first.
  double patience_s = 120.0;
  double nearer_m = 0.3;      ///< [m] >= 0 that count as nearer: the way is measured anew all the time
  double slowest_mps = 0.25;  ///< [m/s] > 0 the patience is longer by what the rest of the way takes so slowly
  /// [s] >= 0: a drive that was interrupted goes on when one to the same place begins so soon. A robot that drives to
  /// and fro between closed ways may lose its place there again and again, and would never give up.
  double resumed_s = 60.0;
  template <class V>
  void visit(V& v) {
    v("patience_s", patience_s);
    v("nearer_m", nearer_m);
    v("slowest_mps", slowest_mps);
    v("resumed_s", resumed_s);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(patience_s > 0.0)) return fail("approach.patience_s must be > 0");
    if (!(nearer_m >= 0.0)) return fail("approach.nearer_m must be >= 0");
    if (!(slowest_mps > 0.0)) return fail("approach.slowest_mps must be > 0");
    if (!(resumed_s >= 0.0)) return fail("approach.resumed_s must be >= 0");
    return {};
  }
};

/// Whether a drive comes nearer to its goal. Where every way is closed, the planner forgets the one that the robot has
/// left, so that it drives to and fro between them and each detour looks like progress. Deterministic, O(1).
class ApproachWatch {
 public:
  ApproachWatch(const ApproachParams& params, Time began) : params_{params}, nearer_at_{began} {}

  /// A drive begins, or goes on.
  void set_out(const Pose2& goal, Time now) {
    const bool goes_on =
        interrupted_at_ && is_same(goal, goal_) && now - *interrupted_at_ <= seconds(params_.resumed_s);
    if (goes_on) {
      nearer_at_ = nearer_at_ + (now - *interrupted_at_);
    } else {
      *this = ApproachWatch{params_, now};
    }
    goal_ = goal;
    interrupted_at_.reset();
  }
  /// Something else comes before the end of the drive.
  void interrupt(Time now) { interrupted_at_ = now; }
  /// @param remaining_m  [m] of way to the goal, as the planner sees it now; counts while it sees one
  void see(std::optional<GoalStatus> state, double remaining_m, Time now) {
    const bool sees_way = state == GoalStatus::driving || state == GoalStatus::turning || state == GoalStatus::blocked;
    if (!sees_way) return;
    remaining_m_ = remaining_m;
    if (remaining_m >= nearest_m_ - params_.nearer_m) return;
    nearest_m_ = remaining_m;
    nearer_at_ = now;
  }
  [[nodiscard]] bool is_in_vain(Time now) const {
    return now - nearer_at_ > seconds(params_.patience_s + remaining_m_ / params_.slowest_mps);
  }

 private:
  ApproachParams params_;
  double nearest_m_ = std::numeric_limits<double>::infinity();
  double remaining_m_ = 0.0;
  Time nearer_at_;
  Pose2 goal_;
  std::optional<Time> interrupted_at_;
};

}  // namespace docent::task_control
