#include "docent/collision_avoidance/virtual_measurements/mount_doubt.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace docent::collision_avoidance {

void lower_by_doubt(std::span<double> ranges, const MountDoubt& doubt) {
  const auto count = static_cast<std::ptrdiff_t>(ranges.size());
  if (count == 0 || (doubt.heading <= 0.0 && doubt.position <= 0.0)) return;
  const double step = 2.0 * std::numbers::pi / static_cast<double>(count);
  const auto reach = std::min(count / 2, static_cast<std::ptrdiff_t>(std::ceil(doubt.heading / step)));
  const std::vector<double> before(ranges.begin(), ranges.end());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double least = before[static_cast<std::size_t>(i)];
    for (std::ptrdiff_t k = -reach; k <= reach; ++k)
      least = std::min(least, before[static_cast<std::size_t>((i + k + count) % count)]);
    ranges[static_cast<std::size_t>(i)] = std::max(std::max(0.0, least - doubt.position), std::min(least, doubt.keep));
  }
}

}  // namespace docent::collision_avoidance
