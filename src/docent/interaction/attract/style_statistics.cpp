#include "docent/interaction/attract/style_statistics.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace docent::interaction {

StyleStatistics style_statistics(std::span<const AttractionTrial> trials, std::optional<CrowdClass> crowd,
                                 const CrowdClassParams& crowds) {
  constexpr double kUpperTail = 0.975;
  std::array<RunningMoments, kStyles> rewards;
  for (const AttractionTrial& trial : trials)
    if (!crowd || crowd_class(trial.density, crowds) == *crowd)
      rewards.at(static_cast<std::size_t>(style_of(trial.action))).add(trial.reward);
  StyleStatistics result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const int count = rewards.at(i).count();
    result.at(i) = {count, rewards.at(i).mean(), std::nullopt};
    if (count < 2) continue;
    const double quantile = boost::math::quantile(boost::math::students_t{count - 1.0}, kUpperTail);
    result.at(i).half_width = quantile * rewards.at(i).deviation() / std::sqrt(count);
  }
  return result;
}

}  // namespace docent::interaction
