#pragma once

#include <cstdint>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/simulator/office/office.h"
#include "docent/simulator/sensing/sonar.h"

namespace docent {

/// What the robot's driver would have sent, in the order of time: odometry, or one ping.
struct DriveEvent {
  double time = 0.0;  ///< [s]
  Pose2 odom_from_robot;
  int sonar = -1;  ///< -1: odometry alone
  double range = 0.0;
};

/// A drive through an empty building, and what it was in truth.
struct OfficeDrive {
  std::vector<DriveEvent> events;
  std::vector<Pose2> truth;  ///< world_from_base at each event
  double metres = 0.0;
  double moving_share = 0.0;
  double max_speed = 0.0;  ///< [m/s] reached
  int contacts = 0;
  int goals = 0;           ///< places reached
  std::vector<int> kinds;  ///< pings by EchoKind
  simulator::SonarParams sonars;
};

/// Drives from random place to random place as somebody with a joystick would, who sees the true building: the
/// simulated base with slip, latency and odometry that drifts, the simulated ring of sonars. Deterministic for a seed.
[[nodiscard]] OfficeDrive drive_through(const simulator::Office& office, double minutes, double max_speed,
                                        std::uint64_t seed);

}  // namespace docent
