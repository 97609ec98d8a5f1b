#include "docent/localization/markov/motion_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent {

namespace {

/// Symmetric weights with the given variance [steps^2], and `tail` of the mass spread flat over one more step each
/// side. Up to half a step squared three entries have the variance exactly; beyond that a cut-off Gaussian.
std::vector<double> blur_weights(double variance, double tail) {
  std::vector<double> weights;
  if (variance <= 0.5) {
    weights = {variance / 2.0, 1.0 - variance, variance / 2.0};
  } else {
    const int reach = static_cast<int>(std::ceil(3.0 * std::sqrt(variance)));
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i) {
      weights.push_back(std::exp(-0.5 * i * i / variance));
      sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
  }
  if (tail <= 0.0) return weights;
  std::vector<double> wider(weights.size() + 2, 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) wider[i + 1] = (1.0 - tail) * weights[i];
  for (double& weight : wider) weight += tail / static_cast<double>(wider.size());
  return wider;
}

/// `weights`, and `tail` of the mass falling off slowly to both sides: wheels that slip turn a robot by many degrees,
/// and a belief without tails never looks there.
std::vector<double> with_slow_tail(const std::vector<double>& weights, double tail, double scale) {
  if (tail <= 0.0) return weights;
  const int half = static_cast<int>(weights.size() / 2);
  const int reach = std::max(half, static_cast<int>(std::ceil(4.0 * scale)));
  std::vector<double> slow;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    slow.push_back(std::exp(-std::abs(i) / scale));
    sum += slow.back();
  }
  for (int i = -reach; i <= reach; ++i) {
    double& weight = slow[static_cast<std::size_t>(i + reach)];
    weight *= tail / sum;
    if (std::abs(i) <= half) weight += (1.0 - tail) * weights[static_cast<std::size_t>(i + half)];
  }
  return slow;
}

/// Where a coordinate [cells] lands: bilinear shares of two cells, blurred. Index 0 is cell `first`.
struct Landing {
  int first = 0;
  std::vector<double> shares;
};
Landing landing(double position, double variance, double tail) {
  const double below = std::floor(position);
  const double f = position - below;
  const std::vector<double> blur = blur_weights(std::max(0.0, variance - f * (1.0 - f)), tail);
  const int reach = static_cast<int>(blur.size() / 2);
  Landing result{static_cast<int>(below) - reach, std::vector<double>(blur.size() + 1, 0.0)};
  for (std::size_t i = 0; i < blur.size(); ++i) {
    result.shares[i] += (1.0 - f) * blur[i];
    result.shares[i + 1] += f * blur[i];
  }
  return result;
}

}  // namespace

MotionKernel motion_kernel(const StateSpace& space, const OdometryModelParams& params, Point2 shift,
                           const OdometryStep& odometry) {
  const MotionNoise noise = odometry.noise;
  const double cell = space.frame().resolution;
  const double step = space.heading_step();
  const auto headings = static_cast<std::size_t>(space.headings());
  // A robot that stands does not slip; the tails come with the motion.
  const double way_tail = params.slip_probability * std::min(1.0, odometry.way / 0.25);
  const double turn_tail = params.slip_probability * std::min(1.0, odometry.way / 0.25 + odometry.turn / 0.5);

  const int most = static_cast<int>(std::ceil(norm(shift) / cell)) + 12;
  const int width = 2 * most + 1;
  std::vector<std::vector<float>> weights(static_cast<std::size_t>(width) * static_cast<std::size_t>(width));
  const double variance = noise.position_variance / (cell * cell);
  for (std::size_t h = 0; h < headings; ++h) {
    const Pose2 turn_only{0.0, 0.0, Angle::radians(static_cast<double>(h) * step)};
    const Point2 moved = turn_only * shift;
    const Landing x = landing(moved.x / cell, std::min(variance, 9.0), way_tail);
    const Landing y = landing(moved.y / cell, std::min(variance, 9.0), way_tail);
    for (std::size_t j = 0; j < y.shares.size(); ++j) {
      for (std::size_t i = 0; i < x.shares.size(); ++i) {
        const double weight = x.shares[i] * y.shares[j];
        if (weight < 1e-7) continue;
        const int column = std::clamp(x.first + static_cast<int>(i), -most, most);
        const int row = std::clamp(y.first + static_cast<int>(j), -most, most);
        auto& entry = weights[static_cast<std::size_t>((row + most) * width + column + most)];
        if (entry.empty()) entry.assign(headings, 0.0F);
        entry[h] += static_cast<float>(weight);
      }
    }
  }

  MotionKernel kernel;
  for (int row = -most; row <= most; ++row) {
    for (int column = -most; column <= most; ++column) {
      auto& entry = weights[static_cast<std::size_t>((row + most) * width + column + most)];
      if (entry.empty()) continue;
      MotionKernel::Offset offset{column, row, std::move(entry), headings, 0};
      for (std::size_t h = 0; h < headings; ++h) {
        if (offset.weights[h] == 0.0F) continue;
        offset.first = std::min(offset.first, h);
        offset.last = h + 1;
      }
      kernel.reach = std::max({kernel.reach, std::abs(column), std::abs(row)});
      kernel.offsets.push_back(std::move(offset));
    }
  }

  const double heading_variance = std::min(noise.heading_variance / (step * step), 100.0);
  constexpr double kSlipTurn = 5.0 * std::numbers::pi / 180.0;
  for (const double weight : with_slow_tail(blur_weights(heading_variance, 0.0), turn_tail, kSlipTurn / step))
    kernel.heading_weights.push_back(static_cast<float>(weight));
  return kernel;
}

}  // namespace docent
