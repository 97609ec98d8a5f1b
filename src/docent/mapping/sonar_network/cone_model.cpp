#include "docent/mapping/sonar_network/cone_model.h"

#include <algorithm>
#include <cmath>

namespace docent::mapping {

double probability_by_cones(const ConeModelParams& params, const SonarRingGeometry& ring, const SonarView& view,
                            Point2 place) {
  double log_odds = std::log(params.unknown / (1.0 - params.unknown));
  const auto add = [&](double p) { log_odds += std::log(p / (1.0 - p)); };
  for (int sonar = 0; sonar < ring.count; ++sonar) {
    const Point2 at = ring.radius * unit(ring.bearing(sonar));
    const Point2 seen = place - at;
    const double off = (direction({}, seen) - ring.bearing(sonar)).radians();
    if (std::abs(off) > 0.5 * ring.field_of_view) continue;
    const double echo = view.ranges[static_cast<std::size_t>(sonar)];
    const double range = norm(seen);
    if (range < std::min(echo, ring.max_range) - params.thickness) {
      add(params.free);
    } else if (echo < ring.max_range && range <= echo + params.thickness) {
      add(params.echo);
    }
  }
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace docent::mapping
