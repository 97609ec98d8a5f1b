#include "docent/simulator/steersman.h"

#include <algorithm>
#include <cmath>

#include "docent/simulator/start_pose.h"

namespace docent::simulator {
namespace {

constexpr double kArrived = 0.6;      // [m]
constexpr double kAhead = 0.8;        // [m] to the point of a given way that is walked to
constexpr double kThere = 0.15;       // [m] from the end of a given way
constexpr double kPatience = 6.0;     // [s] without getting anywhere, then another goal
constexpr double kTurn = 0.7;         // [rad/s] at most
constexpr double kClearOfWall = 0.1;  // [m] between the outline and what stands there

}  // namespace

void Steersman::choose_goal(double now, Point2 from, const WalkableFloor& floor) {
  progress_from_ = from;
  progress_at_ = now;
  const auto place = random_start(*world_, floor, rng_, 0.6, from, 5.0);
  goal_ = place ? std::optional{place->position()} : std::nullopt;
  if (goal_) field_ = floor.field_to(*goal_, 0.4);
}

std::optional<Point2> Steersman::heading_for(double now, Point2 here, double robot_radius, const WalkableFloor& floor) {
  if (distance(here, progress_from_) > 0.3) {
    progress_from_ = here;
    progress_at_ = now;
  }
  if (!way_.empty()) {
    if (now - progress_at_ > kPatience && next_ + 1 < way_.size()) {
      ++next_;
      progress_at_ = now;
    }
    return along_way(here, robot_radius, floor);
  }
  if (!goal_ || distance(here, *goal_) < kArrived || now - progress_at_ > kPatience) choose_goal(now, here, floor);
  if (!goal_) return std::nullopt;
  const auto way = floor.direction(field_, here, robot_radius + kClearOfWall);
  if (!way) goal_.reset();
  return way;
}

std::optional<Point2> Steersman::along_way(Point2 here, double robot_radius, const WalkableFloor& floor) {
  const Point2 end = way_.back();
  if (distance(here, end) < kThere) return std::nullopt;
  const double room = robot_radius + kClearOfWall;
  // Points that are passed, and those on which something stands that who made the way did not know.
  const auto is_done = [&](Point2 point) { return distance(here, point) < kAhead || floor.clearance(point) < room; };
  while (next_ + 1 < way_.size() && is_done(way_[next_])) ++next_;
  const Point2 next = way_[next_];
  const double off = distance(here, next);
  const Point2 straight = (1.0 / off) * (next - here);
  if (off < kAhead || floor.is_clear(here, next, room)) return straight;
  if (!goal_ || !(*goal_ == next)) field_ = floor.field_to(next, 0.4);
  goal_ = next;
  return floor.direction(field_, here, room).value_or(straight);
}

Steersman::Command Steersman::steer(double now, const Pose2& world_from_base, double robot_radius,
                                    std::span<const Disc> people, const WalkableFloor& floor) {
  const Point2 here = world_from_base.position();
  const auto way = heading_for(now, here, robot_radius, floor);
  if (!way) return {};
  // Away from walls by as much as is missing to a comfortable clearance.
  const double missing = std::max(0.0, 0.6 - floor.clearance(here));
  const Point2 wanted = *way + (1.2 * missing) * floor.away_from_walls(here);
  const Angle error = Angle::radians(std::atan2(wanted.y, wanted.x)) - world_from_base.theta;
  Command command;
  command.angular = std::clamp(2.0 * error.radians(), -kTurn, kTurn);
  const double facing = std::max(0.0, std::cos(1.3 * std::clamp(error.radians(), -1.2, 1.2)));
  command.linear = speed_ * facing;

  const Point2 ahead = unit(world_from_base.theta);
  const auto room_allows = [](double room) { return std::sqrt(2.0 * 0.4 * std::max(0.0, room)); };
  for (const Disc& person : people) {
    const Point2 offset = person.centre - here;
    const double along = dot(ahead, offset);
    const double reach = robot_radius + person.radius;
    if (along <= 0.0 || along > 2.5 || std::abs(cross(ahead, offset)) > reach + 0.08) continue;
    command.linear = std::min(command.linear, room_allows(norm(offset) - reach - 0.15));
  }
  for (const double look : {0.15, 0.3, 0.5}) {
    const Point2 there = here + look * ahead;
    if (floor.clearance(there) < robot_radius + 0.05)
      command.linear = std::min(command.linear, room_allows(look - 0.2));
    const Polygon& area = world_->operating_area;
    if (area.size() < 3 || contains(area, there)) continue;
    command.linear = 0.0;
    if (way_.empty() && contains(area, here) && now - progress_at_ > 2.0) goal_.reset();
  }
  return command;
}

}  // namespace docent::simulator
