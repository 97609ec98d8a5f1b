#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::planning {

/// One place where the belief sees the robot.
struct PoseHypothesis {
  Pose2 map_from_base;
  std::array<double, 9> covariance{};  ///< row-major x, y, theta; [m], [rad]
  double mass = 0.0;
};

/// The last belief.
struct PoseBelief {
  std::vector<PoseHypothesis> hypotheses;  ///< by falling mass
  Pose2 odom_from_base;                    ///< where odometry had the robot then
};

/// Where the robot is now: the likeliest pose of the last belief, carried on by odometry.
struct Whereabouts {
  bool is_localized = false;            ///< the belief is sure of it
  Time believed_at{};                   ///< the time of the last belief
  std::optional<Pose2> map_from_odom;   ///< nullopt: no belief yet
  std::optional<Pose2> odom_from_base;  ///< nullopt: no odometry yet
  /// Where odometry had the robot at a time of the last seconds; nullopt when it is not known.
  std::function<std::optional<Pose2>(Time)> odom_from_base_at = [](Time) { return std::nullopt; };

  /// Whether the robot is sure of it or not.
  [[nodiscard]] std::optional<Pose2> map_from_base() const;
  /// The robot is sure of it, and the belief is not stale.
  [[nodiscard]] bool is_known(Time now) const;
};

}  // namespace docent::planning
