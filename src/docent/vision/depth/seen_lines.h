#pragma once

#include <span>
#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/vision/depth/depth_layer.h"

namespace docent::vision {

struct SeenLinesParams {
  double bearing = 1.5;    ///< [deg] > 0: of what lies in a sector of this width the nearest counts
  double gap = 0.18;       ///< [m] > 0: what is farther apart is not of one line
  double straight = 0.05;  ///< [m] > 0 that a place may lie off its line
  double reach = 4.0;      ///< [m] > 0 from the base
  double tilt = 0.3;       ///< [deg] >= 0 standard deviation of the camera's tilt
  int most = 60;           ///< >= 1 lines, the nearest first
  [[nodiscard]] Result<void> validate() const;
};

/// A line on the floor that is in the way ([Buhmann1995]: obstacles seen by a camera become a few lines).
struct SeenLine {
  Segment line;               ///< [m], base
  bool is_drop = false;       ///< the floor ends there
  double across_sigma = 0.0;  ///< [m] standard deviation of its place across it
  double along_sigma = 0.0;   ///< [m] of its ends along it
};

/// The outline of cells as seen from the base: of each sector the nearest, neighbours joined to lines, and these cut
/// where they bend. Drops have lines of their own. The deviations hold the cells' size, the camera's noise in depth and
/// what its shaking does at that distance: z² dpsi / h. The nearest lines first. O(cells + sectors²).
/// @param camera_height  [m]
[[nodiscard]] std::vector<SeenLine> lines_of(std::span<const LayerCell> cells, const Pose2& odom_from_base, double cell,
                                             double camera_height, const SeenLinesParams& params = {});

}  // namespace docent::vision
