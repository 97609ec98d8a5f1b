#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/expected_sweeps/range_law.h"
#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct SuccessionParams {
  RangeLawParams law{};
  double follows = 0.4;        ///< of the samples as an earlier sweep has them: people and edges are the rest
  int least = 30;              ///< samples compared, both ways; fewer tell nothing
  double longest = 0.45;       ///< [s] since the sweep before: then people have changed places, and nothing is told
  std::size_t remembered = 6;  ///< sweeps: late, doubled and swapped ones are like one of these
  double beyond = 0.3;         ///< [s] for which the base may have moved otherwise than odometry says, at most
  double slack_turn = 0.12;    ///< [rad] besides: a late stamp while it turns
  double slack_way = 0.1;      ///< [m] likewise
  double step_turn = 0.05;     ///< [rad] between the turns that are tried: two samples
  double step_way = 0.12;      ///< [m] between the ways that are tried
  int garbage = 5;             ///< sweeps in a row of which none follows any: then the newest is what others follow
};

/// Can a sweep follow those before it? First by the motion that odometry tells, which nearly always does; where it does
/// not, by every motion that the base could have made meanwhile, and from each sweep of the last second, for sweeps
/// come late, twice and out of order. What none of them explains was seen from another place: somebody has carried the
/// robot there, and its wheels did not turn. The sweep after it must bear that out, for a single one may be garbage.
class Succession {
 public:
  /// `untold`: too little to compare, or too long ago; `suspect`: this sweep cannot follow, wait for the next one;
  /// `broken`: the next one follows it, and not those before
  enum class Finding { untold, follows, suspect, broken };

  explicit Succession(const BaseLimits& limits, const SuccessionParams& params = {})
      : max_speed_{limits.max_speed}, max_turn_{limits.max_turn_rate}, params_{params} {}

  /// One sweep of a scanner, in order of receipt. O(samples) mostly; O(samples * motions * sweeps) where it breaks.
  /// @param as_before  share of the samples that the sweep before lets expect by odometry, where somebody knows already
  Finding add(const SweepView& view, std::optional<double> as_before = std::nullopt);
  void forget();
  /// The greatest share of the newest sweep that any motion explains; 1 where odometry did at once.
  [[nodiscard]] double explained() const { return explained_; }

 private:
  /// Share of the samples that agree, seen both ways, were the newest taken at `odom_from_sensor`; nullopt: too few.
  [[nodiscard]] std::optional<double> share(const SweepView& before, const SweepView& now,
                                            const Pose2& odom_from_sensor);
  /// Whether any motion of the base leads from one of the sweeps to this one; nullopt: too little to compare.
  [[nodiscard]] std::optional<bool> is_explained(std::span<const SweepView> earlier, const SweepView& now);
  void keep(const SweepView& view);

  double max_speed_;  ///< [m/s] of the base
  double max_turn_;   ///< [rad/s] likewise
  SuccessionParams params_;
  std::vector<SweepView> earlier_;    ///< of the last moments, the newest last
  std::optional<SweepView> suspect_;  ///< did not follow them
  int strange_ = 0;                   ///< sweeps in a row that did not
  double explained_ = 1.0;
  std::vector<float> expected_;
};

}  // namespace docent::collision_avoidance
