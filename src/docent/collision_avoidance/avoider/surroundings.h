#pragma once

#include <span>
#include <utility>
#include <vector>

#include "docent/collision_avoidance/avoider/felt_places.h"
#include "docent/collision_avoidance/avoider/people_caution.h"
#include "docent/collision_avoidance/avoider/virtual_obstacles.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/collision_avoidance/obstacle_field/seen_places.h"
#include "docent/collision_avoidance/obstacle_field/unmapped_places.h"

namespace docent::collision_avoidance {

struct SurroundingsParams {
  double real_margin = 0.08;     ///< [m] as DynamicWindowParams::real_margin
  double surprise = 0.4;         ///< [m/s] as PeopleCautionParams::surprise
  double seen_for = 3.0;         ///< [s] a place that a laser saw to be free counts as free when none looks there
  bool has_lasers = true;        ///< false: sonars all round hear what is there, and no place is unknown
  bool blind_to_people = false;  ///< crippled, for evaluation: knows virtual measurements only
  double least_reach = 3.5;      ///< [m] what is farther away does not matter to a slow robot within one cycle
  double fast_walk = 1.5;        ///< [m/s] of who may come towards the robot
  double least_steps_in = 2.5;   ///< [m] who stands farther away cannot step into the way of a slow robot in time
  double outline_step = 0.02;    ///< [m] between the places where somebody who cannot be inside the robot may be
  double farthest_inside = 0.6;  ///< [m] that motion foreseen for one latency may lead into the body
  FeltPlacesParams felt{};       ///< what only touch finds
  double blind_inset = 0.001;    ///< [m] within the margin lies what a blind laser may hide
};

/// Everything that the robot must not touch: what was sensed, what nothing has seen, and virtual measurements.
class Surroundings {
 public:
  Surroundings(const BaseLimits& limits, const SurroundingsParams& params, const VirtualObstaclesParams& virtual_params)
      : limits_{limits},
        params_{params},
        memory_{memory_of(params)},
        seen_{{.seen_for = params.seen_for}},
        felt_{params.felt},
        virtual_{virtual_params} {}

  /// @param odom_from_base  pose at the sweep's stamp
  void add_sweep(std::size_t sensor, SensorSweep sweep, const Pose2& odom_from_base) {
    memory_.add_sweep(sensor, sweep, odom_from_base);
    seen_.add(sensor, std::move(sweep), odom_from_base);
  }
  [[nodiscard]] ObstacleMemory& memory() { return memory_; }
  [[nodiscard]] const ObstacleMemory& memory() const { return memory_; }
  [[nodiscard]] FeltPlaces& felt() { return felt_; }
  [[nodiscard]] const FeltPlaces& felt() const { return felt_; }
  [[nodiscard]] UnmappedPlaces& unmapped() { return unmapped_; }
  [[nodiscard]] const UnmappedPlaces& unmapped() const { return unmapped_; }
  [[nodiscard]] VirtualObstacles& virtual_obstacles() { return virtual_; }
  [[nodiscard]] const VirtualObstacles& virtual_obstacles() const { return virtual_; }

  /// How far [m] what may matter before the robot can stand lies at most.
  /// @param speed  [m/s] that the robot may drive at most
  [[nodiscard]] double reach(double speed) const;
  /// Everything within reach, base frame, moving things where they are at `when`.
  [[nodiscard]] std::vector<Obstacle> obstacles(const Pose2& odom_from_base, Time when, double speed,
                                                const PeopleCaution& caution) const;

 private:
  static ObstacleMemoryParams memory_of(const SurroundingsParams& params) {
    ObstacleMemoryParams memory;
    if (!params.felt.remembers) memory.touch_memory = memory.seen_touch;
    return memory;
  }
  [[nodiscard]] double until_it_stands(double speed) const { return limits_.hold() + speed / limits_.deceleration; }
  /// [m] from the robot: who stands farther away cannot step into its way in time.
  [[nodiscard]] double steps_in(double speed) const;
  void add_sensed(std::vector<Obstacle>& obstacles, const Pose2& base_from_odom, Time when, double speed,
                  const PeopleCaution& caution) const;
  void add_felt(std::vector<Obstacle>& obstacles, const Pose2& odom_from_base, double reach) const;
  void add_unseen(std::vector<Obstacle>& obstacles, const Pose2& odom_from_base, Time when) const;
  /// Nothing is inside the robot: whoever was foreseen there has come up to its outline, on the way that they came.
  [[nodiscard]] Point2 stopped_at_outline(Point2 at, Point2 velocity) const;

  BaseLimits limits_;
  SurroundingsParams params_;
  ObstacleMemory memory_;
  SeenPlaces seen_;
  FeltPlaces felt_;
  UnmappedPlaces unmapped_;
  VirtualObstacles virtual_;
};

}  // namespace docent::collision_avoidance
