#pragma once

#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/localization/markov/state_space.h"
#include "docent/motion_models/odometry_model.h"

namespace docent {

/// P(l | l', a) of [Markov1998] eq. 2 on the grid: every heading's cells are moved and blurred in x and y, then
/// headings are blurred. Where to a heading moves is a matter of its direction, so each offset in x and y has one
/// weight a heading.
struct MotionKernel {
  struct Offset {
    int columns = 0;  ///< from the source cell to the target cell
    int rows = 0;
    std::vector<float> weights;       ///< [headings]; 0 where this heading does not go there
    std::size_t first = 0, last = 0;  ///< weights outside [first, last) are 0
  };
  std::vector<Offset> offsets;
  std::vector<float> heading_weights;  ///< symmetric, odd length
  int reach = 0;                       ///< [cells]
};

/// What odometry saw since the last kernel.
struct OdometryStep {
  MotionNoise noise;
  double way = 0.0;   ///< [m]
  double turn = 0.0;  ///< [rad], >= 0
};

/// The kernel that moves states by `shift` [m], given in a frame that has the state's heading. Positions are shared out
/// bilinearly; that blurs by itself, so the odometry's variance is topped up only where it is larger. A small part of
/// the mass gets slow tails: wheels slip, and people push.
[[nodiscard]] MotionKernel motion_kernel(const StateSpace& space, const OdometryModelParams& params, Point2 shift,
                                         const OdometryStep& step);

}  // namespace docent
