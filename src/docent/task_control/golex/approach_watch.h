#pragma once

#include <limits>
#include <optional>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// When a drive is in vain though it moves. Section `executive.approach` of robot.yaml.
struct ApproachParams {
  /// [s] > 0 to come nearer to the goal than ever before on this drive. More than the ladder's patience, which ends a
  /// drive that stands: a way round may lead away from the goal at first.
  double patience_s = 120.0;
  double nearer_m = 0.3;      ///< [m] >= 0 that count as nearer: the way is measured anew all the time
  double slowest_mps = 0.25;  ///< [m/s] > 0 the patience is longer by what the rest of the way takes so slowly
  template <class V>
  void visit(V& v) {
    v("patience_s", patience_s);
    v("nearer_m", nearer_m);
    v("slowest_mps", slowest_mps);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(patience_s > 0.0)) return fail("approach.patience_s must be > 0");
    if (!(nearer_m >= 0.0)) return fail("approach.nearer_m must be >= 0");
    if (!(slowest_mps > 0.0)) return fail("approach.slowest_mps must be > 0");
    return {};
  }
};

/// Whether a drive comes nearer to its goal. Where every way is closed, the planner forgets the one that the robot has
/// left, so that it drives to and fro between them and each detour looks like progress. Deterministic, O(1).
class ApproachWatch {
 public:
  ApproachWatch(const ApproachParams& params, Time began) : params_{params}, nearer_at_{began} {}

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
};

}  // namespace docent::task_control
