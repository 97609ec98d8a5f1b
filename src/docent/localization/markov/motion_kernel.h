#pragma once

#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/localization/markov/state_space.h"
#include "docent/motion_models/odometry_model.h"

namespace docent {

/// P(l | l', a) of [Markov1998] eq. 2 on the grid: first every heading's cells are moved and blurred in x and y, then
/// headings are turned and blurred. Where to a heading moves is a matter of its direction, so each offset in x and y
/// has one weight a heading.
struct MotionKernel {
  struct Offset {
    int columns = 0;  ///< from the source cell to the target cell
    int rows = 0;
    std::vector<float> weights;       ///< [headings]; 0 where this heading does not go there
    std::size_t first = 0, last = 0;  ///< weights outside [first, last) are 0
  };
  std::vector<Offset> offsets;
  int turn = 0;                        ///< [heading steps], whole
  std::vector<float> heading_weights;  ///< symmetric, odd length
  int reach = 0;                       ///< [cells]
};

/// The kernel of one odometry increment. `heading_offset` [rad] is added to every state's heading before, and holds
/// what is left of the turn after whole steps afterwards: turning by less than a step then blurs nothing, since beams
/// can be turned instead. Positions are shared out bilinearly; that blurs by itself, so the odometry's variance is
/// topped up only where it is larger.
[[nodiscard]] MotionKernel motion_kernel(const StateSpace& space, const OdometryModelParams& params,
                                         const Pose2& before_from_after, double& heading_offset);

}  // namespace docent
