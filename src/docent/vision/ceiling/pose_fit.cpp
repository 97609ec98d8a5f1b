#include "docent/vision/ceiling/pose_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace docent::vision {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr double kStiff = 1e-9;        // of the largest diagonal entry: keeps what is not observed where it is
constexpr double kPlain = 1e-6;        // [square of brightness] variance of what is plain
constexpr double kFarthestStep = 0.3;  // [m, rad] in one step

/// The looks of all samples, in the map.
class Looks {
 public:
  Looks(const MosaicLevel& level, const CameraMount& mount, const Pose2& map_from_robot)
      : level_{level}, mount_{mount}, map_from_robot_{map_from_robot} {
    c_ = std::cos(map_from_robot.theta.radians());
    s_ = std::sin(map_from_robot.theta.radians());
  }
  /// @param at  from the robot to what is seen, along the map's axes
  bool look(const CeilingSample& sample, Point2& at, MosaicLevel::Look& seen) const {
    const std::vector<double>& heights = level_.heights();
    for (std::size_t part = 0; part < heights.size(); ++part) {
      const double above = heights[part] - mount_.position.z();
      const double x = mount_.position.x() + above * static_cast<double>(sample.slope_x);
      const double y = mount_.position.y() + above * static_cast<double>(sample.slope_y);
      at = {c_ * x - s_ * y, s_ * x + c_ * y};
      if (level_.look(map_from_robot_.position() + at, part, seen)) return true;
    }
    return false;
  }

 private:
  const MosaicLevel& level_;
  const CameraMount& mount_;
  Pose2 map_from_robot_;
  double c_, s_;
};

double weight_of(const CeilingSample& sample, double far_weight) {
  const double slope2 = static_cast<double>(sample.slope_x * sample.slope_x + sample.slope_y * sample.slope_y);
  if (far_weight == 0.0) return 1.0;
  if (far_weight == 0.75) {  // the default, without a power
    const double root = std::sqrt(1.0 / (1.0 + slope2));
    return root * std::sqrt(root);
  }
  return std::pow(1.0 + slope2, -far_weight);
}

struct LookSums {
  double weight = 0.0, picture = 0.0, mosaic = 0.0, pictures2 = 0.0, mosaics2 = 0.0, both = 0.0;
  int samples = 0;
  void add(double w, double in_picture, double in_mosaic) {
    weight += w, picture += w * in_picture, mosaic += w * in_mosaic;
    pictures2 += w * in_picture * in_picture, mosaics2 += w * in_mosaic * in_mosaic, both += w * in_picture * in_mosaic;
    ++samples;
  }
  [[nodiscard]] double picture_variance() const { return pictures2 / weight - picture / weight * (picture / weight); }
  [[nodiscard]] double mosaic_variance() const { return mosaics2 / weight - mosaic / weight * (mosaic / weight); }
  [[nodiscard]] double covariance() const { return both / weight - picture / weight * (mosaic / weight); }
  [[nodiscard]] double correlation() const {
    if (!(weight > 0.0) || picture_variance() < kPlain || mosaic_variance() < kPlain) return 0.0;
    return std::clamp(covariance() / std::sqrt(picture_variance() * mosaic_variance()), -1.0, 1.0);
  }
};

LookSums sums_at(const Looks& looks, std::span<const CeilingSample> samples, double far_weight) {
  LookSums sums;
  Point2 at;
  MosaicLevel::Look seen;
  for (const CeilingSample& sample : samples)
    if (looks.look(sample, at, seen))
      sums.add(weight_of(sample, far_weight), static_cast<double>(sample.brightness),
               static_cast<double>(seen.brightness));
  return sums;
}

/// Normal equations of x, y, theta, gain and offset.
struct Equations {
  Matrix5 information = Matrix5::Zero();
  Vector5 gradient = Vector5::Zero();
  double squares = 0.0, weight = 0.0;
  int samples = 0;
};

/// @param weights  of all samples. @param stride  one of so many samples is looked at
Equations equations_at(const Looks& looks, std::span<const CeilingSample> samples, std::span<const double> weights,
                       std::size_t stride, const PoseFit& fit, double outlier) {
  Equations equations;
  Point2 at;
  MosaicLevel::Look seen;
  const double gain = fit.gain, offset = fit.offset;
  std::array<double, 20> sums{};  // row by row: of the lower triangle, then of the gradient
  for (std::size_t n = 0; n < samples.size(); n += stride) {
    const CeilingSample& sample = samples[n];
    if (!looks.look(sample, at, seen)) continue;
    const auto by_x = static_cast<double>(seen.by_x), by_y = static_cast<double>(seen.by_y);
    const double residual =
        gain * static_cast<double>(seen.brightness) + offset - static_cast<double>(sample.brightness);
    const double size = std::abs(residual);
    const double weight = weights[n] * (size > outlier ? outlier / size : 1.0);
    const double row[5] = {gain * by_x, gain * by_y, gain * (by_y * at.x - by_x * at.y),
                           static_cast<double>(seen.brightness), 1.0};
    double* sum = sums.data();
    for (int i = 0; i < 5; ++i) {
      const double weighted = weight * row[i];
      for (int k = 0; k <= i; ++k) *sum++ += weighted * row[k];
      *sum++ += weighted * residual;
    }
    equations.squares += weight * residual * residual;
    equations.weight += weight;
    ++equations.samples;
  }
  const double* sum = sums.data();
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k <= i; ++k) equations.information(i, k) = *sum++;
    equations.gradient(i) = *sum++;
  }
  return equations;
}

Pose2 moved(const Pose2& pose, const Vector5& step) {
  return {pose.x - step(0), pose.y - step(1), pose.theta - Angle::radians(step(2))};
}

}  // namespace

Result<void> PoseFitParams::validate() const {
  if (!(most_steps > 0)) return fail("pose_fit.most_steps must be > 0");
  if (!(coarse_stride > 0)) return fail("pose_fit.coarse_stride must be > 0");
  if (!(outlier > 0.0)) return fail("pose_fit.outlier must be > 0");
  if (!(far_weight >= 0.0)) return fail("pose_fit.far_weight must be >= 0");
  if (!(least_share >= 0.0 && least_share <= 1.0)) return fail("pose_fit.least_share must be 0 .. 1");
  if (!(least_contrast > 0.0)) return fail("pose_fit.least_contrast must be > 0");
  if (!(close_enough > 0.0)) return fail("pose_fit.close_enough must be > 0");
  return {};
}

Agreement agreement_at(const Pose2& map_from_robot, const MosaicLevel& level, const CameraMount& mount,
                       std::span<const CeilingSample> samples, double far_weight) {
  const LookSums sums = sums_at(Looks{level, mount, map_from_robot}, samples, far_weight);
  if (sums.samples == 0) return {};
  return {sums.correlation(), sums.samples, std::sqrt(std::max(0.0, sums.mosaic_variance()))};
}

std::optional<PoseFit> fit_pose(const Pose2& start, const MosaicPyramid& levels, const CameraMount& mount,
                                std::span<const CeilingSample> samples, const PoseFitParams& params) {
  PoseFit fit{.map_from_robot = start};
  const double least = std::max(10.0, params.least_share * static_cast<double>(samples.size()));
  std::vector<double> weights;
  weights.reserve(samples.size());
  for (const CeilingSample& sample : samples) weights.push_back(weight_of(sample, params.far_weight));
  Matrix5 information = Matrix5::Identity();
  double variance = 0.0;
  for (const MosaicLevel& level : levels) {
    const LookSums sums = sums_at(Looks{level, mount, fit.map_from_robot}, samples, params.far_weight);
    if (sums.samples < least || sums.mosaic_variance() < kPlain || sums.picture_variance() < kPlain)
      return std::nullopt;
    fit.gain = std::max(params.least_contrast, sums.covariance() / sums.mosaic_variance());
    fit.offset = (sums.picture - fit.gain * sums.mosaic) / sums.weight;
    const std::size_t stride = &level == &levels.back() ? 1 : static_cast<std::size_t>(params.coarse_stride);
    for (int i = 0; i < params.most_steps; ++i) {
      const Equations equations =
          equations_at(Looks{level, mount, fit.map_from_robot}, samples, weights, stride, fit, params.outlier);
      if (equations.samples * static_cast<double>(stride) < least) return std::nullopt;
      information = equations.information.selfadjointView<Eigen::Lower>();
      information.diagonal().array() += kStiff * information.diagonal().maxCoeff();
      variance = equations.squares / equations.weight;
      Vector5 step = information.ldlt().solve(equations.gradient);
      if (!step.allFinite()) return std::nullopt;
      const double farthest = step.head<3>().cwiseAbs().maxCoeff();
      if (farthest > kFarthestStep) step *= kFarthestStep / farthest;
      fit.map_from_robot = moved(fit.map_from_robot, step);
      fit.gain = std::max(params.least_contrast, fit.gain - step(3));
      fit.offset -= step(4);
      if (farthest < params.close_enough) break;
    }
  }
  const LookSums last = sums_at(Looks{levels.back(), mount, fit.map_from_robot}, samples, params.far_weight);
  if (last.samples < least) return std::nullopt;
  fit.correlation = last.correlation();
  fit.samples = last.samples;
  fit.covariance = (variance * information.ldlt().solve(Matrix5::Identity())).topLeftCorner<3, 3>();
  return fit;
}

}  // namespace docent::vision
