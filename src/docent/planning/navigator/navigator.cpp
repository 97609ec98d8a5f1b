#include "docent/planning/navigator/navigator.h"

#include <algorithm>
#include <utility>

namespace docent::planning {
namespace {

constexpr int kVisitsAStep = 200;  ///< any-time: so many tiles of the value function between two steps
constexpr int kStepsAPath = 5;     ///< the page sees the path at 1 Hz
constexpr int kValueCoarsening = 2;
constexpr double kCellOfMap = 0.05;                          ///< [m]
constexpr Duration kLedByHandFor = std::chrono::seconds{3};  ///< until the avoidance goes its own way again
constexpr double kFarthest = 1e5;  ///< [m] that is told of a goal, which may be no place of this world

}  // namespace

Navigator::Navigator(const OccupancyGrid& map, const DrivableGround& ground, std::vector<Pose2> base_from_scanner,
                     const NavigatorParams& params)
    : goal_tolerance_{params.goal_tolerance},
      robot_radius_{params.route.robot_radius},
      zones_{ground.hazards},
      route_{map, ground.hazards, ground.area, params.route},
      coast_{map, route_, params.coastal},
      pursuit_{params.pursuit},
      lost_drive_{map, params.route.robot_radius, params.tell_apart, params.active},
      lookout_{std::move(base_from_scanner)},
      live_{coarsened(map, params.route.coarsening)} {}

std::optional<Orders> Navigator::set_goal(const PursuitGoal& goal, bool relocalize, const Whereabouts& where,
                                          Time now) {
  const bool is_new = goal.id != pursuit_.goal().id;
  relocalizes_ = relocalize;
  pursuit_.set_goal(goal, now);
  if (!is_new) return std::nullopt;
  if (relocalize) {
    lost_drive_.start(now);
  } else if (has_goal()) {
    plan_to_goal();
  }
  return step(where, now);
}

/// [m]: a way must end where the robot counts as arrived, whatever the goal asks for.
double Navigator::goal_tolerance() const {
  return std::min(goal_tolerance_, std::max(0.0, pursuit_.goal().position_tolerance - kCellOfMap));
}

void Navigator::plan_to_goal() {
  const Point2 place = pursuit_.goal().map_from_goal.position();
  route_.set_obstacles(live_.standing(), live_.settled());
  coast_.seek(place, goal_tolerance(), route_);
  route_.set_goal(place, goal_tolerance());
}

void Navigator::plan_on(const Whereabouts& where) {
  if (const auto changes = live_.take_changes()) route_.set_obstacles(live_.standing(), live_.settled(), changes);
  coast_.follow(where, belief_, route_);
  const auto here = where.map_from_base();
  if (!here) {
    route_.iterate(kVisitsAStep);
    return;
  }
  route_.settle(here->position(), kVisitsAStep);
  route_.hold_way(here->position());
}

bool Navigator::is_in_zone(const Whereabouts& where, Time now) const {
  const auto here = where.is_known(now) ? where.map_from_base() : std::nullopt;
  return here && std::any_of(zones_.begin(), zones_.end(),
                             [&](const Polygon& zone) { return contains(zone, here->position()); });
}

Orders Navigator::step(const Whereabouts& where, Time now) {
  if (relocalizes_ && has_goal()) return look_for_position(where, now);
  if (has_goal()) plan_on(where);
  if (is_stopped_ || (steered_ && now - *steered_ < kLedByHandFor)) pursuit_.hold(now);
  Orders orders;
  orders.goal_id = pursuit_.goal().id;
  if (has_goal() && is_in_zone(where, now)) {
    pursuit_.hold(now);
    orders.report.state = GoalStatus::waiting;
    orders.report.reason = "it stands inside a hazard's zone, which only an operator may lead it out of";
    return orders;
  }
  const auto here = where.is_known(now) ? where.map_from_base() : std::nullopt;
  orders.report = pursuit_.step(here, route_, now);
  if (here && has_goal())
    orders.report.straight_m =
        std::min(kFarthest, distance(here->position(), pursuit_.goal().map_from_goal.position()));
  orders.report.is_occupied =
      has_goal() && live_.stands_within(pursuit_.goal().map_from_goal.position(), robot_radius_);
  orders.aim = aim_of(orders.report, pursuit_.goal(), where.map_from_odom);
  if (where.odom_from_base) orders.look = look_for(orders.aim, *where.odom_from_base);
  if (steps_++ % kStepsAPath == 0) orders.path = news_of_path(orders.report, where);
  return orders;
}

Orders Navigator::look_for_position(const Whereabouts& where, Time now) {
  Orders orders;
  orders.goal_id = pursuit_.goal().id;
  if (where.is_localized) {
    orders.report.state = GoalStatus::arrived;
    return orders;
  }
  orders.report.state = GoalStatus::waiting;
  orders.report.reason = "looking around to find the position";
  if (!where.odom_from_base) return orders;
  const auto free = lookout_.clearances(where, now);
  orders.aim = aim_of(lost_drive_.step(where, belief_, free, lookout_.reach(), now));
  orders.report.blocked_s = lost_drive_.held_up_s(now);
  if (auto why = hindrance(); !why.empty()) orders.report.reason = std::move(why);
  return orders;
}

std::optional<std::vector<Point2>> Navigator::news_of_path(const Pursuit& pursuit, const Whereabouts& where) {
  std::vector<Point2> path;
  const auto here = where.map_from_base();
  if (pursuit.mode == DriveMode::drive && here) path = route_.way(here->position());
  if (path.empty() && path_was_empty_) return std::nullopt;
  path_was_empty_ = path.empty();
  return path;
}

std::optional<ValuePicture> Navigator::value_picture() {
  if (!has_goal() && !had_values_) return std::nullopt;
  had_values_ = has_goal();
  ValuePicture picture = planning::value_picture(route_.values(), kValueCoarsening);
  if (!has_goal()) {
    picture.frame.columns = picture.frame.rows = 0;
    picture.shares.clear();
  }
  return picture;
}

}  // namespace docent::planning
