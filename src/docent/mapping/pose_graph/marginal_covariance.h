#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "docent/mapping/pose_graph/pose_graph.h"

namespace docent::mapping {

/// How well poses are known of each other by all constraints together: blocks of the inverse of the information matrix
/// at the poses as they are. Surer than `covariances_seen_from`, which knows one chain; too sure where constraints err
/// together.
class MarginalCovariances {
 public:
  /// O(constraints), nearly. @pre the graph has a pose; it outlives this
  explicit MarginalCovariances(const PoseGraph& graph);

  /// Covariance of the second pose's (x, y, theta) in the frame of the first one. O(poses), nearly.
  [[nodiscard]] Eigen::Matrix3d between(std::size_t from, std::size_t to) const;

 private:
  const PoseGraph& graph_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace docent::mapping
