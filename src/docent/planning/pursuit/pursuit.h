#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/planning/pursuit/detour_watch.h"
#include "docent/planning/value_iteration/route.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::planning {

/// How a way is followed, and when it counts as blocked.
struct PursuitParams {
  double horizon = 5.0;        ///< [m] of the way handed on as via-points
  double progress = 0.3;       ///< [m] of remaining way that count as progress
  double blocked_after = 4.0;  ///< [s] without progress until the state is "blocked"
  double find_way_for = 3.0;   ///< [s] that planning may take before a goal without a way is "unreachable"
  double settle_for = 0.5;     ///< [m]: so near to a goal that others stand on, the robot takes it as reached
  double settle_after = 6.0;   ///< [s] without progress until it does
  DetourParams detour;
  template <class V>
  void visit(V& v) {
    v("horizon", horizon);
    v("progress", progress);
    v("blocked_after", blocked_after);
    v("find_way_for", find_way_for);
    v("settle_for", settle_for);
    v("settle_after", settle_after);
    v("detour", detour);
  }
  [[nodiscard]] Result<void> validate() const;
};

struct PursuitGoal {
  std::string id;  ///< empty: stay
  Pose2 map_from_goal;
  double position_tolerance = 0.25;  ///< [m]
  double heading_tolerance = 0.1;    ///< [rad]
};

/// What the robot should do now: via-points or a heading, never a velocity; and how it goes, for the executive.
struct Pursuit {
  DriveMode mode = DriveMode::stop;
  std::vector<Point2> via;  ///< [m], map, nearest first
  bool is_final = false;    ///< the last via-point is the goal
  Angle heading{};          ///< map
  GoalStatus state = GoalStatus::idle;
  std::string reason;
  double remaining_m = 0.0;
  double straight_m = 0.0;  ///< to the goal as the crow flies; 0 while the robot does not know its place
  double blocked_s = 0.0;
  Detour detour = Detour::none;
  double detour_extra = 0.0;  ///< [m]
  bool is_occupied = false;   ///< something that is not in the map stands where the robot would stand
};

/// Follows one goal after another: drive there along the route, turn to the heading, stay. Deterministic.
class GoalPursuit {
 public:
  explicit GoalPursuit(PursuitParams params) : params_{params}, detour_{params.detour} {}

  /// A goal with another id replaces the one before.
  void set_goal(const PursuitGoal& goal, Time now);
  [[nodiscard]] const PursuitGoal& goal() const { return goal_; }

  /// Somebody holds the robot or leads it elsewhere: that it does not get on is no fault of its way.
  void hold(Time now);

  /// @param map_from_base  nullopt: the robot does not know where it is
  /// @param planner  holds this goal
  [[nodiscard]] Pursuit step(const std::optional<Pose2>& map_from_base, const RoutePlanner& planner, Time now);

 private:
  [[nodiscard]] double stuck_for(Time now) const;  ///< [s]
  void change_phase(double off, double turn, Time now);
  [[nodiscard]] Pursuit follow(const std::vector<Point2>& way, Point2 here, Time now);

  PursuitParams params_;
  PursuitGoal goal_;
  enum class Phase { driving, turning, arrived } phase_ = Phase::driving;
  double best_remaining_ = 0.0;
  Time last_progress_{};
  DetourWatch detour_;
};

}  // namespace docent::planning
