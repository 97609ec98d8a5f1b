#include "docent/localization/belief/localizer.h"

namespace docent {

std::vector<BeamOrigin> Localizer::origins(const RangeSweep& sweep, const Pose2& odom_now, double max_range,
                                           const PersonFilterParams& params) const {
  if (!verdict().localized()) return beam_origins(caster(), {}, sweep, {}, max_range, params);
  std::vector<BeliefMode> modes = summary().modes;
  const Pose2 before_from_now = inverse(odom_from_robot()) * odom_now;
  for (BeliefMode& mode : modes) mode.map_from_robot = mode.map_from_robot * before_from_now;
  std::vector<float> gains;
  if (params.filter == "entropy") gains = entropy_gains(sweep, odom_now);
  return beam_origins(caster(), modes, sweep, gains, max_range, params);
}

}  // namespace docent
