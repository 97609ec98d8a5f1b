#include "docent/localization/judgement/glance.h"

#include <algorithm>
#include <numeric>

#include "docent/localization/beam_choice/straight_walls.h"

namespace docent::localization {
namespace {

constexpr std::size_t kBeamsOfGlance = 40;  // of a sweep, and of its walls, that are looked at
constexpr double kOff = 0.5;                // [m] from the wall: noise of the map and of the heading
constexpr double kUnknownAllowance = 0.5;   // [m] of a ray's way

/// Every so many of `all`, for at most kBeamsOfGlance.
std::size_t stride_of(std::size_t all) { return std::max<std::size_t>(1, (all + kBeamsOfGlance - 1) / kBeamsOfGlance); }

double unmapped_share(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep,
                      const Pose2& map_from_robot) {
  constexpr int kPrior = 5;  // looks at mapped walls: a single short piece of wall tells little
  const auto is_wall = on_straight_walls(sweep);
  const std::size_t walls = std::accumulate(is_wall.begin(), is_wall.end(), std::size_t{0});
  const std::size_t stride = stride_of(walls);
  std::size_t wall = 0;
  int looks = 0, unmapped = 0;
  for (std::size_t i = 0; i < sweep.beams.size(); ++i) {
    if (is_wall[i] == 0 || wall++ % stride != 0) continue;
    const sensor_models::SweepBeam& beam = sweep.beams[i];
    const Point2 direction = unit(map_from_robot.theta + Angle::radians(beam.bearing));
    const auto expected = caster.cast(map_from_robot.position(), direction, beam.range + 2.0 * kOff, kUnknownAllowance);
    if (!expected) continue;
    ++looks;
    unmapped += *expected > beam.range + kOff ? 1 : 0;
  }
  return static_cast<double>(unmapped) / (looks + kPrior);
}

}  // namespace

Glance glance(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep,
              const Pose2& map_from_robot, double max_range) {
  constexpr double kWithinReach = 0.8;
  int through = 0;
  Glance result;
  int shorter = 0;
  const std::size_t stride = stride_of(sweep.beams.size());
  for (std::size_t i = 0; i < sweep.beams.size(); i += stride) {
    const sensor_models::SweepBeam& beam = sweep.beams[i];
    const Point2 direction = unit(map_from_robot.theta + Angle::radians(beam.bearing));
    const auto expected = caster.cast(map_from_robot.position(), direction, max_range, kUnknownAllowance);
    if (!expected) continue;
    if (beam.no_return) {  // far away, or a dark or mirroring surface: only walls well within reach are missed
      if (*expected > kWithinReach * std::min(max_range, beam.range)) continue;
      ++through;
    } else {
      through += beam.range > *expected + kOff ? 1 : 0;
      shorter += beam.range < *expected - kOff ? 1 : 0;
    }
    ++result.readings;
  }
  result.unmapped = unmapped_share(caster, sweep, map_from_robot);
  const int not_short = result.readings - shorter;
  if (not_short >= Glance::kFewest) result.through = static_cast<double>(through) / not_short;
  if (result.tells()) result.shorter = static_cast<double>(shorter) / result.readings;
  return result;
}

}  // namespace docent::localization
