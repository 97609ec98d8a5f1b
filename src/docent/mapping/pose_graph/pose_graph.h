#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::mapping {

/// What one match, or odometry, says of two poses.
struct PoseConstraint {
  std::size_t from = 0;  ///< index of a pose
  std::size_t to = 0;
  Pose2 from_from_to;           ///< the second pose as the first one sees it
  Eigen::Matrix3d information;  ///< inverse covariance of its error in (x, y, theta), seen in the second pose's frame
  bool is_loop = false;         ///< joins parts of the way between which much time passed: may be wrong
  bool is_odometry = false;     ///< nothing but odometry says so
};

/// How all poses are found together.
struct PoseGraphParams {
  double loop_scale = 3.0;    ///< sigmas, > 0: beyond it a loop counts less and less (Cauchy)
  double loop_refused = 6.0;  ///< sigmas, > 0: loops that after optimisation miss by more are wrong
  int most_steps = 40;        ///< > 0
  template <class V>
  void visit(V& v) {
    v("loop_scale", loop_scale);
    v("loop_refused", loop_refused);
    v("most_steps", most_steps);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Poses and what is known of their differences; the poses of least squared error (F. Lu and E. Milios, Globally
/// consistent range scan alignment, Autonomous Robots 4, 1997), by Levenberg-Marquardt over a sparse factorisation
/// (Ceres).
class PoseGraph {
 public:
  [[nodiscard]] const std::vector<Pose2>& poses() const { return poses_; }  ///< map_from_base
  [[nodiscard]] const std::vector<PoseConstraint>& constraints() const { return constraints_; }

  /// @returns its index
  std::size_t add_pose(const Pose2& map_from_base);
  /// @pre both poses exist
  void add(const PoseConstraint& constraint);
  /// The same poses and constraints, with the sigmas of what only odometry says times `scale`. @pre scale > 0
  [[nodiscard]] PoseGraph with_odometry(double scale) const;
  void set_poses(std::vector<Pose2> poses) { poses_ = std::move(poses); }
  void clear_constraints() { constraints_.clear(); }

  /// Moves all poses but the first. Where no constraint reaches, poses stay. O(constraints * steps), nearly.
  /// @param odometry_scale > 0: the sigmas of what only odometry says are this share of those in its information
  void optimise(const PoseGraphParams& params, double odometry_scale = 1.0);
  /// By how many sigmas the poses miss the constraint. O(1).
  [[nodiscard]] double error_of(const PoseConstraint& constraint) const;
  /// Takes away the loops that miss by more than params.loop_refused sigmas. @returns how many
  std::size_t remove_wrong_loops(const PoseGraphParams& params);

 private:
  std::vector<Pose2> poses_;
  std::vector<PoseConstraint> constraints_;
};

}  // namespace docent::mapping
