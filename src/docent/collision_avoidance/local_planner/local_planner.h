#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"
#include "docent/collision_avoidance/local_planner/speed_cap.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// What a local planner is asked: a velocity for the next cycle. All in the frame of the base as it will stand when the
/// command takes effect.
struct LocalTask {
  Velocity velocity;                    ///< of the base then
  Velocity last;                        ///< the command before
  Pose2 odom_from_base;                 ///< where the base will be then
  std::span<const Obstacle> obstacles;  ///< all that must not be touched, people as they stand now
  std::span<const Point2> path;         ///< [m] via-points, the nearest first; not empty
  Point2 carrot{};                      ///< [m] the point on the path to steer for
  double full_speed = 0.0;              ///< [m/s] that the museum allows where nothing speaks against it
  SpeedCap cap;                         ///< the greatest speed that is allowed now
};

/// What it answers.
struct LocalPlan {
  explicit LocalPlan(const LocalTask& task) : cap{task.cap} {}
  Velocity command{};
  bool is_braking = false;                ///< it found nothing safe
  SpeedCap cap;                           ///< how fast it would drive at most, and why it is no more
  std::vector<EvaluatedVelocity> window;  ///< what it weighed, for people to look at; may be empty
};

/// Chooses velocities along a path. The avoider asks it once a cycle, and checks whatever it answers: what the base
/// cannot do, what knowledge does not allow, what could not be braked in time, what is too fast near people. So a
/// planner need not be right for the robot to be safe; one that is wrong makes it stand.
class LocalPlanner {
 public:
  LocalPlanner() = default;
  LocalPlanner(const LocalPlanner&) = delete;
  LocalPlanner& operator=(const LocalPlanner&) = delete;
  virtual ~LocalPlanner() = default;
  /// Must answer within a few milliseconds.
  [[nodiscard]] virtual LocalPlan plan(const LocalTask& task) = 0;
  /// The robot stands: what was kept in mind of the drive is void.
  virtual void forget() = 0;
};

/// Makes the planner of one robot; called once for each avoider.
using LocalPlannerMaker = std::function<std::unique_ptr<LocalPlanner>(const BaseLimits& limits)>;

}  // namespace docent::collision_avoidance
