#pragma once

#include <optional>

#include "docent/geometry/pose2.h"

namespace docent::localization {

/// Where a robot is said to be while it does not know. The best mode of a lost robot leaps from one far place to
/// another; the last pose that it knew, carried on by odometry, is off by what odometry errs alone.
class ToldPose {
 public:
  /// After every sweep. @param map_from_robot  [m], [rad] the best mode's mean; nullopt: there is no mode
  /// @param odom_from_robot  where odometry has the robot at the same moment
  /// @param keeps_its_place  the robot knows, or has no reason yet to think otherwise (see Verdict)
  /// @return the best mode while it keeps its place, and where it has known none; else the last pose that it knew,
  /// moved by odometry. O(1).
  [[nodiscard]] std::optional<Pose2> tell(const std::optional<Pose2>& map_from_robot, const Pose2& odom_from_robot,
                                          bool keeps_its_place);

 private:
  std::optional<Pose2> known_map_from_odom_;
};

}  // namespace docent::localization
