#pragma once

#include <cstdint>

#include "docent/geometry/pose2.h"
#include "docent/simulator/sensing/camera/mesh/mesh.h"

namespace docent::simulator {

/// A visitor as one sees them.
struct Figure {
  std::uint32_t id = 0;  ///< clothes, hair and skin come of it
  Pose2 pose;            ///< world; looks along x
  double height = 1.7;   ///< [m]
  double stride = 0.0;   ///< [rad] of the gait; legs are together at 0
  bool walks = false;
};

/// The robot as one sees it: a drum on wheels, a column, a head with a face.
struct RobotFigure {
  Pose2 pose;             ///< world_from_base
  double radius = 0.265;  ///< [m]
  double pan = 0.0;       ///< [rad] of the head, to the left
  double tilt = 0.0;      ///< [rad] upwards
  double valence = 0.0;   ///< -1 (angry) .. 1 (happy)
};

/// Height [m] above the floor of the robot's camera, which is between its eyes.
inline constexpr double kEyeHeight = 1.38;

void add_figure(Mesh& mesh, const Figure& figure);
void add_robot(Mesh& mesh, const RobotFigure& robot);

}  // namespace docent::simulator
