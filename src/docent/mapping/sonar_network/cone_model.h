#pragma once

#include "docent/mapping/sonar_network/sonar_view.h"

namespace docent::mapping {

/// The inverse sensor model that is crafted by hand, which the network is measured against: what lies in a cone before
/// its echo is free, what lies at the echo may be occupied, the rest is not known ([Rhino1999] 3.2.2, "traditional
/// approaches").
struct ConeModelParams {
  double free = 0.25;      ///< P(occupied) before the echo,
  double echo = 0.65;      ///< at it,
  double unknown = 0.5;    ///< and beyond it, or where no cone looks
  double thickness = 0.1;  ///< [m] before and beyond the echo
};

/// P(occupied | one reading of each sonar): the odds of all cones that hold the place are multiplied. O(1).
[[nodiscard]] double probability_by_cones(const ConeModelParams& params, const SonarRingGeometry& ring,
                                          const SonarView& view, Point2 place);

}  // namespace docent::mapping
