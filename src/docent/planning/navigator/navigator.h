#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/navigator/coast_guide.h"
#include "docent/planning/navigator/live_obstacles.h"
#include "docent/planning/navigator/lookout.h"
#include "docent/planning/navigator/lost_drive.h"
#include "docent/planning/navigator/navigator_params.h"
#include "docent/planning/navigator/orders.h"
#include "docent/planning/navigator/whereabouts.h"
#include "docent/planning/pursuit/pursuit.h"
#include "docent/planning/value_iteration/route.h"
#include "docent/planning/value_iteration/value_picture.h"

namespace docent::planning {

/// Where the robot may drive.
struct DrivableGround {
  std::vector<Polygon> hazards;  ///< [m], map: that must not be touched
  Polygon area;                  ///< [m], map: the robot's centre stays inside; empty: everywhere
};

/// Brings the robot from goal to goal: takes what is said of the goal, the belief, the live map and the sweeps, and
/// says at every step what to steer for, where to look and how it goes. While the robot is lost, a goal of its own kind
/// has it look round. Time comes as an argument; a run is determined by the calls.
class Navigator {
 public:
  static constexpr Duration kStepPeriod = std::chrono::milliseconds{200};  ///< between two steps

  /// @param params  with the radius of the robot
  /// @param base_from_scanner  [scanners] where they are mounted
  Navigator(const OccupancyGrid& map, const DrivableGround& ground, std::vector<Pose2> base_from_scanner,
            const NavigatorParams& params);

  void believe(PoseBelief belief) { belief_ = std::move(belief); }
  [[nodiscard]] Lookout& lookout() { return lookout_; }
  [[nodiscard]] LiveObstacles& live_obstacles() { return live_; }
  /// An operator's stop button.
  void stop(bool is_stopped) { is_stopped_ = is_stopped; }
  /// An operator steers: his hand leads the robot for a while.
  void steer(Time now) { steered_ = now; }

  /// A goal with another id replaces the one before, and is answered at once; the same one may change otherwise.
  /// @param relocalize  look round until the robot knows where it is; the goal's place does not matter
  [[nodiscard]] std::optional<Orders> set_goal(const PursuitGoal& goal, bool relocalize, const Whereabouts& where,
                                               Time now);
  /// To be called every `kStepPeriod`.
  [[nodiscard]] Orders step(const Whereabouts& where, Time now);

  /// What keeps a lost robot from going elsewhere to look, for an operator; empty: nothing.
  [[nodiscard]] std::string hindrance() const {
    return relocalizes_ && has_goal() && lost_drive_.is_hemmed_in() ? lookout_.hindrance() : std::string{};
  }

  /// The values by which it plans now; without rows and columns once when it has stopped to plan; nullopt: nothing new.
  [[nodiscard]] std::optional<ValuePicture> value_picture();

 private:
  [[nodiscard]] bool has_goal() const { return !pursuit_.goal().id.empty(); }
  [[nodiscard]] double goal_tolerance() const;
  void plan_to_goal();
  void plan_on(const Whereabouts& where);
  [[nodiscard]] Orders look_for_position(const Whereabouts& where, Time now);
  [[nodiscard]] std::optional<std::vector<Point2>> news_of_path(const Pursuit& pursuit, const Whereabouts& where);

  /// The robot knows that it stands inside a hazard: whether it may leave, and how, is for an operator to say.
  [[nodiscard]] bool is_in_zone(const Whereabouts& where, Time now) const;

  double goal_tolerance_;  ///< [m]
  double robot_radius_;    ///< [m]
  std::vector<Polygon> zones_;
  RoutePlanner route_;
  CoastGuide coast_;
  GoalPursuit pursuit_;
  LostDrive lost_drive_;
  Lookout lookout_;
  LiveObstacles live_;
  PoseBelief belief_;
  bool relocalizes_ = false;     ///< the goal is to know where the robot is
  bool is_stopped_ = false;      ///< by an operator
  std::optional<Time> steered_;  ///< by an operator, last
  int steps_ = 0;
  bool path_was_empty_ = true;
  bool had_values_ = false;
};

}  // namespace docent::planning
