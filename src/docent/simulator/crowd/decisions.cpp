#include <algorithm>
#include <cmath>

#include "docent/simulator/crowd/crowd.h"

// What a person wants next. Every person decides at 10 Hz, those far from the robot at 5 Hz.

namespace docent::simulator {
namespace {

constexpr double kDecisionPeriod = 0.1;  // [s]
constexpr double kNearRobot = 5.0;       // [m]
constexpr double kInItsWay = 2.0;        // [m]

}  // namespace

std::span<const std::uint32_t> Crowd::outlines_within(Point2 point, double range) {
  constexpr double kCell = 1.5;
  const auto bound = [](double value, int limit) { return std::clamp(static_cast<int>(value / kCell), 0, limit - 1); };
  const int first_column = bound(point.x - range - cells_low_.x, cell_columns_);
  const int last_column = bound(point.x + range - cells_low_.x, cell_columns_);
  within_.resize(outlines_.size() + 1);
  std::size_t count = 0;
  for (int row = bound(point.y - range - cells_low_.y, cell_rows_);
       row <= bound(point.y + range - cells_low_.y, cell_rows_); ++row) {
    const auto line = static_cast<std::size_t>(row * cell_columns_);
    const std::size_t end = cell_begin_[line + static_cast<std::size_t>(last_column) + 1];
    for (std::size_t i = cell_begin_[line + static_cast<std::size_t>(first_column)]; i < end; ++i) {
      const Point2 offset = outlines_[i].position - point;
      // No branch: about every other one is within.
      within_[count] = static_cast<std::uint32_t>(i);
      count += static_cast<std::size_t>(dot(offset, offset) <= range * range);
    }
  }
  return std::span{within_}.first(count);
}

std::size_t Crowd::count_of(Activity activity) const {
  return static_cast<std::size_t>(
      std::count_if(people_.begin(), people_.end(), [&](const Person& person) { return person.activity == activity; }));
}

Point2 Crowd::robot_ahead(double distance) const {
  const double speed = norm(robot_.velocity);
  const Point2 ahead = speed > 0.1 ? (1.0 / speed) * robot_.velocity : unit(Angle::radians(robot_.heading));
  return robot_.position + distance * ahead;
}

FlowField& Crowd::field(int attraction) {
  FlowField& field = fields_[static_cast<std::size_t>(attraction)];
  if (field.is_empty()) {
    const auto index = static_cast<std::size_t>(attraction);
    const std::size_t places = world_.attractions.size();
    field = index < places ? floor_.field_to(world_.attractions[index].centre, world_.attractions[index].radius + 0.4)
                           : floor_.field_to(world_.entrances[index - places], 0.5);
  }
  return field;
}

void Crowd::decide(std::size_t index, double now) {
  Person& person = people_[index];
  if (person.activity == Activity::recorded) return;
  Sight sight;
  sight.offset = robot_.position - person.position;
  sight.away = norm(sight.offset);
  sight.gap = sight.away - robot_.radius - person.radius;
  sight.in_sight = sight.away < params_.interest_range + 1.0 && floor_.is_clear(person.position, robot_.position, 0.0);

  if (now >= person.attention_until) {
    person.is_inattentive = rng_.chance(person.activity == Activity::run ? 0.1 : params_.inattentive_share);
    person.attention_until = now + rng_.uniform(4.0, 10.0);
  }
  if (now >= person.reacts_at) {
    person.reacts_at = std::numeric_limits<double>::infinity();
    step_aside(person, sight, now);
  }
  look_at_face(person, sight, now);
  take_interest(index, sight, now);
  Point2 desired = desired_velocity(person, sight, now);

  if (gets_nowhere(person, desired, now))
    desired = rng_.uniform(0.3, 0.8) * unit(Angle::radians(rng_.uniform(-3.14, 3.14)));

  std::array<Neighbour, kMostNeighbours> neighbours;
  std::size_t count = 0;
  person.near_count = 0;
  for (const std::uint32_t i : outlines_within(person.position, 2.5)) {
    const Outline& other = outlines_[i];
    if (other.person == index) continue;
    const Point2 offset = other.position - person.position;
    if (dot(offset, offset) < 1.0 && person.near_count < 8) {
      person.near[static_cast<std::size_t>(person.near_count++)] = static_cast<std::uint16_t>(other.person);
    }
    if (count + 1 < neighbours.size()) {
      neighbours[count++] = {offset, other.velocity, person.radius + other.radius + 0.06, 1.0};
    }
  }
  if (minds_robot(person, sight)) {
    const bool keeps_close = person.activity == Activity::follow || person.activity == Activity::listen ||
                             person.activity == Activity::escort;
    const double space = person.activity == Activity::run ? 0.15 : keeps_close ? 0.25 : 0.35;
    neighbours[count++] = {sight.offset, robot_.velocity, robot_.radius + person.radius + space, 2.0};
  }
  person.wanted =
      choose_velocity(person, desired, std::span{neighbours}.first(count), floor_, now - person.progress_at);
}

/// A person who gets nowhere for a while wants something else, and first goes anywhere. @returns whether this is so now
bool Crowd::gets_nowhere(Person& person, Point2 desired, double now) {
  if (norm(desired) < 0.3 || distance(person.position, person.progress_from) > 0.4) {
    person.progress_from = person.position;
    person.progress_at = now;
    return false;
  }
  if (now - person.progress_at <= 6.0) return false;
  person.progress_at = now;
  if (person.activity == Activity::stroll)
    next_attraction(person, now);
  else if (person.activity == Activity::romp)
    person.has_goal = false;
  else if (person.activity != Activity::leave && person.activity != Activity::escort &&
           person.activity != Activity::press)
    return_to_strolling(person, now, false);
  return true;
}

/// Whether a person keeps out of the robot's way.
bool Crowd::minds_robot(const Person& person, const Sight& sight) const {
  const bool stands_firm =
      person.has_arrived &&
      (person.activity == Activity::curious || person.activity == Activity::block || person.activity == Activity::wall);
  const bool minds = !ignores_robot(person) && person.activity != Activity::push &&
                     person.activity != Activity::stand && person.activity != Activity::press &&
                     person.activity != Activity::romp && !stands_firm &&
                     !(person.activity == Activity::look && person.back_turned) && sight.away < 6.0;
  if (!minds || !person.is_inattentive) return minds;
  const auto time = time_to_touch(sight.offset, person.velocity - robot_.velocity, robot_.radius + person.radius);
  return time && *time < params_.inattentive_notices;
}

void Crowd::return_to_strolling(Person& person, double now, bool bored) {
  person.activity = Activity::stroll;
  person.has_arrived = false;
  person.has_goal = false;
  if (bored) person.bored_until = now + rng_.uniform(params_.boredom_min, params_.boredom_max);
  if (person.attraction < 0) next_attraction(person, now);
}

void Crowd::next_attraction(Person& person, double now) {
  person.activity = Activity::stroll;
  person.has_goal = false;
  person.has_arrived = false;
  if (world_.attractions.empty()) {
    // A bare hall: they walk to and fro.
    for (int attempt = 0; attempt < 20; ++attempt) {
      const auto point = floor_.random_point(rng_, 0.4);
      if (!point) return;
      person.goal = *point;
      person.has_goal = true;
      if (floor_.is_clear(person.position, *point, 0.2)) return;
    }
    return;
  }
  Group& group = groups_[static_cast<std::size_t>(person.group)];
  if (group.until <= now || group.attraction < 0) {
    double total = 0.0;
    const auto weight_of = [&](const Attraction& attraction) {
      return attraction.weight / (4.0 + distance(attraction.centre, person.position));
    };
    for (const Attraction& attraction : world_.attractions) total += weight_of(attraction);
    double draw = rng_.uniform(0.0, total);
    group.attraction = 0;
    for (std::size_t i = 0; i < world_.attractions.size(); ++i) {
      group.attraction = static_cast<int>(i);
      draw -= weight_of(world_.attractions[i]);
      if (draw < 0.0) break;
    }
    group.until = now + rng_.uniform(params_.dwell_min, params_.dwell_max) + 15.0;
  }
  person.attraction = group.attraction;
}

void Crowd::take_interest(std::size_t index, const Sight& sight, double now) {
  Person& person = people_[index];
  const bool is_free =
      person.activity == Activity::stroll || person.activity == Activity::look || person.activity == Activity::run;
  if (!is_free) return;
  if (person.is_child && person.activity != Activity::run &&
      rng_.chance((person.is_heedless ? params_.heedless_run_rate : params_.run_rate) * kDecisionPeriod)) {
    person.activity = Activity::run;
    person.until = now + rng_.uniform(5.0, 12.0);
    person.has_goal = false;
  }
  if (person.ignores_robot || now < person.bored_until || !sight.in_sight || sight.away > params_.interest_range)
    return;
  if (speech_until_ > now && person.activity != Activity::run) {
    // Once a person and talk: the first decision after it began.
    if (rng_.chance(params_.listen_share)) {
      person.activity = Activity::listen;
      person.until = speech_until_ + rng_.uniform(0.5, 3.0);
      person.keeps_distance = rng_.uniform(0.7, 1.6);
      return;
    }
    person.bored_until = now + rng_.uniform(5.0, 15.0);
    return;
  }
  const auto happens = [&](double rate) { return rng_.chance(rate * kDecisionPeriod); };
  const double speed = norm(robot_.velocity);
  const double most_company = 2.0 + 0.12 * static_cast<double>(people_.size());
  if (happens(params_.follow_rate) && static_cast<double>(count_of(Activity::follow)) < most_company) {
    person.activity = Activity::follow;
    person.until = now + rng_.uniform(20.0, 120.0);
    person.keeps_distance = rng_.uniform(0.45, 1.3);
    return;
  }
  if (happens(params_.push_rate) && count_of(Activity::push) < 2 && speed < 0.4) {
    person.activity = Activity::push;
    person.until = now + rng_.uniform(6.0, 13.0);
    person.side = cross(unit(Angle::radians(robot_.heading)), Point2{} - sight.offset) > 0.0 ? 1.0 : -1.0;
    return;
  }
  // In its way: only where it drives towards, and where there is time to get there.
  const Point2 ahead = robot_ahead(1.0) - robot_.position;
  const bool is_ahead = dot(ahead, sight.offset) < -0.3 * sight.away;
  if (speed < 0.1 || !is_ahead || sight.away < 1.6) return;
  const bool blocks = happens(params_.block_rate) && count_of(Activity::block) == 0;
  if (blocks || (happens(params_.curious_rate) && count_of(Activity::curious) < 2)) {
    const Point2 place = robot_ahead(rng_.uniform(1.5, 2.2) + speed);
    if (floor_.clearance(place) < 0.3 || !floor_.is_clear(person.position, place, 0.2)) return;
    person.activity = blocks ? Activity::block : Activity::curious;
    person.until = now + (blocks ? rng_.uniform(45.0, 180.0) : rng_.uniform(3.0, 15.0));
    person.goal = place;
    person.has_arrived = false;
    return;
  }
  if (happens(params_.wall_rate) && count_of(Activity::wall) == 0) form_wall(index, now);
}

void Crowd::form_wall(std::size_t leader, double now) {
  const Point2 centre = robot_ahead(rng_.uniform(2.0, 2.8) + norm(robot_.velocity));
  const Point2 ahead = robot_ahead(1.0) - robot_.position;
  const Point2 across{-ahead.y, ahead.x};
  const double until = now + rng_.uniform(10.0, 40.0);
  const auto wanted = rng_.integer(3, 5);
  std::int64_t placed = 0;
  const auto join = [&](Person& person) {
    // Places from the middle outwards: 0, 1, -1, 2, -2 ...
    const double slot = static_cast<double>((placed + 1) / 2) * (placed % 2 == 1 ? 1.0 : -1.0);
    const Point2 place = centre + (0.55 * slot) * across;
    if (floor_.clearance(place) < 0.27 || !floor_.is_clear(person.position, place, 0.15)) return;
    person.activity = Activity::wall;
    person.until = until + rng_.uniform(0.0, 3.0);
    person.goal = place;
    person.has_arrived = false;
    ++placed;
  };
  join(people_[leader]);
  for (const std::uint32_t i : outlines_within(centre, 4.0)) {
    Person& person = people_[outlines_[i].person];
    if (outlines_[i].person == leader || placed == 0 || placed >= wanted) continue;
    if (person.activity == Activity::stroll || person.activity == Activity::look) join(person);
  }
}

void Crowd::hear_horn(double now) {
  for (Person& person : people_) {
    if (!is_meant(person, params_.horn_range, 1.5)) continue;
    const double effect = person.heeds >= 0.0                  ? person.heeds
                          : person.activity == Activity::block ? params_.horn_effect_block
                          : person.activity == Activity::wall  ? params_.horn_effect_wall
                          : person.activity == Activity::push  ? params_.horn_effect_wall
                          : person.activity == Activity::press ? params_.horn_effect_block
                          : person.activity == Activity::stand ? params_.horn_effect_block
                                                               : params_.horn_effect;
    person.back_turned = false;
    if (rng_.chance(effect)) person.reacts_at = now + rng_.uniform(params_.reaction_time, 1.6);
  }
}

bool Crowd::is_meant(const Person& person, double range, double near) const {
  const Point2 from_robot = person.position - robot_.position;
  const double away = norm(from_robot);
  if (away > range || person.ignores_robot || person.activity == Activity::recorded ||
      person.activity == Activity::romp)
    return false;
  return away <= near || dot(from_robot, unit(Angle::radians(robot_.heading))) > 0.2 * away;
}

void Crowd::hear_request(double now) {
  const double by_mood = 1.0 - params_.mood_effect * valence_;
  for (Person& person : people_) {
    if (!is_meant(person, params_.ask_range, 1.0)) continue;
    const bool stands_firm = person.activity == Activity::curious || person.activity == Activity::block ||
                             person.activity == Activity::wall || person.activity == Activity::push ||
                             person.activity == Activity::press || person.activity == Activity::stand;
    const double effect = person.heeds >= 0.0 ? person.heeds
                          : stands_firm       ? by_mood * params_.ask_effect_firm
                                              : by_mood * params_.ask_effect;
    person.back_turned = false;
    if (rng_.chance(effect)) person.reacts_at = now + rng_.uniform(params_.reaction_time, 1.6);
  }
}

void Crowd::look_at_face(Person& person, const Sight& sight, double now) {
  if (valence_ >= 0.0 || !sight.in_sight || person.heeds >= 0.0 || person.back_turned ||
      person.activity == Activity::step_aside || !is_meant(person, kInItsWay, 0.0))
    return;
  if (std::abs(cross(unit(Angle::radians(robot_.heading)), sight.offset)) > robot_.radius + person.radius + 0.2) return;
  if (rng_.chance(-valence_ * params_.face_rate * kDecisionPeriod)) step_aside(person, sight, now);
}

void Crowd::step_aside(Person& person, const Sight& sight, double now) {
  const Point2 heading = unit(Angle::radians(robot_.heading));
  const Point2 from_robot = Point2{} - sight.offset;
  const double lateral = cross(heading, from_robot);
  const double side = std::abs(lateral) > 0.05 ? (lateral > 0.0 ? 1.0 : -1.0) : person.side;
  const Point2 left{-heading.y, heading.x};
  // To the nearer side, else the other, else back: whichever has room.
  const Point2 ways[] = {side * left, -side * left, heading};
  for (const Point2 way : ways) {
    person.goal = way;
    if (floor_.is_clear(person.position, person.position + 0.9 * way, 0.2)) break;
  }
  const bool comes_back = rng_.chance(params_.horn_reward);
  person.activity = Activity::step_aside;
  person.until = now + rng_.uniform(4.0, 8.0);
  person.has_arrived = false;
  person.bored_until = now + (comes_back ? 6.0 : rng_.uniform(20.0, 90.0));
}

void Crowd::draw_people_near(double now) {
  std::size_t near = 0;
  Person* candidate = nullptr;
  double nearest = 1e9;
  for (Person& person : people_) {
    const double away = distance(person.position, robot_.position);
    if (away <= kNearRobot || person.activity == Activity::follow) {
      ++near;
    } else if ((person.activity == Activity::stroll || person.activity == Activity::look) && away < nearest) {
      nearest = away;
      candidate = &person;
    }
  }
  if (candidate == nullptr || static_cast<double>(near) >= params_.near_share * static_cast<double>(people_.size()))
    return;
  candidate->activity = Activity::follow;
  candidate->until = now + nearest + rng_.uniform(40.0, 150.0);
  candidate->keeps_distance = rng_.uniform(0.45, 3.5);
}

}  // namespace docent::simulator
