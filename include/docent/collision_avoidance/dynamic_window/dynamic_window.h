#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/collision_avoidance/dynamic_window/free_ways.h"

namespace docent::collision_avoidance {

/// The choice of a velocity within the dynamic window, and its margins.
struct DynamicWindowParams {
  double cycle = 0.25;  ///< [s] velocities are chosen from what can be reached in it; the most between two selections
  double heading_weight = 1.2;     ///< of the heading towards the goal at the predicted pose
  double clearance_weight = 0.35;  ///< of the free way ahead
  double speed_weight = 0.8;       ///< of the speed towards the goal
  double change_weight = 0.08;     ///< against needless changes of the command
  double heading_time = 0.6;       ///< [s] the pose is predicted so far for the heading
  int linear_steps = 13;           ///< speeds that are tried
  int angular_steps = 31;          ///< turn rates that are tried with each
  double real_margin = 0.08;       ///< [m] kept to what was sensed, sensor noise included
  double virtual_margin = 0.15;    ///< [m] kept to virtual measurements of hazards
  double border_margin = 0.07;     ///< [m] from the centre to virtual measurements of the area's border
  double security_time = 0.15;     ///< [s] more margin for every m/s of speed above creep_speed
  double security_most = 0.22;     ///< [m] no more margin than that is added
  double creep_speed = 0.12;       ///< [m/s] inside a margin, and backwards
  bool two_second_rule = false;    ///< refuses what would meet an obstacle within two seconds

  // What no robot.yaml needs to change.
  double rule_time = 2.0;        ///< [s] of the two-second rule [Buhmann1995]
  double turning_speed = 0.03;   ///< [m/s] a slower robot turns on the spot: what counts is the way that it turns to
  double enough_way = 2.0;       ///< [m] of free way that are worth as much as any more
  double least_scale = 0.1;      ///< [m/s] the speed counts against the cap, or against so much when that is less
  double next_check = 0.1;       ///< [s] until the next scan, when a command may be braked again
  double standing_speed = 0.02;  ///< [m/s] a slower robot may turn at once when nothing else is safe
  int tries = 60;                ///< velocities whose braking is checked, the best first: no more are affordable
  int tries_to_skip_more = 8;    ///< after so many refused ones one more is skipped each time, or the slow end of the
                                 ///< window would never have its turn

  template <class V>
  void visit(V& v) {
    v("cycle", cycle);
    v("heading_weight", heading_weight);
    v("clearance_weight", clearance_weight);
    v("speed_weight", speed_weight);
    v("change_weight", change_weight);
    v("heading_time", heading_time);
    v("linear_steps", linear_steps);
    v("angular_steps", angular_steps);
    v("real_margin", real_margin);
    v("virtual_margin", virtual_margin);
    v("border_margin", border_margin);
    v("security_time", security_time);
    v("creep_speed", creep_speed);
    v("two_second_rule", two_second_rule);
    v("security_most", security_most);
  }
  [[nodiscard]] Result<void> validate() const;

  /// The speed [m/s] whose security distance is `slack` [m] more than the margin; infinite where more is never asked
  /// for. The security distance of [Buhmann1995], 10 to 30 cm there: the margin, and security_time for every m/s
  /// above creep_speed, at most security_most.
  [[nodiscard]] double speed_with(double slack) const;
};

/// What the window shall steer for.
struct Steering {
  double bearing = 0.0;      ///< [rad] base frame
  double distance = 10.0;    ///< [m] to the point that is steered for
  double speed_cap = 0.0;    ///< [m/s]; 0: turn on the spot
  bool may_reverse = false;  ///< backwards counts, too
};

/// A velocity of the window and its worth.
struct EvaluatedVelocity {
  Velocity velocity;    ///< forward and turning
  double value = -1.0;  ///< < 0: not admissible
};

/// What the window chose.
struct WindowChoice {
  Velocity command;                       ///< the best admissible one, else full braking
  bool is_braking = false;                ///< nothing in the window was safe: full braking
  std::vector<EvaluatedVelocity> window;  ///< all, by rising speed, then turn rate
};

/// The dynamic window [Rhino1999] 4.1.1: all velocities that the base can reach in `cycle`. Hard constraint:
/// full braking before contact, whatever fails; as an option the two-second rule of [Buhmann1995] as well. Soft
/// ones: speed, heading at the predicted pose, clearance; smoothed.
class DynamicWindow {
 public:
  /// @param set  all give the same choice
  DynamicWindow(const BaseLimits& limits, const DynamicWindowParams& params,
                InstructionSet set = instruction_sets().back());

  /// @param velocity  of the base when the command will take effect
  /// @param last      the command before
  /// @param obstacles  ways lead past where they are now; that the base can brake is asked of where they will be
  /// O(velocities * obstacles that lie in their way), some hundred times less than velocities * obstacles.
  [[nodiscard]] WindowChoice choose(const Velocity& velocity, const Velocity& last, std::span<const Obstacle> obstacles,
                                    const Steering& steering);

 private:
  /// The range of velocities that can be reached in one cycle.
  struct Reachable {
    double slowest, fastest;  ///< [m/s]
    double right, left;       ///< [rad/s]
  };
  [[nodiscard]] Reachable reachable(const Velocity& velocity, const Steering& steering) const;
  [[nodiscard]] double least_way(double linear) const;
  void lay_out(const Reachable& range);
  void measure_ways(std::span<const Obstacle> obstacles);
  void measure_ways_of_outline();
  void judge_rows(const Velocity& last, std::span<const Obstacle> obstacles, const Steering& steering);
  void smooth(std::vector<EvaluatedVelocity>& window) const;
  [[nodiscard]] std::size_t padded(int row, int column) const {
    return static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>(column);
  }

  BaseLimits limits_;
  DynamicWindowParams params_;
  const VelocityKernels& kernels_;
  FreeWays forwards_;
  FreeWays backwards_;
  Outline tail_first_;  ///< the outline, mirrored: what drives ahead in reverse
  std::vector<ReachPoint> reach_points_;
  std::vector<ReachPoint> border_points_;  ///< for a body with an outline: what binds its centre
  std::size_t stride_ = 0;                 ///< columns, padded to whole vectors
  std::vector<double> linear_;             ///< [linear_steps] [m/s]
  std::vector<double> angular_;            ///< [stride] [rad/s]
  std::vector<double> half_cosine_, half_sine_, cosine_, sine_, change_;  ///< [stride], see VelocityColumns
  std::vector<double> curvatures_, ways_, clearances_, values_;           ///< [linear_steps][stride]
};

}  // namespace docent::collision_avoidance
