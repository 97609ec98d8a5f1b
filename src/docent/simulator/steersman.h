#pragma once

#include <optional>
#include <span>

#include "docent/base/random.h"
#include "docent/geometry/pose2.h"
#include "docent/simulator/crowd/walkable_floor.h"
#include "docent/simulator/sensing/laser.h"

namespace docent::simulator {

/// Someone who walks the robot through the museum by hand, from one random place to the next, and sees everything: for
/// recordings in which the robot's own knowledge must not decide where it goes.
class Steersman {
 public:
  struct Command {
    double linear = 0.0;   ///< [m/s]
    double angular = 0.0;  ///< [rad/s]
  };

  /// `speed` [m/s] on free floor. `world` must outlive it.
  Steersman(const World& world, double speed, Rng rng) : world_{&world}, speed_{speed}, rng_{rng} {}

  /// 10 Hz. `now` [s]; `robot_radius` [m]. O(people); a new goal O(cells log cells).
  [[nodiscard]] Command steer(double now, const Pose2& world_from_base, double robot_radius,
                              std::span<const Disc> people, const WalkableFloor& floor);

 private:
  void choose_goal(double now, Point2 from, const WalkableFloor& floor);

  const World* world_;
  double speed_;
  Rng rng_;
  std::optional<Point2> goal_;
  FlowField field_;
  Point2 progress_from_{};
  double progress_at_ = 0.0;
};

}  // namespace docent::simulator
