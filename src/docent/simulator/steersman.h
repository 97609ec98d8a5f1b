#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/random.h"
#include "docent/geometry/pose2.h"
#include "docent/simulator/crowd/walkable_floor.h"
#include "docent/simulator/sensing/laser.h"

namespace docent::simulator {

/// Someone who walks the robot through the museum by hand, from one random place to the next or along a given way, and
/// sees everything: for recordings in which the robot's own knowledge must not decide where it goes.
class Steersman {
 public:
  struct Command {
    double linear = 0.0;   ///< [m/s]
    double angular = 0.0;  ///< [rad/s]
  };

  /// `speed` [m/s] on free floor. `world` must outlive it.
  /// `way` [m], world: not empty: along these points, and at the last one the robot is let stand.
  Steersman(const World& world, double speed, Rng rng, std::vector<Point2> way = {})
      : world_{&world}, speed_{speed}, rng_{rng}, way_{std::move(way)} {}

  /// 10 Hz. `now` [s]; `robot_radius` [m]. O(people); a new goal O(cells log cells).
  [[nodiscard]] Command steer(double now, const Pose2& world_from_base, double robot_radius,
                              std::span<const Disc> people, const WalkableFloor& floor);

 private:
  /// Where to walk now; nullopt: nowhere.
  [[nodiscard]] std::optional<Point2> heading_for(double now, Point2 here, double robot_radius,
                                                  const WalkableFloor& floor);
  [[nodiscard]] std::optional<Point2> along_way(Point2 here, double robot_radius, const WalkableFloor& floor);
  void choose_goal(double now, Point2 from, const WalkableFloor& floor);

  const World* world_;
  double speed_;
  Rng rng_;
  std::vector<Point2> way_;
  std::size_t next_ = 0;  ///< of way_: the first point that has not been passed
  std::optional<Point2> goal_;
  FlowField field_;
  Point2 progress_from_{};
  double progress_at_ = 0.0;
};

}  // namespace docent::simulator
