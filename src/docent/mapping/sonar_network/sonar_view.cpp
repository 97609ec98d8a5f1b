#include "docent/mapping/sonar_network/sonar_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::mapping {

Angle SonarRingGeometry::bearing(int sonar) const { return Angle::radians(2.0 * std::numbers::pi * sonar / count); }

SonarCell sonar_cell(const SonarRingGeometry& ring, const SonarView& view, Point2 place) {
  const double step = 2.0 * std::numbers::pi / ring.count;
  const double bearing = std::atan2(place.y, place.x);
  const int closest = static_cast<int>(std::lround(bearing / step));
  const double off = bearing / step - closest;  // -0.5..0.5
  const int left = off < 0.0 ? -1 : 1;
  const auto reading = [&](int away) {
    const int sonar = ((closest + away) % ring.count + ring.count) % ring.count;
    return std::min(view.ranges[static_cast<std::size_t>(sonar)], ring.max_range);
  };
  return {
      norm(place) - ring.radius, 2.0 * std::abs(off), {reading(0), reading(left), reading(-left), reading(2 * left)}};
}

}  // namespace docent::mapping
