#include "docent/vision/ceiling/mosaic_pair.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

constexpr int kFirstHeight = 5;  // after pose and light of both, and the camera's turn

/// Makes a residual the root of Cauchy's loss: what is far off (a beam that hangs lower, a wall) pulls hardly any more.
/// @returns its slope
double cauchy(double& residual, double limit) {
  const double ratio = residual / limit, squared = ratio * ratio;
  if (squared < 1e-8) return 1.0;
  const double root = std::sqrt(std::log1p(squared));
  residual = std::copysign(limit * root, ratio);
  return std::abs(ratio) / ((1.0 + squared) * root);
}

/// By small angles about the x and the y axis, a first approximation.
Eigen::Matrix3d turned_by(double roll, double pitch) {
  Eigen::Matrix3d turned;
  turned << 1.0, 0.0, pitch, 0.0, 1.0, -roll, -pitch, roll, 1.0;
  return turned;
}

void set_three(double* to, double x, double y, double theta) { to[0] = x, to[1] = y, to[2] = theta; }

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
  *mutable_parameter_block_sizes() = {3, 2, 3, 2, 2};
  mutable_parameter_block_sizes()->resize(static_cast<std::size_t>(kFirstHeight) + parts.size(), 1);
}

bool MosaicPair::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const double* first = parameters[0];
  const double* first_light = parameters[1];
  const double* second = parameters[2];
  const double* second_light = parameters[3];
  const double roll = parameters[4][0], pitch = parameters[4][1];
  const double ci = std::cos(first[2]), si = std::sin(first[2]), ck = std::cos(second[2]), sk = std::sin(second[2]);
  const double up = std::exp(0.5 * (second_light[0] - first_light[0])), down = 1.0 / up;
  const Eigen::Vector3d& lens = camera_.mount.position;
  const Eigen::Matrix3d camera_from_robot = camera_.mount.robot_from_camera.transpose();
  const Eigen::Matrix3d turned_back = turned_by(roll, pitch).transpose();
  const std::size_t heights = parameter_block_sizes().size() - static_cast<std::size_t>(kFirstHeight);
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    const PartSample& sample = samples_[n];
    const auto told_x = static_cast<double>(sample.look.slope_x), told_y = static_cast<double>(sample.look.slope_y);
    const double long_up = 1.0 / (1.0 + roll * told_y - pitch * told_x);
    const double slope_x = (told_x + pitch) * long_up, slope_y = (told_y - roll) * long_up;
    const double height = parameters[kFirstHeight + sample.part][0], above = height - lens.z();
    const double x = lens.x() + above * slope_x, y = lens.y() + above * slope_y;
    const Point2 turned{ci * x - si * y, si * x + ci * y};
    const double dx = first[0] + turned.x - second[0], dy = first[1] + turned.y - second[1];
    const Point2 seen{ck * dx + sk * dy, -sk * dx + ck * dy};
    const Eigen::Vector3d ray{seen.x - lens.x(), seen.y - lens.y(), above};
    PixelByRay by_camera_ray;
    const auto pixel = camera_.lens.pixel_of(camera_from_robot * (turned_back * ray), &by_camera_ray);
    ShrunkPicture::Value value;
    const bool is_seen = pixel && other_.look(pixel->x(), pixel->y(), value);
    const double own = static_cast<double>(sample.look.brightness) - first_light[1],
                 others = value.brightness - second_light[1];
    double off = is_seen ? weight_ * (up * own - down * others) : 0.0;
    const double slope = is_seen ? cauchy(off, scales_.outlier * weight_ * scales_.brightness) : 0.0;
    residuals[n] = off;
    if (!jacobians) continue;
    const double scale = slope * weight_;
    Eigen::RowVector3d by_told_ray = Eigen::RowVector3d::Zero();
    if (is_seen)
      by_told_ray = -scale * down * (Eigen::RowVector2d{value.by_x, value.by_y} * by_camera_ray * camera_from_robot);
    const Eigen::RowVector3d by_place = by_told_ray * turned_back;
    const double by_x = by_place.x() * ck - by_place.y() * sk, by_y = by_place.x() * sk + by_place.y() * ck;  // map
    const double by_slope_x = above * (by_x * ci + by_y * si), by_slope_y = above * (by_y * ci - by_x * si);
    if (double* to = jacobians[0]) set_three(to + 3 * n, by_x, by_y, by_y * turned.x - by_x * turned.y);
    const double by_gain = 0.5 * scale * (up * own + down * others);
    if (double* to = jacobians[1]) to[2 * n] = -by_gain, to[2 * n + 1] = -scale * up;
    if (double* to = jacobians[2]) set_three(to + 3 * n, -by_x, -by_y, by_place.x() * seen.y - by_place.y() * seen.x);
    if (double* to = jacobians[3]) to[2 * n] = by_gain, to[2 * n + 1] = scale * down;
    if (double* to = jacobians[4]) {
      to[2 * n] = by_slope_x * -slope_x * told_y * long_up - by_slope_y * long_up * (1.0 + slope_y * told_y) +
                  by_told_ray.y() * ray.z() - by_told_ray.z() * ray.y();
      to[2 * n + 1] = by_slope_x * long_up * (1.0 + slope_x * told_x) + by_slope_y * slope_y * told_x * long_up -
                      by_told_ray.x() * ray.z() + by_told_ray.z() * ray.x();
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
