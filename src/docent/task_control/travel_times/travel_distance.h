#pragma once

#include <functional>

#include "docent/geometry/pose2.h"

namespace docent::task_control {

/// Length [m] of the way between two points of the map; +infinity where there is none.
using TravelDistance = std::function<double(Point2 from, Point2 to)>;

/// As the crow flies.
[[nodiscard]] inline TravelDistance straight_distance() {
  return [](Point2 from, Point2 to) { return distance(from, to); };
}

}  // namespace docent::task_control
