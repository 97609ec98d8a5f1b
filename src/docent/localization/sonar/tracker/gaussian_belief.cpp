#include "docent/localization/sonar/tracker/gaussian_belief.h"

#include <algorithm>
#include <cmath>

namespace docent::localization {
namespace {

constexpr int kDeviations = 3;  // to each side

/// Lower triangle L with L L' = covariance.
PoseMatrix root_of(const PoseMatrix& covariance) {
  PoseMatrix root{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      double sum = covariance[3 * row + column];
      for (std::size_t k = 0; k < column; ++k) sum -= root[3 * row + k] * root[3 * column + k];
      const double pivot = root[3 * column + column];
      root[3 * row + column] = row == column ? std::sqrt(std::max(sum, 0.0)) : (pivot > 0.0 ? sum / pivot : 0.0);
    }
  }
  return root;
}

void add_rest(BeliefSummary& summary, const OccupancyGrid& map, double mass) {
  const GridFrame& frame = map.frame;
  summary.rest_origin = frame.origin;
  summary.rest_columns = static_cast<int>(std::ceil(frame.columns * frame.resolution / summary.rest_cell_size));
  summary.rest_rows = static_cast<int>(std::ceil(frame.rows * frame.resolution / summary.rest_cell_size));
  summary.rest.assign(static_cast<std::size_t>(summary.rest_columns * summary.rest_rows), 0.0F);
  std::vector<int> free(summary.rest.size(), 0);
  int all = 0;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      if (!map.is_free({column, row})) continue;
      const auto x = static_cast<int>((column + 0.5) * frame.resolution / summary.rest_cell_size);
      const auto y = static_cast<int>((row + 0.5) * frame.resolution / summary.rest_cell_size);
      ++free[static_cast<std::size_t>(y * summary.rest_columns + x)];
      ++all;
    }
  }
  for (std::size_t i = 0; i < free.size() && all > 0; ++i) {
    summary.rest[i] = static_cast<float>(mass * free[i] / all);
  }
}

}  // namespace

BeliefSummary gaussian_belief(const Pose2& mean, const PoseMatrix& covariance, double p_lost,
                              const OccupancyGrid& map) {
  BeliefSummary summary;
  const double mass = 1.0 - p_lost;
  const PoseMatrix root = root_of(covariance);
  double weights = 0.0;
  for (int a = -kDeviations; a <= kDeviations; ++a) {
    for (int b = -kDeviations; b <= kDeviations; ++b) {
      for (int c = -kDeviations; c <= kDeviations; ++c) {
        const double weight = std::exp(-0.5 * (a * a + b * b + c * c));
        weights += weight;
        summary.cells.push_back(
            {static_cast<float>(mean.x + root[0] * a), static_cast<float>(mean.y + root[3] * a + root[4] * b),
             static_cast<float>((mean.theta + Angle::radians(root[6] * a + root[7] * b + root[8] * c)).radians()),
             static_cast<float>(weight)});
      }
    }
  }
  for (auto& cell : summary.cells) {
    const double share = mass * static_cast<double>(cell.mass) / weights;
    cell.mass = static_cast<float>(share);
    if (share > 0.0) summary.entropy -= share * std::log(share);
  }
  std::stable_sort(summary.cells.begin(), summary.cells.end(),
                   [](const auto& first, const auto& second) { return first.mass > second.mass; });
  summary.modes.push_back({mean, covariance, mass});
  summary.active_mass = mass;
  summary.active_states = summary.cells.size();
  add_rest(summary, map, p_lost);
  return summary;
}

}  // namespace docent::localization
