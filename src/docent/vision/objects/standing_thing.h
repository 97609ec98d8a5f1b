#pragma once

#include <cstddef>
#include <vector>

#include "docent/vision/regions/region_merging.h"

namespace docent::vision {

struct GroundParams {
  double least_luminance = 90.0;   ///< 0..255: a floor or a sheet is no darker,
  double most_coloured = 45.0;     ///< 0..255: nor more coloured; wood and cardboard are
  double most_uneven = 900.0;      ///< [square of grey levels] of a region: what is printed on is no floor
  double least_of_border = 0.04;   ///< of the picture's border, for a region to be part of the ground
  double least_of_picture = 0.01;  ///< of its sites: what stands out by less is dust
};

/// The sites of a picture that show a thing, and those of the ground around it.
struct StandingThing {
  std::vector<bool> is_thing;  ///< [sites]
  std::size_t sites = 0;       ///< of the thing
  Site ground;                 ///< mean of the ground; all 0 where none is seen
  std::size_t ground_sites = 0;
};

/// Parts a thing that was photographed for itself from the ground it lies on: pale even regions that reach along the
/// picture's border are ground, all else is the thing; where nothing is ground, the thing fills the picture. O(sites).
[[nodiscard]] StandingThing part_from_ground(const Sites& sites, const Segmentation& regions,
                                             const GroundParams& params = {});

}  // namespace docent::vision
