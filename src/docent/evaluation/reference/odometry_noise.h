#pragma once

#include <span>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::evaluation {

/// How odometry of our making errs. All deviations are of normal distributions. Errors are in proportion to what was
/// commanded, as in [Rhino1999] Fig. 6, and not as the robot's own OdometryModelParams has them.
struct OdometryNoiseParams {
  double way_share = 0.10;       ///< >= 0: deviation of a way, of itself
  double turn_share = 0.10;      ///< >= 0: deviation of a turn, of itself
  double turn_per_metre = 0.03;  ///< [rad/m], >= 0: deviation of the heading by a way
  double scale = 0.02;           ///< >= 0: deviation of the scale of all ways of a run: tyres
  double veer = 0.01;            ///< [rad/m], >= 0: deviation of a turn that comes with all ways of a run
  template <class V>
  void visit(V& v) {
    v("way_share", way_share);
    v("turn_share", turn_share);
    v("turn_per_metre", turn_per_metre);
    v("scale", scale);
    v("veer", veer);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Odometry that a robot with such wheels would have read on the way through `map_from_base`: each increment is turned
/// by half of its heading's error, stretched, and turned by the other half. Begins at the first pose. O(poses).
[[nodiscard]] std::vector<Pose2> noisy_odometry(std::span<const Pose2> map_from_base, const OdometryNoiseParams& params,
                                                Rng rng);

}  // namespace docent::evaluation
