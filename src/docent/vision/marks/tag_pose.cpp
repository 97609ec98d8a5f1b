#include "docent/vision/marks/tag_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace docent::vision {
namespace {

using Corners = std::array<Eigen::Vector3d, 4>;  // tag frame

Corners corners_of(double side) {
  const double h = 0.5 * side;
  return {Eigen::Vector3d{-h, -h, 0.0}, {h, -h, 0.0}, {h, h, 0.0}, {-h, h, 0.0}};
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd{angle, turn / angle}.toRotationMatrix();
}

/// Differences between where the corners would be seen and where they are. nullopt: one lies behind the camera.
std::optional<Eigen::Matrix<double, 8, 1>> differences(const TagPose& pose, const SeenTag& tag, const TagCamera& camera,
                                                       const Corners& corners) {
  Eigen::Matrix<double, 8, 1> off;
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector3d at = pose.camera_from_tag * corners[k] + pose.position;
    if (!(at.z() > 0.01)) return std::nullopt;
    const Pixel seen = camera.pixel_of(at);
    off(2 * i) = seen.column - tag.corners[k].column;
    off(2 * i + 1) = seen.row - tag.corners[k].row;
  }
  return off;
}

TagPose moved(const TagPose& pose, const Eigen::Matrix<double, 6, 1>& by) {
  return {rotation_of(by.head<3>()) * pose.camera_from_tag, pose.position + by.tail<3>(), pose.error};
}

/// Levenberg-Marquardt over the six numbers of a pose.
std::optional<TagPose> refined(TagPose pose, const SeenTag& tag, const TagCamera& camera, const Corners& corners) {
  constexpr int kRounds = 25;
  constexpr double kStep = 1e-6;
  double damping = 1e-3;
  auto off = differences(pose, tag, camera, corners);
  if (!off) return std::nullopt;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, 8, 6> slopes;
    for (int k = 0; k < 6; ++k) {
      Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
      step(k) = kStep;
      const auto beside = differences(moved(pose, step), tag, camera, corners);
      if (!beside) return std::nullopt;
      slopes.col(k) = (*beside - *off) / kStep;
    }
    Eigen::Matrix<double, 6, 6> normal = slopes.transpose() * slopes;
    normal.diagonal() *= 1.0 + damping;
    const Eigen::Matrix<double, 6, 1> step = normal.ldlt().solve(-slopes.transpose() * *off);
    const TagPose next = moved(pose, step);
    const auto next_off = differences(next, tag, camera, corners);
    if (next_off && next_off->squaredNorm() < off->squaredNorm()) {
      pose = next;
      off = next_off;
      damping = std::max(1e-9, 0.3 * damping);
    } else {
      damping *= 10.0;
    }
    if (step.norm() < 1e-9 || damping > 1e9) break;
  }
  pose.error = std::sqrt(off->squaredNorm() / 4.0);
  return pose;
}

/// From the homography between the tag's plane and the picture's rays.
std::optional<TagPose> pose_by_homography(const SeenTag& tag, const TagCamera& camera, const Corners& corners) {
  Eigen::Matrix<double, 8, 8> equations;
  Eigen::Matrix<double, 8, 1> right;
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double x = corners[k].x(), y = corners[k].y();
    const Eigen::Vector3d ray = camera.ray_of(tag.corners[k]);
    equations.row(2 * i) << x, y, 1.0, 0.0, 0.0, 0.0, -ray.x() * x, -ray.x() * y;
    equations.row(2 * i + 1) << 0.0, 0.0, 0.0, x, y, 1.0, -ray.y() * x, -ray.y() * y;
    right(2 * i) = ray.x();
    right(2 * i + 1) = ray.y();
  }
  const Eigen::Matrix<double, 8, 1> h = equations.fullPivLu().solve(right);
  Eigen::Vector3d first{h(0), h(3), h(6)}, second{h(1), h(4), h(7)}, middle{h(2), h(5), 1.0};
  const double scale = std::sqrt(first.norm() * second.norm());
  if (!(scale > 1e-9) || !h.allFinite()) return std::nullopt;
  first /= scale;
  second /= scale;
  middle /= scale;
  Eigen::Matrix3d turn;
  turn << first, second, first.cross(second);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd{turn, Eigen::ComputeFullU | Eigen::ComputeFullV};
  TagPose pose;
  pose.camera_from_tag = svd.matrixU() * svd.matrixV().transpose();
  if (pose.camera_from_tag.determinant() < 0.0) return std::nullopt;
  pose.position = middle;
  return pose;
}

/// The other plane that looks much the same from afar: its normal mirrored about the line of sight.
TagPose mirrored(const TagPose& pose) {
  const Eigen::Vector3d sight = pose.position.normalized();
  const Eigen::Vector3d normal = pose.camera_from_tag.col(2);
  const Eigen::Vector3d other = 2.0 * normal.dot(sight) * sight - normal;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(normal, other);
  return {turn.toRotationMatrix() * pose.camera_from_tag, pose.position, 0.0};
}

}  // namespace

Pixel TagCamera::pixel_of(const Eigen::Vector3d& point) const {
  const double x = point.x() / point.z(), y = point.y() / point.z();
  const double stretch = 1.0 + radial * (x * x + y * y);
  return {centre_x + focal * stretch * x, centre_y + focal * stretch * y};
}

Eigen::Vector3d TagCamera::ray_of(Pixel pixel) const {
  const double x = (pixel.column - centre_x) / focal, y = (pixel.row - centre_y) / focal;
  double stretch = 1.0;
  for (int i = 0; i < 10; ++i) stretch = 1.0 + radial * (x * x + y * y) / (stretch * stretch);
  return {x / stretch, y / stretch, 1.0};
}

std::vector<TagPose> tag_poses(const SeenTag& tag, const TagCamera& camera, double side) {
  const Corners corners = corners_of(side);
  std::vector<TagPose> poses;
  const auto start = pose_by_homography(tag, camera, corners);
  if (!start) return poses;
  for (const TagPose& from : {*start, mirrored(*start)}) {
    const auto pose = refined(from, tag, camera, corners);
    if (!pose || pose->camera_from_tag.col(2).dot(pose->position) >= 0.0) continue;  // seen from behind
    constexpr double kSame = 0.9999;  // cosine between the normals of one
    const bool is_new = poses.empty() || poses.front().camera_from_tag.col(2).dot(pose->camera_from_tag.col(2)) < kSame;
    if (is_new) poses.push_back(*pose);
  }
  std::stable_sort(poses.begin(), poses.end(), [](const TagPose& a, const TagPose& b) { return a.error < b.error; });
  return poses;
}

std::optional<TagPose> resolved(const std::vector<TagPose>& poses, const Eigen::Vector3d& camera_normal, bool is_up,
                                double apart) {
  if (poses.empty()) return std::nullopt;
  const auto off = [&](const TagPose& pose) {
    return std::acos(std::clamp(pose.camera_from_tag.col(is_up ? 1 : 2).dot(camera_normal), -1.0, 1.0));
  };
  if (poses.size() == 1) return off(poses.front()) < apart ? std::optional{poses.front()} : std::nullopt;
  const double first = off(poses[0]), second = off(poses[1]);
  if (std::abs(first - second) < apart) return std::nullopt;
  return first < second ? poses[0] : poses[1];
}

}  // namespace docent::vision
