#pragma once

#include <algorithm>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/markov/row_kernel.h"
#include "docent/motion_models/odometry_model.h"

namespace docent::localization {

/// P(l | l', a) of [Markov1998] eq. 2 on the grid: every heading's cells are moved and blurred in x, then in y, then
/// headings are blurred. Where to a heading moves is a matter of its direction, so each offset in x, and each in y, has
/// one weight a heading. Their product is what x and y together do: two passes of a few offsets instead of one of many.
struct MotionKernel {
  AxisTaps columns;      ///< along x
  AxisTaps rows;         ///< along y
  HeadingBlur headings;  ///< of turns

  [[nodiscard]] int reach() const { return std::max(columns.reach, rows.reach); }  ///< [cells]
  /// Of turns by -reach … reach headings: those of `headings`, each on its own.
  [[nodiscard]] std::vector<float> heading_weights() const;
  /// Of the offset (columns, rows) from the source cell to the target cell.
  [[nodiscard]] float weight(int column_offset, int row_offset, int heading) const;
};

/// What odometry saw since the last kernel.
struct OdometryStep {
  motion_models::MotionNoise noise;
  double way = 0.0;   ///< [m]
  double turn = 0.0;  ///< [rad], >= 0
};

/// The kernel that moves states by `shift` [m], given in a frame that has the state's heading. Positions are shared out
/// bilinearly; that blurs by itself, so the odometry's variance is topped up only where it is larger. A small part of
/// the mass gets slow tails: wheels slip, and people push.
[[nodiscard]] MotionKernel motion_kernel(const StateSpace& space, const motion_models::OdometryModelParams& params,
                                         Point2 shift, const OdometryStep& step);

}  // namespace docent::localization
