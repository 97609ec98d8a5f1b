#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/simulator/crowd/crowd.h"

// How a person moves who is about something: one function an activity.

namespace docent::simulator {
namespace {

Point2 along(Point2 from, Point2 to, double speed) {
  const Point2 way = to - from;
  const double length = norm(way);
  if (length < 0.08) return {};
  // A person who arrives slows down.
  return (std::min(speed, std::sqrt(2.0 * length)) / length) * way;
}

}  // namespace

Point2 Crowd::desired_velocity(Person& person, const Sight& sight, double now) {
  switch (person.activity) {
    case Activity::stroll:
      return strolling(person, now);
    case Activity::leave:
      return leaving(person, now);
    case Activity::look:
      return looking(person, sight, now);
    case Activity::run:
      return running(person, sight, now);
    case Activity::follow:
    case Activity::listen:
      return keeping_company(person, sight, now);
    case Activity::curious:
    case Activity::block:
    case Activity::wall:
      return standing_in_the_way(person, sight, now);
    case Activity::push:
      if (now >= person.until) {
        return_to_strolling(person, now, true);
        return {};
      }
      return pushing(person, sight);
    case Activity::step_aside:
      if (now >= person.until) {
        return_to_strolling(person, now, false);
        return {};
      }
      return stepping_aside(person, sight);
    case Activity::escort:
      return escorting(person, now);
    case Activity::recorded:
      return {};  // who never decides wants nothing
    case Activity::press:
      return pressing(person, sight, now);
    case Activity::romp:
      return romping(person, now);
    case Activity::stand:
      if (now >= person.until) return_to_strolling(person, now, true);
      return {};
  }
  return {};
}

std::optional<Point2> Crowd::walk_to(const Person& person, Point2 goal, double speed) const {
  if (!floor_.is_clear(person.position, goal, std::min(person.radius, 0.22))) return std::nullopt;
  return along(person.position, goal, speed);
}

Point2 Crowd::looking(Person& person, const Sight& sight, double now) {
  if (now >= person.until) {
    if (now >= person.leaves_at && !world_.entrances.empty()) {
      person.activity = Activity::leave;
      person.has_arrived = false;
      return {};
    }
    next_attraction(person, now);
    return {};
  }
  // Back to the spot once nothing drives them off it.
  return distance(person.position, person.goal) > 0.5 && (sight.gap > 1.0 || person.ignores_robot)
             ? along(person.position, person.goal, 0.5)
             : Point2{};
}

Point2 Crowd::running(Person& person, const Sight& sight, double now) {
  if (now >= person.until) {
    return_to_strolling(person, now, false);
    return {};
  }
  if (!person.has_goal || distance(person.position, person.goal) < 0.4) {
    person.has_goal = false;
    for (int attempt = 0; attempt < 8 && !person.has_goal; ++attempt) {
      const bool round_robot = sight.in_sight && sight.away < 6.0 && rng_.chance(0.3);
      const Point2 centre = round_robot ? robot_.position : person.position;
      const Point2 goal = centre + rng_.uniform(1.2, 6.0) * unit(Angle::radians(rng_.uniform(-3.14, 3.14)));
      if (floor_.clearance(goal) < 0.35 || !floor_.is_clear(person.position, goal, 0.2)) continue;
      person.goal = goal;
      person.has_goal = true;
    }
  }
  return person.has_goal ? along(person.position, person.goal, 1.5 + 0.5 * (1.3 - person.preferred_speed)) : Point2{};
}

Point2 Crowd::strolling(Person& person, double now) {
  if (person.attraction < 0 && !person.has_goal) next_attraction(person, now);
  if (person.attraction >= 0 && !person.has_goal) {
    const Attraction& attraction = world_.attractions[static_cast<std::size_t>(person.attraction)];
    if (distance(person.position, attraction.centre) < attraction.radius + 1.5) {
      for (int attempt = 0; attempt < 6 && !person.has_goal; ++attempt) {
        const Point2 spot = attraction.centre + rng_.uniform(0.6, 1.2) * attraction.radius *
                                                    unit(Angle::radians(rng_.uniform(-3.14, 3.14)));
        if (floor_.clearance(spot) < 0.32 || !floor_.is_clear(person.position, spot, 0.2)) continue;
        person.goal = spot;
        person.has_goal = true;
      }
    }
    if (!person.has_goal) {
      const auto way = floor_.direction(field(person.attraction), person.position, person.radius);
      if (way) return person.preferred_speed * *way;
      person.goal = person.position;
      person.has_goal = true;
    }
  }
  if (distance(person.position, person.goal) < 0.25) {
    person.activity = Activity::look;
    person.back_turned = rng_.chance(params_.back_turned_share);
    const double dwell = rng_.uniform(params_.dwell_min, params_.dwell_max);
    const double together = groups_[static_cast<std::size_t>(person.group)].until;
    person.until = person.attraction >= 0 && together > now + 3.0 ? together + rng_.uniform(0.0, 4.0)
                                                                  : now + (person.attraction >= 0 ? dwell : 2.0);
    return {};
  }
  if (const auto walk = walk_to(person, person.goal, person.preferred_speed)) return *walk;
  person.has_goal = false;
  if (person.attraction < 0) next_attraction(person, now);
  return {};
}

Point2 Crowd::leaving(Person& person, double now) {
  if (world_.entrances.empty()) {
    return_to_strolling(person, now, false);
    return {};
  }
  const std::size_t door = person.id % world_.entrances.size();
  if (distance(person.position, world_.entrances[door]) < 1.0) {
    person.has_arrived = true;
    return {};
  }
  const auto way =
      floor_.direction(field(static_cast<int>(world_.attractions.size() + door)), person.position, person.radius);
  if (!way) {
    person.has_arrived = true;
    return {};
  }
  return person.preferred_speed * *way;
}

Point2 Crowd::keeping_company(Person& person, const Sight& sight, double now) {
  if (now >= person.until) {
    const bool goes_on = person.activity == Activity::listen && rng_.chance(0.25);
    if (goes_on) {
      person.activity = Activity::follow;
      person.until = now + rng_.uniform(20.0, 90.0);
    } else {
      return_to_strolling(person, now, true);
    }
    return {};
  }
  if (!sight.in_sight || sight.away > params_.interest_range) {
    // Round the corner: a way through the building, found now and then.
    if (now - robot_field_at_ > 3.0 || robot_field_.is_empty()) {
      robot_field_ = floor_.field_to(robot_.position, 0.8);
      robot_field_at_ = now;
    }
    const auto way = floor_.direction(robot_field_, person.position, person.radius);
    if (!way) return_to_strolling(person, now, true);
    return way ? person.preferred_speed * *way : Point2{};
  }
  const double wanted = robot_.radius + person.radius + person.keeps_distance;
  const double speed = norm(robot_.velocity);
  Point2 place{};
  if (person.activity == Activity::follow && speed > 0.1) {
    const Point2 ahead = robot_ahead(1.0) - robot_.position;
    place = robot_ahead(-wanted) + (0.45 * person.side) * Point2{-ahead.y, ahead.x};
  } else {
    place = robot_.position - (wanted / std::max(sight.away, 0.1)) * sight.offset;
  }
  if (distance(person.position, place) < 0.25) return {};
  if (const auto walk = walk_to(person, place, std::max(person.preferred_speed, 1.0))) return *walk;
  return sight.away > wanted + 0.3 ? along(person.position, robot_.position, 0.6) : Point2{};
}

Point2 Crowd::standing_in_the_way(Person& person, const Sight& sight, double now) {
  if (now >= person.until) {
    return_to_strolling(person, now, true);
    return {};
  }
  const double robot_speed = norm(robot_.velocity);
  if (person.activity == Activity::block && person.has_arrived && robot_speed > 0.1 && sight.in_sight) {
    // A person who means it changes place with the robot: before it again, where it goes now.
    const bool is_passed = dot(robot_ahead(1.0) - robot_.position, sight.offset) > -0.5 * sight.away;
    const Point2 place = robot_ahead(1.5 + robot_speed);
    if (is_passed && floor_.clearance(place) > 0.3 && floor_.is_clear(person.position, place, 0.2)) {
      person.goal = place;
      person.has_arrived = false;
    }
  }
  if (person.has_arrived) {
    // The robot took another way: no fun.
    if (sight.away > 4.5) return_to_strolling(person, now, true);
    return {};
  }
  if (distance(person.position, person.goal) < 0.2) {
    person.has_arrived = true;
    return {};
  }
  // Nobody throws themselves before it: where it is too near for that, they let it be.
  const bool too_late =
      distance(robot_.position, person.goal) < robot_.radius + person.radius + 0.35 + 0.8 * robot_speed;
  const auto walk = walk_to(person, person.goal, 1.3);
  if ((too_late || !walk) && person.activity == Activity::block) {
    if (sight.away > 6.0) return_to_strolling(person, now, true);
    const Point2 place = robot_ahead(1.6 + robot_speed);
    if (floor_.clearance(place) > 0.3) person.goal = place;
    return {};
  }
  if (too_late || !walk) {
    return_to_strolling(person, now, false);
    return {};
  }
  return *walk;
}

Point2 Crowd::escorting(Person& person, double now) {
  if (now >= person.until) {
    return_to_strolling(person, now, true);
    return {};
  }
  // Their place in the ring; where a wall is, the next one towards the robot's back.
  const double ring = robot_.radius + person.radius + person.keeps_distance;
  const double to_back = person.slot < std::numbers::pi ? 1.0 : -1.0;
  for (double fold = 0.0; fold < 2.4; fold += 0.4) {
    const double slot = person.slot + to_back * fold;
    if (fold > 0.0 && (slot - std::numbers::pi) * to_back > 0.4) break;
    const Point2 place = robot_.position + ring * unit(Angle::radians(robot_.heading + slot));
    if (floor_.clearance(place) < 0.25 || !floor_.is_clear(robot_.position, place, 0.0)) continue;
    if (!floor_.is_clear(person.position, place, 0.1)) continue;
    const Point2 arm = place - robot_.position;
    const Point2 carried = robot_.velocity + robot_.turn_rate * Point2{-arm.y, arm.x};
    const Point2 wanted = carried + 1.5 * (place - person.position);
    const double speed = norm(wanted);
    constexpr double kFastest = 1.7;  // [m/s]
    if (speed < 0.08) return {};
    return speed > kFastest ? (kFastest / speed) * wanted : wanted;
  }
  if (now - robot_field_at_ > 1.5 || robot_field_.is_empty()) {
    robot_field_ = floor_.field_to(robot_.position, 0.8);
    robot_field_at_ = now;
  }
  if (distance(person.position, robot_.position) < ring + 0.2) return {};
  const auto way = floor_.direction(robot_field_, person.position, person.radius);
  return way ? std::max(1.2, person.preferred_speed) * *way : Point2{};
}

Point2 Crowd::pushing(Person& person, const Sight& sight) const {
  if (!sight.in_sight) return {};
  const Point2 to_robot = (1.0 / std::max(sight.away, 0.05)) * sight.offset;
  const double towards_me = -dot(robot_.velocity, to_robot);
  if (towards_me > 0.12 && sight.gap < 0.8) return -0.8 * to_robot;  // it comes on: back
  if (norm(robot_.velocity) > 0.35) return sight.gap > 1.0 ? 0.8 * to_robot : Point2{};
  // From a side, never head on.
  const Point2 heading = unit(Angle::radians(robot_.heading));
  if (dot(heading, to_robot) < -0.6 && sight.gap < 2.0) {
    const Point2 left{-heading.y, heading.x};
    return along(person.position, robot_.position + person.side * (robot_.radius + person.radius + 0.5) * left, 0.8);
  }
  return std::clamp(1.2 * sight.gap, 0.25, person.preferred_speed) * to_robot;
}

Point2 Crowd::pressing(Person& person, const Sight& sight, double now) {
  if (now >= person.until) {
    return_to_strolling(person, now, true);
    return {};
  }
  constexpr double kComesBy = 5.0;  // [m]
  if (!sight.in_sight || sight.away > kComesBy) return {};
  const Point2 to_robot = (1.0 / std::max(sight.away, 0.05)) * sight.offset;
  if (-dot(robot_.velocity, to_robot) > 0.12 && sight.gap < 0.8) return -0.8 * to_robot;  // it comes on: back
  const Point2 side = unit(Angle::radians(person.slot));
  const Point2 place = robot_.position + (robot_.radius + reach_to(person, -1.0 * side) - 0.02) * side;
  const double away = distance(person.position, place);
  if (away < 0.03) return {};
  return (std::clamp(1.2 * away, 0.2, 1.0) / away) * (place - person.position);
}

Point2 Crowd::romping(Person& person, double now) {
  if (now >= person.until) {
    return_to_strolling(person, now, false);
    return {};
  }
  if (!person.has_goal || distance(person.position, person.goal) < 0.4) {
    person.has_goal = false;
    for (int attempt = 0; attempt < 8 && !person.has_goal; ++attempt) {
      const Point2 goal =
          person.home + rng_.uniform(0.0, person.ground) * unit(Angle::radians(rng_.uniform(-3.14, 3.14)));
      if (distance(goal, person.position) < 1.0 || floor_.clearance(goal) < 0.35) continue;
      if (!floor_.is_clear(person.position, goal, 0.2)) continue;
      person.goal = goal;
      person.has_goal = true;
    }
  }
  return person.has_goal ? along(person.position, person.goal, person.preferred_speed) : Point2{};
}

Point2 Crowd::stepping_aside(const Person& person, const Sight& sight) const {
  const Point2 heading = unit(Angle::radians(robot_.heading));
  const Point2 from_robot = Point2{} - sight.offset;
  const double lateral = std::abs(cross(heading, from_robot));
  const double ahead = dot(heading, from_robot);
  if (ahead < -0.3 || ahead > 5.0 || lateral > robot_.radius + person.radius + 0.5) return {};
  return 0.9 * person.goal;
}

}  // namespace docent::simulator
