#pragma once

#include <Eigen/Core>
#include <vector>

#include "docent/mapping/pose_graph/pose_graph.h"

namespace docent::mapping {

/// How well each pose is known as one given pose sees it: covariance of (x, y, theta) in the frame of that one, along
/// the best known chain of constraints (E. Olson, Robust and efficient robotic mapping, MIT 2008: Dijkstra projection).
/// No better than that, but never far too sure. Loops in `graph` count. O(constraints log poses).
[[nodiscard]] std::vector<Eigen::Matrix3d> covariances_seen_from(const PoseGraph& graph, std::size_t pose);

}  // namespace docent::mapping
