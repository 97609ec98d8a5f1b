#include "docent/localization/markov/motion_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent::localization {

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

/// `weights`, and `tail` of the mass falling off slowly to both sides, in steps of four headings: wheels that slip turn
/// a robot by many degrees, and a belief without tails never looks there.
HeadingBlur with_slow_tail(const std::vector<double>& weights, double tail, double scale) {
  HeadingBlur blur;
  if (tail <= 0.0) {
    blur.middle.assign(weights.begin(), weights.end());
    return blur;
  }
  const int half = static_cast<int>(weights.size() / 2);
  const int fours = std::max(0, (static_cast<int>(std::ceil(4.0 * scale)) - half + 3) / 4);
  const int reach = half + 4 * fours;
  const auto slow = [scale](int turn) { return std::exp(-std::abs(turn) / scale); };
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) sum += slow(i);
  for (int i = -half; i <= half; ++i)
    blur.middle.push_back(
        static_cast<float>((1.0 - tail) * weights[static_cast<std::size_t>(i + half)] + tail / sum * slow(i)));
  for (int i = half + 1; i <= reach; i += 4)
    blur.fours.push_back(static_cast<float>(tail / sum * (slow(i) + slow(i + 1) + slow(i + 2) + slow(i + 3)) / 4.0));
  return blur;
}

/// Offsets below this weight are left out, and what they had goes to the others.
constexpr double kLeastWeight = 1e-6;

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
  double kept = 0.0;
  for (double& share : result.shares) {
    if (share < kLeastWeight) share = 0.0;
    kept += share;
  }
  for (double& share : result.shares) share /= kept;
  return result;
}

/// One landing a heading, as the offsets that each block of headings needs.
AxisTaps taps_of(const std::vector<Landing>& landings) {
  AxisTaps taps;
  int widest = 0;
  for (const Landing& at : landings)
    widest = std::max({widest, std::abs(at.first), std::abs(at.first + static_cast<int>(at.shares.size()) - 1)});
  taps.begin.push_back(0);
  for (std::size_t first = 0; first < landings.size(); first += kRowBlock) {
    const std::size_t count = std::min(kRowBlock, landings.size() - first);
    for (int offset = -widest; offset <= widest; ++offset) {
      std::array<float, kRowBlock> weights{};
      for (std::size_t h = 0; h < count; ++h) {
        const Landing& at = landings[first + h];
        const int i = offset - at.first;
        if (i >= 0 && i < static_cast<int>(at.shares.size()))
          weights[h] = static_cast<float>(at.shares[static_cast<std::size_t>(i)]);
      }
      if (std::all_of(weights.begin(), weights.end(), [](float weight) { return weight == 0.0F; })) continue;
      taps.reach = std::max(taps.reach, std::abs(offset));
      taps.offsets.push_back(offset);
      taps.weights.insert(taps.weights.end(), weights.begin(), weights.end());
    }
    taps.begin.push_back(static_cast<std::uint32_t>(taps.offsets.size()));
  }
  return taps;
}

float weight_of(const AxisTaps& taps, int offset, int heading) {
  const auto h = static_cast<std::size_t>(heading);
  for (std::size_t tap = taps.begin[h / kRowBlock]; tap < taps.begin[h / kRowBlock + 1]; ++tap)
    if (taps.offsets[tap] == offset) return taps.weights[tap * kRowBlock + h % kRowBlock];
  return 0.0F;
}

}  // namespace

float MotionKernel::weight(int column_offset, int row_offset, int heading) const {
  return weight_of(columns, column_offset, heading) * weight_of(rows, row_offset, heading);
}

std::vector<float> MotionKernel::heading_weights() const {
  std::vector<float> weights(2 * headings.reach() + 1);
  const std::size_t middle = weights.size() / 2;
  const std::size_t half = headings.half();
  for (std::size_t turn = 0; turn <= headings.reach(); ++turn)
    weights[middle - turn] = weights[middle + turn] =
        turn <= half ? headings.middle[half + turn] : headings.fours[(turn - half - 1) / 4];
  return weights;
}

MotionKernel motion_kernel(const StateSpace& space, const motion_models::OdometryModelParams& params, Point2 shift,
                           const OdometryStep& odometry) {
  const motion_models::MotionNoise noise = odometry.noise;
  const double cell = space.frame().resolution;
  const double step = space.heading_step();
  // A robot that stands does not slip; the tails come with the motion.
  const double way_tail = params.slip_probability * std::min(1.0, odometry.way / 0.25);
  const double turn_tail = params.slip_probability * std::min(1.0, odometry.way / 0.25 + odometry.turn / 0.5);

  const double variance = std::min(noise.position_variance / (cell * cell), 9.0);
  std::vector<Landing> x;
  std::vector<Landing> y;
  for (int h = 0; h < space.headings(); ++h) {
    const Point2 moved = Pose2{0.0, 0.0, Angle::radians(h * step)} * shift;
    x.push_back(landing(moved.x / cell, variance, way_tail));
    y.push_back(landing(moved.y / cell, variance, way_tail));
  }
  MotionKernel kernel{taps_of(x), taps_of(y), {}};

  const double heading_variance = std::min(noise.heading_variance / (step * step), 100.0);
  constexpr double kSlipTurn = 5.0 * std::numbers::pi / 180.0;
  kernel.headings = with_slow_tail(blur_weights(heading_variance, 0.0), turn_tail, kSlipTurn / step);
  return kernel;
}

}  // namespace docent::localization
