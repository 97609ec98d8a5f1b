#pragma once

#include <vector>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/simulator/world/world.h"

namespace docent::apps::take_pictures_command {

/// A robot at a moment.
struct Moment {
  double time = 0.0;  ///< [s]
  Pose2 world_from_base;
};

struct DriveOptions {
  double speed = 0.5;       ///< [m/s]
  double spacing = 0.3;     ///< [m] between pictures
  double turning = 0.5;     ///< [rad] between pictures, where it turns
  double clearance = 0.45;  ///< [m] of its centre to what stands there
  double lane = 1.5;        ///< [m] so far from where it was is a place that it has not been to
  std::size_t pictures = 600;
};

/// A drive, and when pictures are taken.
struct Drive {
  std::vector<Moment> moments;        ///< every kTick [s]
  std::vector<std::size_t> pictures;  ///< indices of moments
  /// Between two moments, at any time of the drive.
  [[nodiscard]] Pose2 at(double time) const;
};
inline constexpr double kTick = 0.02;

/// Along the points of a way, straight from each to the next, heeding nothing that stands there.
[[nodiscard]] Result<Drive> drive_along(const std::vector<Point2>& way, const DriveOptions& options);

/// Through all of the operating area, always to the nearest place where it has not been, then to random ones until it
/// has its pictures. Error: nowhere to drive.
[[nodiscard]] Result<Drive> drive_everywhere(const simulator::World& world, const DriveOptions& options, Rng rng);

/// What the robot would know of its poses: odometry that drifts, and what a localizer by lasers says, some centimetres
/// wrong, in a way that changes slowly.
struct ToldPoses {
  std::vector<Pose2> odometry;  ///< of each picture; the first is the origin
  std::vector<Pose2> map;       ///< likewise, in the world
};
[[nodiscard]] ToldPoses told_poses(const Drive& drive, Rng rng);

}  // namespace docent::apps::take_pictures_command
