#include "docent/collision_avoidance/avoider/virtual_obstacles.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {

void VirtualObstacles::take(VirtualSweep sweep, const Pose2& odom_from_base) {
  stamp_ = sweep.stamp;
  sweep_ = std::move(sweep);
  odom_from_sweep_ = odom_from_base;
  places_.resize(sweep_.ranges.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double range = sweep_.ranges[i];
    if (!(range < sweep_.max_range)) continue;
    const double bearing = sweep_.first_bearing + static_cast<double>(i) * sweep_.bearing_step;
    places_[i] = std::max(range, params_.least_range) * unit(Angle::radians(bearing));
  }
}

void VirtualObstacles::add_to(std::vector<Obstacle>& obstacles, const Pose2& base_from_odom, double reach) const {
  if (!stamp_) return;
  const PointTransform base_from_sweep{base_from_odom * odom_from_sweep_};
  const double turn = (2.0 * std::numbers::pi - 0.5 * sweep_.bearing_step) / sweep_.bearing_step;
  for (std::size_t i = 0; i < sweep_.ranges.size(); ++i) {
    if (!(static_cast<double>(sweep_.ranges[i]) < sweep_.max_range)) continue;
    const Point2 at = base_from_sweep * places_[i];
    if (norm(at) >= reach) continue;
    const bool is_border = static_cast<double>(i) > turn;
    const double margin = is_border ? params_.border_margin : params_.hazard_margin;
    obstacles.push_back({at, {}, margin, false, true, is_border});
  }
}

}  // namespace docent::collision_avoidance
