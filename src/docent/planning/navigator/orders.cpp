#include "docent/planning/navigator/orders.h"

namespace docent::planning {
namespace {

constexpr double kLookAhead = 1.5;  ///< [m] along the way

}  // namespace

Aim aim_of(const Pursuit& pursuit, const PursuitGoal& goal, const std::optional<Pose2>& map_from_odom) {
  Aim aim;
  aim.mode = pursuit.mode;
  aim.is_final = pursuit.is_final;
  aim.position_tolerance = goal.position_tolerance;
  aim.heading_tolerance = goal.heading_tolerance;
  if (pursuit.mode == DriveMode::stop) return aim;
  const Pose2 odom_from_map = inverse(map_from_odom.value_or(Pose2{}));
  aim.heading = odom_from_map.theta + pursuit.heading;
  for (const Point2& via : pursuit.via) aim.via.push_back(odom_from_map * via);
  return aim;
}

Aim aim_of(const LookAroundStep& step) {
  Aim aim;
  aim.mode = step.drive ? DriveMode::drive : DriveMode::turn;
  aim.heading = step.heading;
  aim.is_final = step.drive;
  if (step.drive) {
    aim.via = {step.via};
    aim.position_tolerance = step.tolerance;
  }
  return aim;
}

Look look_for(const Aim& aim, const Pose2& odom_from_base) {
  Look look;
  look.at = aim.mode == DriveMode::drive ? GazeAt::way : aim.mode == DriveMode::turn ? GazeAt::goal : GazeAt::none;
  look.heading = look.at == GazeAt::none ? odom_from_base.theta : aim.heading;
  if (look.at == GazeAt::way) {
    for (const Point2& via : aim.via) {
      look.heading = direction(odom_from_base.position(), via);
      if (distance(odom_from_base.position(), via) > kLookAhead) break;
    }
  }
  look.bearing = look.heading - odom_from_base.theta;
  return look;
}

}  // namespace docent::planning
