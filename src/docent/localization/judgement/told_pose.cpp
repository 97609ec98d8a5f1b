#include "docent/localization/judgement/told_pose.h"

namespace docent::localization {

std::optional<Pose2> ToldPose::tell(const std::optional<Pose2>& map_from_robot, const Pose2& odom_from_robot,
                                    bool keeps_its_place) {
  if (map_from_robot && keeps_its_place) known_map_from_odom_ = *map_from_robot * inverse(odom_from_robot);
  if (known_map_from_odom_ && !keeps_its_place) return *known_map_from_odom_ * odom_from_robot;
  return map_from_robot;
}

}  // namespace docent::localization
