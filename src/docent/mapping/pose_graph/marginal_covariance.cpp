#include "docent/mapping/pose_graph/marginal_covariance.h"

#include <array>
#include <cmath>

#include "docent/mapping/pose_graph/turned_matrix.h"

namespace docent::mapping {
namespace {

constexpr double kLeastInformation = 1e-6;  // what no constraint reaches is known to a kilometre, not to infinity

/// How `to` as `from` sees it changes with the two poses (x, y, theta each).
Eigen::Matrix<double, 3, 6> jacobian_of(const Pose2& from, const Pose2& to) {
  const double c = std::cos(from.theta.radians());
  const double s = std::sin(from.theta.radians());
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  Eigen::Matrix<double, 3, 6> j;
  j << -c, -s, -s * dx + c * dy, c, s, 0,  //
      s, -c, -c * dx - s * dy, -s, c, 0,   //
      0, 0, -1, 0, 0, 1;
  return j;
}

}  // namespace

MarginalCovariances::MarginalCovariances(const PoseGraph& graph) : graph_{graph} {
  const auto size = static_cast<Eigen::Index>(3 * (graph.poses().size() - 1));  // the first one is where it is
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * graph.constraints().size() + static_cast<std::size_t>(size));
  for (Eigen::Index i = 0; i < size; ++i) entries.emplace_back(i, i, kLeastInformation);
  for (const PoseConstraint& constraint : graph.constraints()) {
    // The constraint's error is seen in the second pose's frame; the Jacobian speaks of the first one's.
    const Eigen::Matrix3d information = turned(constraint.information, constraint.from_from_to.theta);
    const auto j = jacobian_of(graph.poses()[constraint.from], graph.poses()[constraint.to]);
    const Eigen::Matrix<double, 6, 6> block = j.transpose() * information * j;
    const std::array<std::size_t, 2> ends{constraint.from, constraint.to};
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < 6; ++b) {
        const auto row = static_cast<Eigen::Index>(3 * ends[static_cast<std::size_t>(a / 3)]) + a % 3 - 3;
        const auto column = static_cast<Eigen::Index>(3 * ends[static_cast<std::size_t>(b / 3)]) + b % 3 - 3;
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, block(a, b));
      }
    }
  }
  Eigen::SparseMatrix<double> information{size, size};
  information.setFromTriplets(entries.begin(), entries.end());
  if (size > 0) factor_.compute(information);
}

Eigen::Matrix3d MarginalCovariances::between(std::size_t from, std::size_t to) const {
  const auto size = static_cast<Eigen::Index>(3 * (graph_.poses().size() - 1));
  const auto j = jacobian_of(graph_.poses()[from], graph_.poses()[to]);
  // covariance = J * inverse(information) * J^T: three solutions instead of six.
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(size, 3);
  for (int half = 0; half < 2; ++half) {
    const auto first = static_cast<Eigen::Index>(3 * (half == 0 ? from : to)) - 3;
    if (first >= 0) right.middleRows(first, 3) += j.middleCols(static_cast<Eigen::Index>(3) * half, 3).transpose();
  }
  if (size == 0) return Eigen::Matrix3d::Zero();
  const Eigen::MatrixXd solved = factor_.solve(right);
  return right.transpose() * solved;
}

}  // namespace docent::mapping
