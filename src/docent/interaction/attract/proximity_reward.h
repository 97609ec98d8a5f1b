#pragma once

#include <optional>
#include <span>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::interaction {

/// What an attraction phase is worth ([Minerva2000] 6.3): reward in proportion to the proximity of people, and a
/// distinct penalty where somebody comes too close.
struct ProximityRewardParams {
  double near = 1.0;        ///< [m] from the robot's centre; nearer people are worth 1
  double far = 2.5;         ///< [m] > near; farther people are worth 0: they rather pass by than listen
  double too_close = 0.55;  ///< [m] 0..near: there the body (0.27 m) and an arm's length end
  double penalty = 2.0;     ///< >= 0, for each moment with somebody too close; more than what this person was worth
  /// 0..1, share of the phase in which people must have been looked for; else it taught nothing
  double least_seen = 0.5;
  double gap_s = 1.0;  ///< [s] > 0: people seen longer ago than this are not known any more
  template <class V>
  void visit(V& v) {
    v("near", near);
    v("far", far);
    v("too_close", too_close);
    v("penalty", penalty);
    v("least_seen", least_seen);
    v("gap_s", gap_s);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The reward of one moment. @param people [m], robot frame
[[nodiscard]] double proximity_reward(std::span<const Point2> people, const ProximityRewardParams& params);

/// The mean of the moments over a phase.
class PhaseReward {
 public:
  PhaseReward(const ProximityRewardParams& params, Time begin) : params_{params}, begin_{begin}, last_{begin} {}

  /// People who are there now [m], robot frame; they count from the observation before, or from `gap_s` ago when that
  /// is later. Times must not fall; an older one is ignored.
  void observe(std::span<const Point2> people, Time now);
  /// Mean reward over the seconds in which people were looked for; nullopt: they were too few to tell.
  [[nodiscard]] std::optional<double> finish(Time now) const;

 private:
  ProximityRewardParams params_;
  Time begin_;
  Time last_;
  double sum_ = 0.0;   ///< [s]
  double seen_ = 0.0;  ///< [s]
};

}  // namespace docent::interaction
