#pragma once

#include "docent/geometry/pose2.h"

namespace docent::simulator {

/// A round thing in a plane, as a sensor or the robot's body meets it.
struct Disc {
  Point2 centre;  ///< [m], world
  double radius = 0.25;
};

}  // namespace docent::simulator
