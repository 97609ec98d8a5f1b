#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "docent/localization/judgement/tracks.h"
#include "docent/motion_models/odometry_model.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// One sweep of a way that is over.
struct PastSweep {
  sensor_models::RangeSweep sweep;
  Pose2 odom_from_robot;
  std::optional<Pose2> best;  ///< of the belief then
  bool is_sure = false;       ///< it had found that place, see Verdict::has_found
};

/// What looks back needs of a localizer.
struct HindsightParams {
  TracksParams tracks;
  motion_models::OdometryModelParams motion;
  double max_range = 10.0;              ///< [m]
  double strange = 0.6;                 ///< of a view's readings that the map does not explain, and
  std::size_t most_strange_views = 12;  ///< on end, more than a moved wall makes: no way of this robot
  std::size_t carried_within = 80;      ///< views in which the moment is sought when somebody carried it
  int smoothings = 3;                   ///< rounds; more change centimetres
  double much_stranger = 0.01;          ///< of the readings: a smoothed pose that loses so many has met people
};

/// Where the robot was at each sweep, now that the way is over: back from the last place that it was sure of, by
/// odometry and by matching the sweeps to the map, at the belief's best pose where that is near, [sweeps]. nullopt: it
/// was never sure of a later place, or the map explains the sweeps no more.
///
/// Where it had said another place, the two ways are held against each other: that which explains what was seen there
/// wins, and the later place that much the easier as robots are hardly ever carried (`TracksParams::carried_off`).
/// Where the earlier place wins, the robot was carried in between, at the moment that leaves least unexplained.
/// O(sweeps * beams).
[[nodiscard]] std::vector<std::optional<Pose2>> seen_in_hindsight(const sensor_models::RayCaster& caster,
                                                                  std::span<const PastSweep> sweeps,
                                                                  const HindsightParams& params);

}  // namespace docent::localization
