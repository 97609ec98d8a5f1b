#include "docent/planning/pursuit/pursuit.h"

#include <cmath>
#include <limits>

namespace docent::planning {

Result<void> PursuitParams::validate() const {
  if (!(horizon > 0.0)) return fail("horizon must be > 0");
  if (!(progress > 0.0)) return fail("progress must be > 0");
  if (!(blocked_after > 0.0)) return fail("blocked_after must be > 0");
  if (!(find_way_for >= 0.0)) return fail("find_way_for must be >= 0");
  if (!(settle_for >= 0.0)) return fail("settle_for must be >= 0");
  if (!(settle_after > 0.0)) return fail("settle_after must be > 0");
  return detour.validate();
}

void GoalPursuit::set_goal(const PursuitGoal& goal, Time now) {
  const bool is_new = goal.id != goal_.id;
  goal_ = goal;
  if (!is_new) return;
  phase_ = Phase::driving;
  best_remaining_ = std::numeric_limits<double>::infinity();
  last_progress_ = now;
  detour_.restart();
}

Pursuit GoalPursuit::step(const std::optional<Pose2>& map_from_base, const RoutePlanner& planner, Time now) {
  Pursuit pursuit;
  if (goal_.id.empty()) return pursuit;
  if (!map_from_base) {
    pursuit.state = phase_ == Phase::arrived ? GoalStatus::arrived : GoalStatus::waiting;
    pursuit.reason = "the position is not known";
    last_progress_ = now;
    best_remaining_ = std::numeric_limits<double>::infinity();
    return pursuit;
  }
  const Point2 here = map_from_base->position();
  const double turn = std::abs((goal_.map_from_goal.theta - map_from_base->theta).radians());
  change_phase(distance(here, goal_.map_from_goal.position()), turn, now);
  if (phase_ == Phase::arrived) {
    pursuit.state = GoalStatus::arrived;
    return pursuit;
  }
  if (phase_ == Phase::turning) {
    pursuit.mode = DriveMode::turn;
    pursuit.heading = goal_.map_from_goal.theta;
    pursuit.state = GoalStatus::turning;
    return pursuit;
  }

  const auto way = planner.way(here);
  if (way.empty() && !planner.is_settled() && stuck_for(now) < params_.find_way_for) {
    pursuit.state = GoalStatus::waiting;
    pursuit.reason = "looking for the way";
    return pursuit;
  }
  if (way.empty()) {
    pursuit.state = GoalStatus::unreachable;
    pursuit.reason = planner.is_closed(here) ? "no way out of this place" : "no way to the goal";
    return pursuit;
  }
  if (planner.is_settled()) detour_.update(way, now);
  return follow(way, here, now);
}

double GoalPursuit::stuck_for(Time now) const { return to_seconds(now - last_progress_); }

void GoalPursuit::hold(Time now) {
  best_remaining_ = std::numeric_limits<double>::infinity();
  last_progress_ = now;
}

/// @param off  [m] from the goal's place
/// @param turn  [rad] from its heading
void GoalPursuit::change_phase(double off, double turn, Time now) {
  // Once there, small jumps of the pose do not send the robot off again; a push does.
  if (phase_ != Phase::driving && off > params_.settle_for + 0.3) {
    phase_ = Phase::driving;
    best_remaining_ = std::numeric_limits<double>::infinity();
    last_progress_ = now;
  }
  if (phase_ == Phase::driving &&
      (off <= goal_.position_tolerance || (off <= params_.settle_for && stuck_for(now) > params_.settle_after))) {
    phase_ = Phase::turning;
    last_progress_ = now;
  }
  if (phase_ == Phase::turning && (turn <= goal_.heading_tolerance || stuck_for(now) > 2.0 * params_.settle_after)) {
    phase_ = Phase::arrived;
  }
}

/// @param way  from `here` to the goal; not empty
Pursuit GoalPursuit::follow(const std::vector<Point2>& way, Point2 here, Time now) {
  Pursuit pursuit;
  double length = distance(here, way.front());
  pursuit.is_final = true;
  pursuit.via.push_back(way.front());
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += distance(way[i - 1], way[i]);
    if (length <= params_.horizon) {
      pursuit.via.push_back(way[i]);
    } else {
      pursuit.is_final = false;
    }
  }
  pursuit.remaining_m = length;
  pursuit.detour = detour_.change();
  pursuit.detour_extra = detour_.extra();
  pursuit.mode = DriveMode::drive;
  pursuit.heading = goal_.map_from_goal.theta;
  if (length < best_remaining_ - params_.progress) {
    best_remaining_ = length;
    last_progress_ = now;
  } else if (length > best_remaining_ + 2.0) {
    best_remaining_ = length;  // a detour: measure progress along it, but the time without progress goes on
  }
  pursuit.blocked_s = stuck_for(now);
  pursuit.state = pursuit.blocked_s > params_.blocked_after ? GoalStatus::blocked : GoalStatus::driving;
  if (pursuit.state == GoalStatus::blocked) pursuit.reason = "no progress";
  return pursuit;
}

}  // namespace docent::planning
