#include "docent/planning/survey/normal_pose.h"

#include <cmath>

namespace docent::planning {

localization::BeliefMode mode_of(const NormalPose& pose) {
  localization::BeliefMode mode;
  mode.map_from_robot = pose.map_from_base;
  const double variance = pose.sigma * pose.sigma;
  mode.covariance = {variance, 0, 0, 0, variance, 0, 0, 0, pose.sigma_heading * pose.sigma_heading};
  mode.mass = 1.0;
  return mode;
}

localization::BeliefSummary belief_of(const NormalPose& pose) {
  constexpr int kSide = 2;  // cells, of one deviation each, to both sides
  localization::BeliefSummary belief;
  const Pose2& here = pose.map_from_base;
  double sum = 0.0;
  for (int i = -kSide; i <= kSide; ++i) {
    for (int j = -kSide; j <= kSide; ++j) {
      for (int k = -1; k <= 1; ++k) {
        const double mass = std::exp(-0.5 * static_cast<double>(i * i + j * j + k * k));
        sum += mass;
        belief.cells.push_back(
            {static_cast<float>(here.x + i * pose.sigma), static_cast<float>(here.y + j * pose.sigma),
             static_cast<float>(here.theta.radians() + k * pose.sigma_heading), static_cast<float>(mass)});
      }
    }
  }
  for (auto& cell : belief.cells) cell.mass = static_cast<float>(cell.mass / sum);
  belief.modes.push_back(mode_of(pose));
  return belief;
}

}  // namespace docent::planning
