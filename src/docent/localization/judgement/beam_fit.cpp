#include "docent/localization/judgement/beam_fit.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace docent::localization {
namespace {

constexpr double kGross = 0.5;         // [m] off a wall: wholly wrong; half of it costs a quarter
constexpr double kHeadingError = 2.0;  // [deg]
constexpr double kAllowance = 0.5;     // [m] of a ray's way through what nobody knows
constexpr double kUnknown = 1.0;       // and of one of which the map does not say
constexpr double kNoReturn = 0.5;      // and of one that misses a wall; glass and dark surfaces do that
constexpr double kSurelyMet = 0.8;     // of the greatest range

/// [m] of the map's walls in the direction of a beam, whatever the heading's error.
struct Expected {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
};

std::optional<Expected> expected_range(const sensor_models::RayCaster& caster, const Pose2& pose, double bearing,
                                       double max_range) {
  Expected result;
  for (const double off : {-kHeadingError, 0.0, kHeadingError}) {
    const auto range = caster.cast(pose.position(), unit(pose.theta + Angle::radians(bearing) + Angle::degrees(off)),
                                   max_range, kAllowance);
    if (!range) return std::nullopt;
    result.least = std::min(result.least, *range);
    result.most = std::max(result.most, *range);
  }
  return result;
}

float wrong(double off) {
  const double scaled = std::clamp(off / kGross, 0.0, 1.0);
  return static_cast<float>(scaled * scaled);
}

}  // namespace

std::vector<PartCost> beam_costs(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep,
                                 const Pose2& map_from_robot, const BeamFitParams& params) {
  std::vector<PartCost> costs;
  costs.reserve(2 * sweep.beams.size());
  for (const sensor_models::SweepBeam& beam : sweep.beams) {
    const auto expected = expected_range(caster, map_from_robot, beam.bearing, params.max_range);
    const Point2 along = unit(map_from_robot.theta + Angle::radians(beam.bearing));
    const auto at = [&](double range) { return map_from_robot.position() + range * along; };
    if (beam.no_return) {
      if (expected && expected->most < kSurelyMet * std::min(params.max_range, beam.range))
        costs.push_back({part_at(at(expected->most), params.wall_part, true), static_cast<float>(kNoReturn)});
      continue;
    }
    const Point2 end = at(beam.range);
    if (!expected) {
      costs.push_back({part_at(end, params.part, false), static_cast<float>(kUnknown)});
      continue;
    }
    if (beam.range > expected->most) {
      costs.push_back({part_at(at(expected->most), params.wall_part, true), wrong(beam.range - expected->most)});
      continue;
    }
    costs.push_back({part_at(end, params.wall_part, true), 0.0F});
    const double off = std::min(expected->least - beam.range, static_cast<double>(caster.clearance(end)));
    costs.push_back({part_at(end, params.part, false), wrong(off)});
  }
  return costs;
}

}  // namespace docent::localization
