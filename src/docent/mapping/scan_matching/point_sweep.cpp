#include "docent/mapping/scan_matching/point_sweep.h"

#include <cmath>
#include <cstdint>
#include <unordered_set>

namespace docent::mapping {
namespace {

struct SweepEnd {
  Point2 at;
  double range = 0.0;
  double bearing = 0.0;
};

bool on_one_surface(const SweepEnd& a, const SweepEnd& b, const PointSweepParams& params) {
  const double between_beams = std::abs(Angle::radians(a.bearing - b.bearing).radians()) * std::min(a.range, b.range);
  return distance(a.at, b.at) < std::max(params.steepest_gap * between_beams, 0.05) &&
         distance(a.at, b.at) < params.widest_gap;
}

/// Direction of least spread of the ends from `first` to `last`, towards the origin; (0, 0) where they are no line.
Point2 fitted_normal(const std::vector<SweepEnd>& ends, std::size_t first, std::size_t last) {
  if (last - first < 2) return {};
  const auto count = static_cast<double>(last - first + 1);
  Point2 mean;
  for (std::size_t i = first; i <= last; ++i) mean = mean + (1.0 / count) * ends[i].at;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const Point2 d = ends[i].at - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double half_difference = 0.5 * (xx - yy);
  const double root = std::sqrt(half_difference * half_difference + xy * xy);
  const double most = 0.5 * (xx + yy) + root;
  const double least = 0.5 * (xx + yy) - root;
  if (most <= 0.0 || least > 0.1 * most) return {};
  const double along = 0.5 * std::atan2(2.0 * xy, xx - yy);
  Point2 normal{-std::sin(along), std::cos(along)};
  if (dot(normal, mean) > 0.0) normal = -1.0 * normal;
  return normal;
}

}  // namespace

Result<void> PointSweepParams::validate() const {
  if (!(reach > 0.0)) return fail("reach must be > 0 m");
  if (!(nearest >= 0.0)) return fail("nearest must be >= 0 m");
  if (!(widest_gap > 0.0)) return fail("widest_gap must be > 0 m");
  if (!(steepest_gap > 0.0)) return fail("steepest_gap must be > 0");
  if (!(neighbours > 0)) return fail("neighbours must be > 0");
  return {};
}

std::vector<SurfacePoint> surface_points(const sensor_models::RangeSweep& sweep, const PointSweepParams& params) {
  std::vector<SweepEnd> ends;
  for (const sensor_models::SweepBeam& beam : sweep.beams) {
    if (beam.no_return || beam.range < params.nearest || beam.range > params.reach) continue;
    ends.push_back({endpoint(beam), beam.range, beam.bearing});
  }
  std::vector<SurfacePoint> points;
  points.reserve(ends.size());
  const auto most = static_cast<std::size_t>(params.neighbours);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    std::size_t first = i;
    while (first > 0 && i - first < most && on_one_surface(ends[first], ends[first - 1], params)) --first;
    std::size_t last = i;
    while (last + 1 < ends.size() && last - i < most && on_one_surface(ends[last], ends[last + 1], params)) ++last;
    points.push_back({ends[i].at, fitted_normal(ends, first, last)});
  }
  return points;
}

SurfacePoint transformed(const Pose2& b_from_a, const SurfacePoint& point) {
  const double c = std::cos(b_from_a.theta.radians());
  const double s = std::sin(b_from_a.theta.radians());
  const auto [x, y] = point.at;
  const auto [nx, ny] = point.normal;
  return {{b_from_a.x + c * x - s * y, b_from_a.y + s * x + c * y}, {c * nx - s * ny, s * nx + c * ny}};
}

std::vector<Point2> thinned_points(std::span<const Point2> points, double cell) {
  std::unordered_set<std::uint64_t> taken;
  std::vector<Point2> kept;
  for (const Point2 p : points) {
    const auto column = static_cast<std::int32_t>(std::floor(p.x / cell));
    const auto row = static_cast<std::int32_t>(std::floor(p.y / cell));
    const std::uint64_t key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32U) |
                              static_cast<std::uint64_t>(static_cast<std::uint32_t>(row));
    if (taken.insert(key).second) kept.push_back(p);
  }
  return kept;
}

}  // namespace docent::mapping
