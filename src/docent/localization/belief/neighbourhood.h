#pragma once

#include <algorithm>
#include <cmath>

#include "docent/geometry/pose2.h"

namespace docent::localization {

/// The poses near one: positions within a circle, headings within an angle.
struct Neighbourhood {
  Pose2 about;
  double radius = 0.0;  ///< [m]
  double turn = 0.0;    ///< [rad]

  [[nodiscard]] bool holds(Angle heading) const { return std::abs((heading - about.theta).radians()) <= turn; }
  [[nodiscard]] bool holds(Point2 position) const { return distance(position, about.position()) <= radius; }
};

/// Two poses within it are the same place to whoever asks the way.
[[nodiscard]] inline Neighbourhood same_place(const Pose2& about) {
  constexpr double kRadius = 0.4;  // [m] below the half metre from which on a robot counts as lost
  constexpr double kTurn = 0.26;   // [rad] 15 degrees, as the mode of a belief
  return {about, kRadius, kTurn};
}

/// How much of a neighbourhood's mass goes to the part of it where a search has found the robot.
struct Gathering {
  Neighbourhood all;
  Neighbourhood found;   ///< inside `all`
  double share = 0.0;    ///< 0..1 of the neighbourhood's mass that is to be in `found`
  double most_nats = 3;  ///< [nat] that the rest of it loses at most: one search that errs shall not move the robot

  /// Factors for what is in `found` and for the rest; their sum stays. Both 1 where `found` has its share already.
  struct Factors {
    double found = 1.0;
    double rest = 1.0;
  };
  [[nodiscard]] Factors factors(double found_mass, double rest_mass) const {
    const double all_mass = found_mass + rest_mass;
    if (!(found_mass > 0.0 && rest_mass > 0.0) || share * all_mass <= found_mass) return {};
    const double rest = std::max((1.0 - share) * all_mass / rest_mass, std::exp(-most_nats));
    return {(all_mass - rest * rest_mass) / found_mass, rest};
  }
};

}  // namespace docent::localization
