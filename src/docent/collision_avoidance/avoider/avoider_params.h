#pragma once

#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/collision_avoidance/avoider/carried_off.h"
#include "docent/collision_avoidance/avoider/carrot.h"
#include "docent/collision_avoidance/avoider/hand_steering.h"
#include "docent/collision_avoidance/avoider/input_watches.h"
#include "docent/collision_avoidance/avoider/people_caution.h"
#include "docent/collision_avoidance/avoider/surroundings.h"
#include "docent/collision_avoidance/body/speed_near_people.h"
#include "docent/collision_avoidance/body/unseen_bodies.h"
#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"
#include "docent/collision_avoidance/local_planner/local_planner.h"
#include "docent/collision_avoidance/local_planner/window_planners.h"
#include "docent/motion_models/unbroken_odometry.h"

namespace docent::collision_avoidance {

/// How the robot comes to its goal.
struct ApproachParams {
  double turned = 0.6;        ///< of the target's heading tolerance: so near, a turn has ended
  double arrived = 0.5;       ///< of the target's position tolerance: so near, the goal is reached
  double aims_short = 0.2;    ///< of the same tolerance: the robot brakes to stand so much before the goal
  double least_speed = 0.08;  ///< [m/s] with which the last centimetres are driven
  double far = 100.0;         ///< [m] to what a turn on the spot steers for, so that its bearing alone counts
};

/// What is known by touch alone.
struct TouchParams {
  double near = 1.0;            ///< [m] from the body to where a thing touched it that no sensor sees
  double feels_its_way = 0.15;  ///< [m/s] near it: the thing is larger than the place, and only touch tells how much
  double drives_into = 0.05;    ///< [m/s] towards what touches it: then it has not come by itself
  double felt_near = 0.6;       ///< [m] from the body to what it has felt earlier, likewise slow
  double dent = 0.03;           ///< [m] into the body: what touches it there is pressed, deeper it is not there
  double brakes_for = 0.2;      ///< [s] after a touch, at once and whatever was chosen
};

/// When the way counts as blocked.
struct BlockingParams {
  double least_speed = 0.06;  ///< [m/s] a robot that drives faster is not held up
  double least_way = 0.7;     ///< [m] of free way towards its point that are enough
  double horizon = 2.0;       ///< [m] to which the way is looked along
};

/// The check of every scan between two choices.
struct ReflexParams {
  double slack = 0.03;             ///< [m] less margin than at the choice, or the noise of every sweep would brake
  double until_next_sweep = 0.12;  ///< [s] then there is another check
  double still = 0.03;             ///< [m/s] a slower disc stays in its place
};

/// Section `avoid`: collision avoidance, which keeps clear of everything whatever the others want.
struct AvoiderParams {
  DynamicWindowParams window;
  PeopleCautionParams people;
  UnseenBodyParams body;  ///< what of people the lasers do not see
  /// cautious_window: the dynamic window, slower near people, who are foreseen for a second; dynamic_window: the plain
  /// one, for comparison, with people as things that stand where they are now.
  std::string method = "cautious_window";
  double lookahead = 1.2;             ///< [m] the path is followed by steering for a point so far along it, at least,
  double lookahead_time = 1.5;        ///< [s] and as far as the robot drives in this time
  double arrival_deceleration = 0.6;  ///< [m/s2] with which it comes to a stop at its goal
  double target_timeout = 1.5;        ///< [s] without a new target, then it stands
  double virtual_timeout = 1.5;       ///< [s] without new virtual measurements, then it stands
  double seen_for = 3.0;              ///< [s] a place that a laser saw to be free counts as free when none looks there
  bool needs_sonar = true;            ///< stands when the sonars are silent
  double sonar_speed = 0.3;   ///< [m/s] > 0, at most, of a robot without lasers: sonars see 1.5 m far, twice a second
  bool has_infrared = false;  ///< the body has these rings: stands when they are silent, from the start on
  bool has_tactile = false;
  double laser_height = 0.38;          ///< [m] above the floor, of the lowest laser
  bool has_lasers = true;              ///< false: the ring of sonars tells what is free
  bool blind_to_people = false;        ///< crippled, for evaluation: sees virtual measurements and touch only
  bool remembers_touch = true;         ///< false: likewise: what was touched is forgotten
  bool stops_when_carried_off = true;  ///< false: likewise: drives on by what it believed before
  bool watches = true;                 ///< false: likewise: takes every sensor and belief for well
  motion_models::UnbrokenOdometryParams odometry{};  ///< its base is the body's

  // What no robot.yaml needs to change.
  double first_max_speed = 0.7;  ///< [m/s] until the museum's mode has been heard
  ApproachParams approach{};
  SharpTurnParams sharp_turns{};
  TouchParams touch{};
  BlockingParams blocking{};
  ReflexParams reflex{};
  HandParams hand{};
  CarrotParams carrot{};
  CarriedOffParams carried_off{};

  template <class V>
  void visit(V& v) {
    v("window", window);
    v("lookahead", lookahead);
    v("lookahead_time", lookahead_time);
    v("people", people);
    v("body", body);
    v("method", method);
    v("arrival_deceleration", arrival_deceleration);
    v("target_timeout", target_timeout);
    v("virtual_timeout", virtual_timeout);
    v("seen_for", seen_for);
    v("needs_sonar", needs_sonar);
    v("sonar_speed", sonar_speed);
  }
  [[nodiscard]] Result<void> validate() const;

  // Of the avoider's parts.
  /// The planner that `method` names.
  [[nodiscard]] std::unique_ptr<LocalPlanner> make_planner(const BaseLimits& limits) const;
  [[nodiscard]] PeopleCaution caution(const BaseLimits& limits) const;
  [[nodiscard]] SurroundingsParams surroundings() const;
  [[nodiscard]] VirtualObstaclesParams virtual_obstacles() const;
  [[nodiscard]] InputWatchesParams inputs() const;
};

}  // namespace docent::collision_avoidance
