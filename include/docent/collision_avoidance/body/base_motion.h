#pragma once

#include <deque>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/body/outline_distance.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// Velocity of a base that cannot move sideways.
struct Velocity {
  double linear = 0.0;   ///< [m/s]
  double angular = 0.0;  ///< [rad/s]
  friend bool operator==(const Velocity&, const Velocity&) = default;
};

/// What the base can do (robot.yaml, section body).
struct BaseLimits {
  double radius = 0.265;           ///< [m]
  double max_speed = 0.8;          ///< [m/s]
  double max_turn_rate = 1.2;      ///< [rad/s]
  double acceleration = 0.5;       ///< [m/s2]
  double deceleration = 1.0;       ///< [m/s2]
  double turn_acceleration = 1.5;  ///< [rad/s2], up and down
  double latency = 0.15;           ///< [s] from a command to the wheels
  double watchdog = 0.3;           ///< [s] without a command, then the base stops
  Outline outline{};         ///< of a body that is no disc; the window and the braking keep to it, not to `radius`
  double base_cycle = 0.05;  ///< [s] between two looks of the base at its watchdog: it is driven at 20 Hz

  /// How long [s] a command can last when we die right after giving it.
  [[nodiscard]] double hold() const { return watchdog + base_cycle; }
  /// The point on a ray from the centre that lies `beyond` [m] outside the body, base frame.
  [[nodiscard]] Point2 edge(Angle bearing, double beyond = 0.0) const {
    return ((outline.empty() ? radius : outline.radius_at(bearing)) + beyond) * unit(bearing);
  }
  /// [m] of the largest disc round the centre that the body covers.
  [[nodiscard]] double inradius() const { return outline.empty() ? radius : norm(outline.nearest({})); }
  /// Distance [m] from the body to a point, base frame. Inside it is negative for a disc, else 0.
  [[nodiscard]] double gap_to(Point2 in_base) const {
    return outline.empty() ? norm(in_base) - radius : outline.distance_to(in_base);
  }
};

/// A moving base: where it is and how it moves.
struct BaseState {
  Pose2 odom_from_base;  ///< where, by odometry
  Velocity velocity;     ///< how fast
};

/// The base `dt` [s] later when its wheels are given `command` all the while.
[[nodiscard]] BaseState advance(const BaseState& state, const Velocity& command, const BaseLimits& limits, double dt);

/// How long commands are kept.
struct CommandHistoryParams {
  double memory = 1.0;  ///< [s] longer than any latency: what is older moves the wheels no more
};

/// What was commanded lately: the wheels feel it one latency later.
class CommandHistory {
 public:
  explicit CommandHistory(const CommandHistoryParams& params = {}) : params_{params} {}  ///< no command yet
  void add(Time time, const Velocity& command);                                          ///< in the order of time
  /// The last command given at or before `time`; zero before the first.
  [[nodiscard]] Velocity at(Time time) const;

 private:
  CommandHistoryParams params_;
  std::deque<std::pair<Time, Velocity>> commands_;
};

/// How `predict` steps.
struct PredictionParams {
  double step = 0.025;   ///< [s] of the simulated motion, in which the velocity changes little
  double longest = 5.0;  ///< [s] from an older state nothing follows; commands are forgotten sooner
};

/// Carries `state` from time `from` to `to` under the commands given one latency before. O((to - from) / step).
[[nodiscard]] BaseState predict(BaseState state, Time from, Time to, const CommandHistory& commands,
                                const BaseLimits& limits, const PredictionParams& params = {});

/// How long states are kept.
struct BaseHistoryParams {
  double begins_anew = 1.0;  ///< [s] a stamp so much older than the newest: the clock or the base began anew
  double memory = 6.0;       ///< [s] longer than any message carries its stamp on
  double carried_on = 0.3;   ///< [s] beyond the newest state that its velocity tells of
};

/// Where the base was, by odometry, over the last seconds.
class BaseHistory {
 public:
  explicit BaseHistory(const BaseHistoryParams& params = {}) : params_{params} {}  ///< nothing is known yet
  /// By falling age, one of the same stamp takes the other's place; a stamp far older than the newest begins anew.
  void add(Time stamp, const BaseState& state);
  void forget() { states_.clear(); }  ///< the clock was set: the stamps of what is kept are of another one
  [[nodiscard]] bool empty() const { return states_.empty(); }  ///< nothing was added
  /// @pre not empty()
  [[nodiscard]] const BaseState& newest() const { return states_.back().second; }
  /// @pre not empty()
  [[nodiscard]] Time newest_stamp() const { return states_.back().first; }
  /// odom_from_base at `time`: interpolated inside the history, carried on with the last velocity for a moment
  /// after it, the oldest one before it. @pre not empty()
  [[nodiscard]] Pose2 pose_at(Time time) const;
  /// Path length [m] driven since `time`, as far as the history reaches.
  [[nodiscard]] double driven_since(Time time) const;

 private:
  BaseHistoryParams params_;
  std::deque<std::pair<Time, BaseState>> states_;
};

}  // namespace docent::collision_avoidance
