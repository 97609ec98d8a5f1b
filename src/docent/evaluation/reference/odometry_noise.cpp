#include "docent/evaluation/reference/odometry_noise.h"

#include <cmath>

namespace docent::evaluation {

Result<void> OdometryNoiseParams::validate() const {
  for (const double value : {way_share, turn_share, turn_per_metre, scale, veer})
    if (!(value >= 0.0 && value < 1.0)) return fail("odometry noise must be 0..1");
  return {};
}

std::vector<Pose2> noisy_odometry(std::span<const Pose2> map_from_base, const OdometryNoiseParams& params, Rng rng) {
  std::vector<Pose2> odom_from_base;
  odom_from_base.reserve(map_from_base.size());
  const double scale = 1.0 + params.scale * rng.normal();
  const double veer = params.veer * rng.normal();
  for (std::size_t i = 0; i < map_from_base.size(); ++i) {
    if (i == 0) {
      odom_from_base.push_back(map_from_base[0]);
      continue;
    }
    const Pose2 step = inverse(map_from_base[i - 1]) * map_from_base[i];
    const double way = norm(step.position());
    const double turn = step.theta.radians();
    const double stretch = scale * (1.0 + params.way_share * rng.normal());
    const double turned = params.turn_share * turn * rng.normal() + (veer + params.turn_per_metre * rng.normal()) * way;
    const Pose2 half{0.0, 0.0, Angle::radians(0.5 * turned)};
    odom_from_base.push_back(odom_from_base.back() * half * Pose2{stretch * step.x, stretch * step.y, step.theta} *
                             half);
  }
  return odom_from_base;
}

}  // namespace docent::evaluation
