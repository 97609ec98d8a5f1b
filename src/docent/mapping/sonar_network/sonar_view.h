#pragma once

#include <array>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::mapping {

/// Where the sonars of a ring are, evenly round the robot, the first at the front, counter-clockwise.
struct SonarRingGeometry {
  int count = 24;
  double radius = 0.25;         ///< [m] from the robot's centre
  double max_range = 5.0;       ///< [m]; this or more: no echo
  double field_of_view = 0.26;  ///< [rad], the nominal cone
  [[nodiscard]] Angle bearing(int sonar) const;
};

/// One reading of every sonar.
struct SonarView {
  std::vector<double> ranges;  ///< [count], [m] from each sonar
};

/// A place near the robot as the network sees it ([Rhino1999] 3.2.2, Fig. 10a): its polar coordinates and the four
/// readings that are geometrically closest. Mirrored so that the second closest sonar lies to the left of the closest:
/// a ring is the same on both sides.
struct SonarCell {
  double range = 0.0;                ///< [m] from the ring, along the bearing
  double off_axis = 0.0;             ///< 0..1: from the closest sonar's axis to half-way between two
  std::array<double, 4> readings{};  ///< [m]: closest, left of it, right of it, second to the left; at most max_range
};

/// `place`: [m], base frame. @pre a reading of every sonar
[[nodiscard]] SonarCell sonar_cell(const SonarRingGeometry& ring, const SonarView& view, Point2 place);

}  // namespace docent::mapping
