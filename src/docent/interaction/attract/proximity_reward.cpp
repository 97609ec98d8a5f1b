#include "docent/interaction/attract/proximity_reward.h"

#include <algorithm>

namespace docent::interaction {

Result<void> ProximityRewardParams::validate() const {
  if (!(near > 0.0 && near < far)) return fail("reward.near must be > 0 and < far");
  if (!(too_close >= 0.0 && too_close <= near)) return fail("reward.too_close must be >= 0 and <= near");
  if (!(penalty >= 0.0)) return fail("reward.penalty must be >= 0");
  if (!(least_seen >= 0.0 && least_seen <= 1.0)) return fail("reward.least_seen must be 0..1");
  if (!(gap_s > 0.0)) return fail("reward.gap_s must be > 0");
  return {};
}

double proximity_reward(std::span<const Point2> people, const ProximityRewardParams& params) {
  double reward = 0.0;
  bool is_harassed = false;
  for (const Point2 person : people) {
    const double away = norm(person);
    reward += std::clamp((params.far - away) / (params.far - params.near), 0.0, 1.0);
    is_harassed = is_harassed || away < params.too_close;
  }
  return is_harassed ? reward - params.penalty : reward;
}

void PhaseReward::observe(std::span<const Point2> people, Time now) {
  if (now <= last_) return;
  const double span = std::min(to_seconds(now - last_), params_.gap_s);
  sum_ += span * proximity_reward(people, params_);
  seen_ += span;
  last_ = now;
}

std::optional<double> PhaseReward::finish(Time now) const {
  const double length = to_seconds(now - begin_);
  if (!(length > 0.0) || !(seen_ > 0.0) || seen_ < params_.least_seen * length) return std::nullopt;
  return sum_ / seen_;
}

}  // namespace docent::interaction
