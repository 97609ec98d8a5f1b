#pragma once

#include <vector>

#include "docent/base/result.h"
#include "docent/vision/depth/depth_camera.h"
#include "docent/vision/scene/floor_colours.h"

namespace docent::vision {

struct FloorMaskParams {
  double blur = 2.0;         ///< [sites] > 0 over which neighbours are asked
  double least_odds = 0.75;  ///< log-odds from which on a site is floor
  double reach = 6.0;        ///< [m] > 0 along the axis: no floor is looked for farther off, nor above the horizon
  int least_sites = 60;      ///< >= 1 of a part of the floor
  double shaded = 0.5;       ///< 0..1 of a part's columns in which nearer floor ends below it: then it is what stands
                             ///< there, or lies on it
  [[nodiscard]] Result<void> validate() const;
};

/// Which sites of a picture show the floor.
struct FloorMask {
  int columns = 0;
  int rows = 0;
  int block = 1;                          ///< [pixels] side of a site
  std::vector<unsigned char> is_floor{};  ///< [rows * columns] 1: floor
  std::vector<float> odds{};              ///< [rows * columns] of floor, by the looks of a site and its neighbours;
                                          ///< empty: nothing is known of them

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// Where floor may be at all: below the horizon, and nearer than `reach` [m] along the axis. Only there its colours
/// need to be told from others, so only there they are learned. [rows * columns], 1: it may. O(sites)
[[nodiscard]] std::vector<unsigned char> below_horizon(const Sites& sites, const DepthCamera& camera, double reach);

/// The floor in a colour picture ([Buhmann1995], third stage): parts that look like it, below the horizon, and such
/// that in most of their columns no nearer floor ends below them: what begins above the end of a floor stands on it.
/// The largest part first. O(sites * blur).
/// @param camera  without distortion, of the picture before its subsampling
/// @pre colours are finished
[[nodiscard]] FloorMask find_floor(const RoughSites& seen, const FloorColours& colours, const DepthCamera& camera,
                                   const FloorMaskParams& params = {});

}  // namespace docent::vision
