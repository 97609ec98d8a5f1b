#include "docent/mapping/pose_graph/pose_graph.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace docent::mapping {
namespace {

/// sqrt(information) * (how the measured second pose sees the estimated one).
struct PoseDifference {
  Eigen::Matrix3d root;
  Pose2 measured;

  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    const T c = ceres::cos(a[2]);
    const T s = ceres::sin(a[2]);
    const T dx = b[0] - a[0];
    const T dy = b[1] - a[1];
    // The second pose as the first one sees it, less the measured one, turned into the measured one's frame.
    const T ex = c * dx + s * dy - T(measured.x);
    const T ey = -s * dx + c * dy - T(measured.y);
    const double mc = std::cos(measured.theta.radians());
    const double ms = std::sin(measured.theta.radians());
    const T turn = b[2] - a[2] - T(measured.theta.radians());
    Eigen::Matrix<T, 3, 1> error;
    error << T(mc) * ex + T(ms) * ey, T(-ms) * ex + T(mc) * ey, ceres::atan2(ceres::sin(turn), ceres::cos(turn));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} = root.template cast<T>() * error;
    return true;
  }
};

Eigen::Matrix3d root_of(const Eigen::Matrix3d& information) {
  const Eigen::LLT<Eigen::Matrix3d> factor{information};
  return factor.matrixU();
}

ceres::Solver::Options options_of(const PoseGraphParams& params) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // others call the BLAS that a machine has
  options.max_num_iterations = params.most_steps;
  options.function_tolerance = 1e-7;
  options.num_threads = 1;  // sums in one order: the same poses everywhere
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

Result<void> PoseGraphParams::validate() const {
  if (!(loop_scale > 0.0)) return fail("loop_scale must be > 0");
  if (!(loop_refused > 0.0)) return fail("loop_refused must be > 0");
  if (!(most_steps > 0)) return fail("most_steps must be > 0");
  return {};
}

std::size_t PoseGraph::add_pose(const Pose2& map_from_base) {
  poses_.push_back(map_from_base);
  return poses_.size() - 1;
}

void PoseGraph::add(const PoseConstraint& constraint) { constraints_.push_back(constraint); }

PoseGraph PoseGraph::with_odometry(double scale) const {
  PoseGraph rated = *this;
  for (PoseConstraint& constraint : rated.constraints_) {
    if (constraint.is_odometry) constraint.information /= scale * scale;
  }
  return rated;
}

void PoseGraph::optimise(const PoseGraphParams& params, double odometry_scale) {
  if (constraints_.empty()) return;
  std::vector<std::array<double, 3>> values;
  values.reserve(poses_.size());
  for (const Pose2& pose : poses_) values.push_back({pose.x, pose.y, pose.theta.radians()});
  ceres::Problem problem;
  for (const PoseConstraint& constraint : constraints_) {
    const double scale = constraint.is_odometry ? odometry_scale : 1.0;
    auto* cost = new ceres::AutoDiffCostFunction<PoseDifference, 3, 3, 3>(
        new PoseDifference{root_of(constraint.information) / scale, constraint.from_from_to});
    ceres::LossFunction* loss = constraint.is_loop ? new ceres::CauchyLoss(params.loop_scale) : nullptr;
    problem.AddResidualBlock(cost, loss, values[constraint.from].data(), values[constraint.to].data());
  }
  if (problem.HasParameterBlock(values.front().data())) problem.SetParameterBlockConstant(values.front().data());
  ceres::Solver::Summary summary;
  ceres::Solve(options_of(params), &problem, &summary);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    poses_[i] = {values[i][0], values[i][1], Angle::radians(values[i][2])};
  }
}

double PoseGraph::error_of(const PoseConstraint& constraint) const {
  const std::array<double, 3> a{poses_[constraint.from].x, poses_[constraint.from].y,
                                poses_[constraint.from].theta.radians()};
  const std::array<double, 3> b{poses_[constraint.to].x, poses_[constraint.to].y,
                                poses_[constraint.to].theta.radians()};
  std::array<double, 3> residual{};
  PoseDifference{root_of(constraint.information), constraint.from_from_to}(a.data(), b.data(), residual.data());
  return std::sqrt(residual[0] * residual[0] + residual[1] * residual[1] + residual[2] * residual[2]);
}

std::size_t PoseGraph::remove_wrong_loops(const PoseGraphParams& params) {
  return std::erase_if(constraints_, [&](const PoseConstraint& constraint) {
    return constraint.is_loop && error_of(constraint) > params.loop_refused;
  });
}

}  // namespace docent::mapping
