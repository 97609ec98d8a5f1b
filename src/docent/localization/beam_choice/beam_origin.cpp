#include "docent/localization/beam_choice/beam_origin.h"

#include <cmath>

#include "docent/geometry/point_transform.h"

namespace docent::localization {
namespace {

constexpr double kUnknownAllowed = 0.3;  // [m] of unknown land before the wall
constexpr double kModeThatCounts = 0.01;

/// P(an authentic reading is longer than `range`) where the map lets expect `expected`: the tail of a Gaussian.
double tail(double expected, double range, double sigma) {
  return 0.5 * std::erfc((range - expected) / (sigma * std::sqrt(2.0)));
}

}  // namespace

Result<void> PersonFilterParams::validate() const {
  if (filter != "distance" && filter != "entropy" && filter != "none")
    return fail("people.filter must be distance, entropy or none, not '" + filter + "'");
  if (!(sureness > 0.5 && sureness < 1.0)) return fail("people.sureness must be 0.5..1");
  if (!(gamma > 0.0)) return fail("people.gamma must be > 0");
  if (!(sigma > 0.0 && sigma_per_metre >= 0.0)) return fail("people.sigma must be > 0, sigma_per_metre >= 0");
  if (!(near >= 0.0 && clear >= near)) return fail("people.near must be >= 0, people.clear >= near");
  return {};
}

std::optional<double> shorter_probability(const sensor_models::RayCaster& caster, std::span<const BeliefMode> modes,
                                          const sensor_models::SweepBeam& beam, double max_range,
                                          const PersonFilterParams& params) {
  double known = 0.0;
  double all = 0.0;
  double shorter = 0.0;
  for (const BeliefMode& mode : modes) {
    if (mode.mass < kModeThatCounts * modes.front().mass) break;
    all += mode.mass;
    const Point2 direction = unit(mode.map_from_robot.theta + Angle::radians(beam.bearing));
    const auto expected = caster.cast(mode.map_from_robot.position(), direction, max_range, kUnknownAllowed);
    if (!expected) continue;
    known += mode.mass;
    shorter += mode.mass * tail(*expected, beam.range, params.sigma + params.sigma_per_metre * *expected);
  }
  if (known <= 0.5 * all) return std::nullopt;
  return shorter / known;
}

std::vector<sensor_models::BeamOrigin> beam_origins(const sensor_models::RayCaster& caster,
                                                    std::span<const BeliefMode> modes,
                                                    const sensor_models::RangeSweep& sweep,
                                                    std::span<const float> entropy_gains, double max_range,
                                                    const PersonFilterParams& params) {
  std::vector<sensor_models::BeamOrigin> origins(sweep.beams.size(), sensor_models::BeamOrigin::unknown);
  if (modes.empty()) return origins;
  const PointTransform best{modes.front().map_from_robot};
  for (std::size_t i = 0; i < sweep.beams.size(); ++i) {
    const sensor_models::SweepBeam& beam = sweep.beams[i];
    if (beam.no_return) continue;
    if (params.filter == "none") {
      origins[i] = sensor_models::BeamOrigin::map;
      continue;
    }
    // What ends at a wall of the map is the wall, whatever lies before it: most rays need not be followed.
    const double clearance = static_cast<double>(caster.clearance(best * sensor_models::endpoint(beam)));
    if (clearance < params.near) {
      origins[i] = sensor_models::BeamOrigin::map;
      continue;
    }
    bool is_odd = false;
    if (params.filter == "entropy") {
      is_odd = i < entropy_gains.size() && static_cast<double>(entropy_gains[i]) > params.gamma;
    } else {
      const auto shorter = shorter_probability(caster, modes, beam, max_range, params);
      if (!shorter) continue;
      is_odd = *shorter > params.sureness;
    }
    origins[i] = !is_odd                    ? sensor_models::BeamOrigin::map
                 : clearance < params.clear ? sensor_models::BeamOrigin::maybe_map
                                            : sensor_models::BeamOrigin::not_map;
  }
  return origins;
}

}  // namespace docent::localization
