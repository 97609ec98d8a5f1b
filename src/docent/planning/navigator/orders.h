#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/planning/exploration/look_around.h"
#include "docent/planning/pursuit/pursuit.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::planning {

/// What the collision avoidance shall steer for: via-points or a heading, never a velocity.
struct Aim {
  DriveMode mode = DriveMode::stop;
  std::vector<Point2> via;           ///< [m], odom, nearest first
  bool is_final = false;             ///< the last via-point is the goal
  Angle heading{};                   ///< odom
  double position_tolerance = 0.25;  ///< [m]
  double heading_tolerance = 0.1;    ///< [rad]
};

/// Where the head looks.
struct Look {
  GazeAt at = GazeAt::none;
  Angle heading{};  ///< odom
  Angle bearing{};  ///< base
};

/// What a step of the navigator says to others.
struct Orders {
  std::string goal_id;
  std::optional<Look> look;  ///< nullopt: as before
  Aim aim;
  Pursuit report;  ///< how the drive goes
  std::optional<std::vector<Point2>>
      path;  ///< [m], map: the way to the goal, empty where there is none; nullopt: as before
};

/// @param map_from_odom  nullopt only where the pursuit stops
[[nodiscard]] Aim aim_of(const Pursuit& pursuit, const PursuitGoal& goal, const std::optional<Pose2>& map_from_odom);
[[nodiscard]] Aim aim_of(const LookAroundStep& step);

/// The head looks where the robot wants to go, above all while it cannot: some way along its path, or to the heading
/// that it turns to.
[[nodiscard]] Look look_for(const Aim& aim, const Pose2& odom_from_base);

}  // namespace docent::planning
