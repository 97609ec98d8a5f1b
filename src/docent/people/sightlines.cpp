#include "docent/people/sightlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent {

Sightlines::Sightlines(const RangeSweep& sweep, const Pose2& odom_from_base)
    : base_from_odom_{inverse(odom_from_base)}, beams_{sweep.beams} {
  std::stable_sort(beams_.begin(), beams_.end(),
                   [](const SweepBeam& a, const SweepBeam& b) { return a.bearing < b.bearing; });
}

Look Sightlines::look(Point2 in_odom, double radius) const {
  constexpr double kMiddle = 0.7;   // of the radius: beams at the rim may pass
  constexpr double kBehind = 0.35;  // [m]
  const Point2 place = base_from_odom_ * in_odom;
  const double away = norm(place);
  if (away <= radius || beams_.empty()) return Look::unclear;
  const double middle = std::atan2(place.y, place.x);
  const double half = std::asin(std::min(1.0, kMiddle * radius / away));
  int passing = 0;
  int before = 0;
  int all = 0;
  for (const double turn : {-2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi}) {
    auto beam = std::lower_bound(beams_.begin(), beams_.end(), middle + turn - half,
                                 [](const SweepBeam& b, double bearing) { return b.bearing < bearing; });
    for (; beam != beams_.end() && beam->bearing <= middle + turn + half; ++beam) {
      ++all;
      passing += beam->no_return || beam->range > away + kBehind ? 1 : 0;
      before += !beam->no_return && beam->range < away - radius - 0.15 ? 1 : 0;
    }
  }
  if (2 * passing > all) return Look::free;
  if (2 * before > all) return Look::hidden;
  return Look::unclear;
}

}  // namespace docent
