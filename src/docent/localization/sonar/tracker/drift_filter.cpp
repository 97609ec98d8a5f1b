#include "docent/localization/sonar/tracker/drift_filter.h"

#include <algorithm>
#include <cmath>

namespace docent::localization {

PoseMatrix inverse_of(const PoseMatrix& m) {
  const double a = m[4] * m[8] - m[5] * m[7];
  const double b = m[2] * m[7] - m[1] * m[8];
  const double c = m[1] * m[5] - m[2] * m[4];
  double determinant = m[0] * a + m[3] * b + m[6] * c;
  if (!(std::abs(determinant) > 1e-30)) determinant = 1e-30;
  const double s = 1.0 / determinant;
  return {s * a,
          s * b,
          s * c,
          s * (m[5] * m[6] - m[3] * m[8]),
          s * (m[0] * m[8] - m[2] * m[6]),
          s * (m[2] * m[3] - m[0] * m[5]),
          s * (m[3] * m[7] - m[4] * m[6]),
          s * (m[1] * m[6] - m[0] * m[7]),
          s * (m[0] * m[4] - m[1] * m[3])};
}

double squared_length(const PoseMatrix& matrix, const std::array<double, 3>& value) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) sum += value[i] * matrix[3 * i + k] * value[k];
  return sum;
}

std::array<double, 3> difference(const Pose2& to, const Pose2& from) {
  return {to.x - from.x, to.y - from.y, (to.theta - from.theta).radians()};
}

Result<void> OdometryDriftParams::validate() const {
  if (!(scale > 0.0 && scale < 0.5)) return fail("drift.scale must be > 0 and < 0.5");
  if (!(turning > 0.0 && turning < 0.5)) return fail("drift.turning must be > 0 and < 0.5");
  if (!(veer > 0.0 && veer < 0.5)) return fail("drift.veer must be > 0 and < 0.5");
  return {};
}

DriftFilter::DriftFilter(const motion_models::OdometryModelParams& noise, const OdometryDriftParams& drift)
    : noise_{noise} {
  at(3, 3) = drift.scale * drift.scale;
  at(4, 4) = drift.turning * drift.turning;
  at(5, 5) = drift.veer * drift.veer;
}

void DriftFilter::start_at(const Pose2& map_from_robot, const PoseMatrix& covariance) {
  pose_ = map_from_robot;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < kStates; ++k) at(i, k) = at(k, i) = 0.0;
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) at(i, k) = covariance[3 * i + k];
}

Pose2 DriftFilter::move(const Pose2& step) {
  const double turn = step.theta.radians();
  const Pose2 straightened{step.x * (1.0 + drift_[0]), step.y * (1.0 + drift_[0]),
                           Angle::radians(turn * (1.0 + drift_[1]) + drift_[2] * step.x)};
  const double c = std::cos(pose_.theta.radians());
  const double s = std::sin(pose_.theta.radians());
  // Jacobian: identity, plus these rows' entries.
  std::array<std::array<double, kStates>, 3> jacobian{};
  for (std::size_t i = 0; i < 3; ++i) jacobian[i][i] = 1.0;
  jacobian[0][2] = -s * straightened.x - c * straightened.y;
  jacobian[1][2] = c * straightened.x - s * straightened.y;
  jacobian[0][3] = c * step.x - s * step.y;
  jacobian[1][3] = s * step.x + c * step.y;
  jacobian[2][4] = turn;
  jacobian[2][5] = step.x;
  std::array<std::array<double, kStates>, 3> product{};  // jacobian * covariance
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < kStates; ++k)
      for (std::size_t j = 0; j < kStates; ++j) product[i][k] += jacobian[i][j] * at(j, k);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 3; k < kStates; ++k) at(i, k) = at(k, i) = product[i][k];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = i; k < 3; ++k) {
      double sum = 0.0;
      for (std::size_t j = 0; j < kStates; ++j) sum += product[i][j] * jacobian[k][j];
      at(i, k) = at(k, i) = sum;
    }
  }
  const motion_models::MotionNoise noise = motion_models::motion_noise(noise_, step);
  at(0, 0) += noise.position_variance;
  at(1, 1) += noise.position_variance;
  at(2, 2) += noise.heading_variance;
  pose_ = pose_ * straightened;
  return straightened;
}

void DriftFilter::correct_heading(Angle measured, double deviation) {
  const double innovation = (measured - pose_.theta).radians();
  const double variance = at(2, 2) + deviation * deviation;
  std::array<double, kStates> gain{};
  std::array<double, kStates> by{};
  for (std::size_t i = 0; i < kStates; ++i) {
    gain[i] = at(i, 2) / variance;
    by[i] = gain[i] * innovation;
  }
  for (std::size_t i = 0; i < kStates; ++i)
    for (std::size_t k = i; k < kStates; ++k) at(i, k) = at(k, i) = at(i, k) - gain[i] * gain[k] * variance;
  shift(by);
}

void DriftFilter::correct_pose(const Pose2& posterior, const PoseMatrix& covariance) {
  const PoseMatrix prior = this->covariance();
  const PoseMatrix information = inverse_of(prior);
  const std::array<double, 3> change = difference(posterior, pose_);
  // Regression of the whole state on its first three components.
  std::array<std::array<double, 3>, kStates> gain{};
  std::array<double, kStates> by{};
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < 3; ++j) gain[i][k] += at(i, j) * information[3 * j + k];
      by[i] += gain[i][k] * change[k];
    }
  }
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t k = i; k < kStates; ++k) {
      double less = 0.0;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          less += gain[i][a] * (prior[3 * a + b] - covariance[3 * a + b]) * gain[k][b];
      at(i, k) = at(k, i) = at(i, k) - less;
    }
  }
  shift(by);
}

void DriftFilter::widen(double position, double heading) {
  at(0, 0) += position * position;
  at(1, 1) += position * position;
  at(2, 2) += heading * heading;
}

PoseMatrix DriftFilter::covariance() const {
  return {at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2), at(2, 0), at(2, 1), at(2, 2)};
}

void DriftFilter::shift(const std::array<double, kStates>& by) {
  pose_ = {pose_.x + by[0], pose_.y + by[1], pose_.theta + Angle::radians(by[2])};
  for (std::size_t i = 0; i < 3; ++i) {
    drift_[i] = std::clamp(drift_[i] + by[3 + i], -0.2, 0.2);  // beyond, a model of drift means nothing
  }
}

}  // namespace docent::localization
