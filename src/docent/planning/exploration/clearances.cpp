#include "docent/planning/exploration/clearances.h"

#include <algorithm>
#include <cmath>

namespace docent::planning {

void Clearances::add(const Pose2& base_from_sensor, double first_bearing, double bearing_step, double max_range,
                     std::span<const float> ranges) {
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double range = std::min(static_cast<double>(ranges[i]), max_range);
    if (!(ranges[i] >= 0.0F)) continue;
    const Angle bearing = Angle::radians(first_bearing + static_cast<double>(i) * bearing_step);
    const Point2 point = base_from_sensor * (range * unit(bearing));
    const double place = 0.5 * (direction({}, point).degrees() + 180.0);
    for (const double side : {-0.25, 0.25}) {
      double& least = least_[static_cast<std::size_t>(std::lround(place + side)) % kDirections];
      least = least == kUnread ? norm(point) : std::min(least, norm(point));
    }
  }
}

void Clearances::fill(const Clearances& older) {
  for (std::size_t i = 0; i < kDirections; ++i)
    if (least_[i] == kUnread) least_[i] = older.least_[i];
}

std::vector<double> Clearances::free() const {
  std::vector<double> result;
  for (const double least : least_) result.push_back(std::max(0.0, least));
  return result;
}

}  // namespace docent::planning
