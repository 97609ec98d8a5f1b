#include "docent/mapping/pose_graph/relative_covariance.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <queue>

#include "docent/mapping/pose_graph/turned_matrix.h"

namespace docent::mapping {
namespace {

struct Step {
  std::size_t to = 0;
  Pose2 from_from_to;
  Eigen::Matrix3d covariance;  ///< seen in the second pose's frame
};

std::vector<std::vector<Step>> steps_of(const PoseGraph& graph) {
  std::vector<std::vector<Step>> steps(graph.poses().size());
  for (const PoseConstraint& constraint : graph.constraints()) {
    const Eigen::Matrix3d seen_by_second = constraint.information.inverse();
    // The other way the error is seen in the first pose's frame; its lever arm is short, and left out.
    const Eigen::Matrix3d seen_by_first = turned(seen_by_second, constraint.from_from_to.theta);
    steps[constraint.from].push_back({constraint.to, constraint.from_from_to, seen_by_second});
    steps[constraint.to].push_back({constraint.from, inverse(constraint.from_from_to), seen_by_first});
  }
  return steps;
}

/// Of a pose reached over `way`, after one more step: the heading's error so far turns the step.
Eigen::Matrix3d extended(const Eigen::Matrix3d& covariance, const Pose2& way, const Step& step) {
  const double c = std::cos(way.theta.radians());
  const double s = std::sin(way.theta.radians());
  Eigen::Matrix3d by_so_far = Eigen::Matrix3d::Identity();
  by_so_far(0, 2) = -s * step.from_from_to.x - c * step.from_from_to.y;
  by_so_far(1, 2) = c * step.from_from_to.x - s * step.from_from_to.y;
  return by_so_far * covariance * by_so_far.transpose() + turned(step.covariance, way.theta + step.from_from_to.theta);
}

struct Reached {
  double trace = 0.0;
  std::size_t pose = 0;
  friend bool operator<(const Reached& a, const Reached& b) {
    return a.trace != b.trace ? a.trace > b.trace : a.pose > b.pose;
  }
};

}  // namespace

std::vector<Eigen::Matrix3d> covariances_seen_from(const PoseGraph& graph, std::size_t pose) {
  const std::vector<std::vector<Step>> steps = steps_of(graph);
  constexpr double kUnknown = 1e6;
  std::vector<Eigen::Matrix3d> covariances(steps.size(), kUnknown * Eigen::Matrix3d::Identity());
  std::vector<Pose2> ways(steps.size());
  std::vector<double> traces(steps.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> is_settled(steps.size(), false);
  std::priority_queue<Reached> open;
  covariances[pose] = Eigen::Matrix3d::Zero();
  traces[pose] = 0.0;
  open.push({0.0, pose});
  while (!open.empty()) {
    const std::size_t at = open.top().pose;
    open.pop();
    if (is_settled[at]) continue;
    is_settled[at] = true;
    for (const Step& step : steps[at]) {
      if (is_settled[step.to]) continue;
      const Eigen::Matrix3d covariance = extended(covariances[at], ways[at], step);
      const double trace = covariance.trace();
      if (trace >= traces[step.to]) continue;
      traces[step.to] = trace;
      covariances[step.to] = covariance;
      ways[step.to] = ways[at] * step.from_from_to;
      open.push({trace, step.to});
    }
  }
  return covariances;
}

}  // namespace docent::mapping
