#include "docent/vision/ceiling/ceiling_tracker.h"

#include <algorithm>

#include "docent/base/check.h"

namespace docent::vision {

CeilingTracker::CeilingTracker(MosaicPyramid levels, const CameraMount& mount, const Pose2& start,
                               const CeilingTrackerParams& params)
    : levels_{std::move(levels)}, mount_{mount}, params_{params}, map_from_robot_{start} {
  DOCENT_CHECK(!levels_.empty() && params.window_samples > 0);
}

double CeilingTracker::coarse_correlation(const Pose2& map_from_robot) const {
  return agreement_at(map_from_robot, levels_.front(), mount_, few_, params_.fit.far_weight).correlation;
}

Pose2 CeilingTracker::best_start(const Pose2& predicted, std::span<const CeilingSample> samples) {
  few_.clear();
  const auto most = static_cast<std::size_t>(params_.window_samples);
  const std::size_t count = std::min(most, samples.size());
  for (std::size_t i = 0; i < count; ++i) few_.push_back(samples[i * samples.size() / count]);
  Pose2 best = predicted;
  double highest = coarse_correlation(predicted);
  if (params_.window_steps == 0 || highest >= params_.good_start * last_correlation_) return predicted;
  const int steps = params_.window_steps;
  for (int turn = -steps; turn <= steps; ++turn) {
    for (int right = -steps; right <= steps; ++right) {
      for (int up = -steps; up <= steps; ++up) {
        const Pose2 tried{predicted.x + params_.window * right / steps, predicted.y + params_.window * up / steps,
                          predicted.theta + Angle::radians(params_.window_turn * turn / steps)};
        const double correlation =
            agreement_at(tried, levels_.front(), mount_, few_, params_.fit.far_weight).correlation;
        if (correlation > highest) highest = correlation, best = tried;
      }
    }
  }
  return best;
}

std::optional<PoseFit> CeilingTracker::track(std::span<const CeilingSample> samples,
                                             const std::optional<Pose2>& motion) {
  const Pose2 last = map_from_robot_;
  map_from_robot_ = last * motion.value_or(motion_);
  auto fit = fit_pose(best_start(map_from_robot_, samples), levels_, mount_, samples, params_.fit);
  if (!fit || fit->correlation < params_.least_correlation) return std::nullopt;
  map_from_robot_ = fit->map_from_robot;
  motion_ = inverse(last) * map_from_robot_;
  last_correlation_ = coarse_correlation(map_from_robot_);
  return fit;
}

}  // namespace docent::vision
