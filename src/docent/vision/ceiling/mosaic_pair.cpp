#include "docent/vision/ceiling/mosaic_pair.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

constexpr int kFirstHeight = 4;  // after pose and light of both

/// Makes a residual the root of twice Huber's loss. @returns its slope
double huber(double& residual, double limit) {
  const double size = std::abs(residual);
  if (size <= limit) return 1.0;
  const double root = std::sqrt(limit * (2.0 * size - limit));
  residual = std::copysign(root, residual);
  return limit / root;
}

}  // namespace

MosaicPair::MosaicPair(const CeilingCamera& camera, std::vector<PartSample> samples, std::vector<std::uint8_t> parts,
                       const ShrunkPicture& other, const PairScales& scales)
    : camera_{camera}, samples_{std::move(samples)}, other_{other}, scales_{scales} {
  DOCENT_CHECK(!samples_.empty());
  for (PartSample& sample : samples_)
    sample.part = static_cast<std::uint8_t>(std::find(parts.begin(), parts.end(), sample.part) - parts.begin());
  const auto count = static_cast<double>(samples_.size());
  weight_ = std::sqrt(std::min(1.0, scales.independent / count)) / scales.brightness;
  set_num_residuals(static_cast<int>(samples_.size()));
  *mutable_parameter_block_sizes() = {3, 2, 3, 2};
  mutable_parameter_block_sizes()->resize(static_cast<std::size_t>(kFirstHeight) + parts.size(), 1);
}

bool MosaicPair::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const double* first = parameters[0];
  const double* first_light = parameters[1];
  const double* second = parameters[2];
  const double* second_light = parameters[3];
  const double ci = std::cos(first[2]), si = std::sin(first[2]), ck = std::cos(second[2]), sk = std::sin(second[2]);
  const double up = std::exp(0.5 * (second_light[0] - first_light[0])), down = 1.0 / up;
  const Eigen::Vector3d& lens = camera_.mount.position;
  const std::size_t heights = parameter_block_sizes().size() - static_cast<std::size_t>(kFirstHeight);
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    const PartSample& sample = samples_[n];
    const auto slope_x = static_cast<double>(sample.look.slope_x), slope_y = static_cast<double>(sample.look.slope_y);
    const double height = parameters[kFirstHeight + sample.part][0], above = height - lens.z();
    const double x = lens.x() + above * slope_x, y = lens.y() + above * slope_y;
    const Point2 turned{ci * x - si * y, si * x + ci * y};
    const double dx = first[0] + turned.x - second[0], dy = first[1] + turned.y - second[1];
    const Point2 seen{ck * dx + sk * dy, -sk * dx + ck * dy};
    Eigen::Matrix<double, 2, 3> by_seen;
    const auto pixel = camera_.pixel_of(seen, height, &by_seen);
    ShrunkPicture::Value value;
    const bool is_seen = pixel && other_.look(pixel->x(), pixel->y(), value);
    const double own = static_cast<double>(sample.look.brightness) - first_light[1],
                 others = value.brightness - second_light[1];
    double off = is_seen ? weight_ * (up * own - down * others) : 0.0;
    const double slope = is_seen ? huber(off, scales_.outlier * weight_ * scales_.brightness) : 0.0;
    residuals[n] = off;
    if (!jacobians) continue;
    const double scale = slope * weight_;
    const Eigen::RowVector3d by_place = -scale * down * (Eigen::RowVector2d{value.by_x, value.by_y} * by_seen);
    const double by_x = by_place.x() * ck - by_place.y() * sk, by_y = by_place.x() * sk + by_place.y() * ck;  // map
    if (double* to = jacobians[0]) {
      to[3 * n] = by_x;
      to[3 * n + 1] = by_y;
      to[3 * n + 2] = by_y * turned.x - by_x * turned.y;
    }
    if (double* to = jacobians[1]) {
      to[2 * n] = -0.5 * scale * (up * own + down * others);
      to[2 * n + 1] = -scale * up;
    }
    if (double* to = jacobians[2]) {
      to[3 * n] = -by_x;
      to[3 * n + 1] = -by_y;
      to[3 * n + 2] = by_place.x() * seen.y - by_place.y() * seen.x;
    }
    if (double* to = jacobians[3]) {
      to[2 * n] = 0.5 * scale * (up * own + down * others);
      to[2 * n + 1] = scale * down;
    }
    for (std::size_t part = 0; part < heights; ++part) {
      if (double* to = jacobians[static_cast<std::size_t>(kFirstHeight) + part]) {
        const bool hit = part == sample.part;
        to[n] = hit ? by_x * (ci * slope_x - si * slope_y) + by_y * (si * slope_x + ci * slope_y) + by_place.z() : 0.0;
      }
    }
  }
  return true;
}

}  // namespace docent::vision
