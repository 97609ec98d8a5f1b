#include "docent/mapping/scan_matching/line_matcher.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace docent::mapping {
namespace {

constexpr int kFewestPairs = 12;
constexpr double kOpposite = 0.5;  ///< cosine: surfaces that face away from each other by more are two
constexpr double kPriorInformation = 1e-6;

struct NormalEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< sum of J^T w J
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();         ///< sum of J^T w r
  double squares = 0.0;                                   ///< sum of w r^2
  double weights = 0.0;
  int pairs = 0;
};

/// Each point against the line through its nearest neighbour; the displacement is seen in the sweep's frame.
NormalEquations linearised(const SurfaceIndex& reference, std::span<const SurfacePoint> sweep, const Pose2& pose,
                           double gate) {
  NormalEquations sums;
  const double c = std::cos(pose.theta.radians());
  const double s = std::sin(pose.theta.radians());
  for (const SurfacePoint& point : sweep) {
    const Point2 at = pose * point.at;
    const SurfacePoint* met = reference.nearest(at);
    if (met == nullptr || !met->has_normal()) continue;
    const double r = dot(met->normal, at - met->at);
    if (std::abs(r) > gate || distance(at, met->at) > SurfaceIndex::kReach) continue;
    if (point.has_normal()) {
      const Point2 turned{c * point.normal.x - s * point.normal.y, s * point.normal.x + c * point.normal.y};
      if (dot(turned, met->normal) < kOpposite) continue;
    }
    const double share = r / gate;
    const double weight = (1.0 - share * share) * (1.0 - share * share);
    // d r / d (x, y, theta) for pose * exp(x, y, theta)
    const Eigen::Vector3d row{
        met->normal.x * c + met->normal.y * s, -met->normal.x * s + met->normal.y * c,
        met->normal.x * (-s * point.at.x - c * point.at.y) + met->normal.y * (c * point.at.x - s * point.at.y)};
    sums.information += weight * row * row.transpose();
    sums.pull += weight * r * row;
    sums.squares += weight * r * r;
    sums.weights += weight;
    ++sums.pairs;
  }
  return sums;
}

/// The step that the well-known directions ask for; those of next to no information stay.
Eigen::Vector3d step_of(const NormalEquations& sums, double points) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver{sums.information};
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const double value = solver.eigenvalues()[i];
    if (value < 0.01 * points) continue;
    step -= solver.eigenvectors().col(i) * (solver.eigenvectors().col(i).dot(sums.pull) / value);
  }
  return step;
}

}  // namespace

Result<void> LineMatcherParams::validate() const {
  if (!(steps > 0)) return fail("steps must be > 0");
  if (!(first_gate > 0.0 && first_gate <= SurfaceIndex::kReach)) return fail("first_gate must be in (0, 0.4] m");
  if (!(last_gate > 0.0)) return fail("last_gate must be > 0 m");
  if (!(sigma > 0.0)) return fail("sigma must be > 0 m");
  if (!(independent_points > 0.0)) return fail("independent_points must be > 0");
  return {};
}

std::optional<LineMatch> line_match(const SurfaceIndex& reference, std::span<const SurfacePoint> sweep,
                                    const Pose2& first, const LineMatcherParams& params) {
  Pose2 pose = first;
  double gate = params.first_gate;
  NormalEquations sums;
  const auto points = static_cast<double>(sweep.size());
  for (int i = 0; i < params.steps; ++i) {
    sums = linearised(reference, sweep, pose, gate);
    if (sums.pairs < kFewestPairs) return std::nullopt;
    const Eigen::Vector3d step = step_of(sums, points);
    pose = pose * Pose2{step.x(), step.y(), Angle::radians(step.z())};
    const bool is_still = step.head<2>().norm() < 1e-4 && std::abs(step.z()) < 1e-4;
    if (is_still && gate <= params.last_gate) break;
    gate = std::max(params.last_gate, 0.7 * gate);
  }
  sums = linearised(reference, sweep, pose, params.last_gate);
  if (sums.pairs < kFewestPairs) return std::nullopt;
  LineMatch match;
  match.reference_from_sweep = pose;
  match.overlap = sums.pairs / points;
  match.residual = std::sqrt(sums.squares / std::max(sums.weights, 1e-9));
  const double sigma = std::max(params.sigma, match.residual);
  const double worth = std::min(1.0, params.independent_points / sums.weights);
  match.information = sums.information * (worth / (sigma * sigma)) + kPriorInformation * Eigen::Matrix3d::Identity();
  return match;
}

}  // namespace docent::mapping
