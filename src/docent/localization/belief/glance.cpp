#include "docent/localization/belief/glance.h"

#include <algorithm>

namespace docent {

Glance glance(const RayCaster& caster, const RangeSweep& sweep, const Pose2& map_from_robot, double max_range) {
  constexpr std::size_t kBeams = 40;
  constexpr double kOff = 0.5;  // [m] from the wall: noise of the map and of the heading
  constexpr double kWithinReach = 0.8;
  int through = 0;
  Glance result;
  int shorter = 0;
  const std::size_t stride = std::max<std::size_t>(1, sweep.beams.size() / kBeams);
  for (std::size_t i = 0; i < sweep.beams.size(); i += stride) {
    const SweepBeam& beam = sweep.beams[i];
    const Point2 direction = unit(map_from_robot.theta + Angle::radians(beam.bearing));
    const auto expected = caster.cast(map_from_robot.position(), direction, max_range, kOff);
    if (!expected) continue;
    if (beam.no_return) {  // far away, or a dark or mirroring surface: only walls well within reach are missed
      if (*expected > kWithinReach * max_range) continue;
      ++through;
    } else {
      through += beam.range > *expected + kOff ? 1 : 0;
      shorter += beam.range < *expected - kOff ? 1 : 0;
    }
    ++result.readings;
  }
  const int not_short = result.readings - shorter;
  constexpr int kFewest = 10;  // fewer tell nothing
  if (not_short >= kFewest) result.through = static_cast<double>(through) / not_short;
  if (result.readings >= kFewest) result.shorter = static_cast<double>(shorter) / result.readings;
  return result;
}

}  // namespace docent
