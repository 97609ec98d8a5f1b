#include "docent/vision/depth/ground_plane.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace docent::vision {
namespace {

struct PlanePoint {
  Eigen::Vector3d at;
  double within = 0.0;  ///< [m] that it may lie off the floor
};

/// z = slope_x x + slope_y y + height: no plane near the level one is steep.
struct LevelPlane {
  double slope_x = 0.0, slope_y = 0.0, height = 0.0;
  [[nodiscard]] double off(const PlanePoint& point) const {
    return point.at.z() - slope_x * point.at.x() - slope_y * point.at.y() - height;
  }
};

bool is_allowed(const LevelPlane& plane, const GroundPlaneParams& params) {
  const double slope = std::tan(params.tilt * std::numbers::pi / 180.0);
  return std::hypot(plane.slope_x, plane.slope_y) <= slope && std::abs(plane.height) <= params.offset;
}

std::optional<LevelPlane> plane_through(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  constexpr double kLeastArea = 0.01;  // [m²] twice that of the triangle, from above
  const Eigen::Vector3d normal = (b.at - a.at).cross(c.at - a.at);
  if (std::abs(normal.z()) < kLeastArea) return std::nullopt;
  LevelPlane plane{-normal.x() / normal.z(), -normal.y() / normal.z(), 0.0};
  plane.height = a.at.z() - plane.slope_x * a.at.x() - plane.slope_y * a.at.y();
  return plane;
}

/// Least squares over the points that lie on it; farther ones weigh less.
LevelPlane fitted(const std::vector<PlanePoint>& points, const LevelPlane& start) {
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const PlanePoint& point : points) {
    if (std::abs(start.off(point)) > point.within) continue;
    const Eigen::Vector3d row{point.at.x(), point.at.y(), 1.0};
    const double weight = 1.0 / (point.within * point.within);
    sums += weight * row * row.transpose();
    right += weight * point.at.z() * row;
  }
  sums(0, 0) += 1.0;  // one point says no slope
  sums(1, 1) += 1.0;
  sums(2, 2) += 1.0;
  const Eigen::Vector3d solved = sums.ldlt().solve(right);
  return {solved.x(), solved.y(), solved.z()};
}

std::size_t count_on(const std::vector<PlanePoint>& points, const LevelPlane& plane, std::size_t step) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += step)
    if (std::abs(plane.off(points[i])) <= points[i].within) ++count;
  return count;
}

}  // namespace

Result<void> GroundPlaneParams::validate() const {
  if (!(tilt >= 0.0 && tilt <= 10.0)) return fail("ground plane: tilt must be in 0..10");
  if (!(offset > 0.0 && within > 0.0 && reach > 0.0)) return fail("ground plane: offset, within and reach must be > 0");
  if (!(step >= 1 && trials >= 1 && judges >= 1)) return fail("ground plane: step, trials and judges must be >= 1");
  if (!(least_share >= 0.0 && least_share <= 1.0)) return fail("ground plane: least_share must be in 0..1");
  return {};
}

GroundPlane find_ground_plane(const DepthPicture& picture, const DepthPoints& points, const GroundPlaneParams& params,
                              Rng& rng) {
  const double slope = std::tan(params.tilt * std::numbers::pi / 180.0);
  std::vector<PlanePoint> near;  // that may be of the floor
  std::size_t looked_at = 0;
  for (int row = params.step / 2; row < picture.rows; row += params.step) {
    for (int column = params.step / 2; column < picture.columns; column += params.step) {
      const std::size_t i = picture.index(column, row);
      const float depth = picture.depth[i];
      if (!(depth > 0.0F && depth < params.reach)) continue;
      ++looked_at;
      const Eigen::Vector3d at{points.x[i], points.y[i], points.z[i]};
      if (std::abs(at.z()) > params.offset + slope * std::hypot(at.x(), at.y())) continue;
      near.push_back({at, params.within + static_cast<double>(depth_noise(depth))});
    }
  }
  GroundPlane ground;
  if (near.size() < 3) return ground;
  const auto draw = [&] {
    return near[static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(near.size()) - 1))];
  };
  const std::size_t step = std::max<std::size_t>(1, near.size() / static_cast<std::size_t>(params.judges));
  LevelPlane best;
  std::size_t most = count_on(near, best, step);
  for (int trial = 0; trial < params.trials; ++trial) {
    const PlanePoint a = draw(), b = draw(), c = draw();
    const auto plane = plane_through(a, b, c);
    if (!plane || !is_allowed(*plane, params)) continue;
    const std::size_t count = count_on(near, *plane, step);
    if (count > most) {
      most = count;
      best = *plane;
    }
  }
  for (int i = 0; i < 2; ++i)
    if (const LevelPlane closer = fitted(near, best); is_allowed(closer, params)) best = closer;
  ground.share = static_cast<double>(count_on(near, best, 1)) / static_cast<double>(looked_at);
  if (ground.share < params.least_share) return ground;
  ground.is_seen = true;
  const double length = std::sqrt(1.0 + best.slope_x * best.slope_x + best.slope_y * best.slope_y);
  ground.normal = Eigen::Vector3d{-best.slope_x, -best.slope_y, 1.0} / length;
  ground.offset = -best.height / length;
  return ground;
}

}  // namespace docent::vision
