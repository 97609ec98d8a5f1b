#include "docent/simulator/crowd/crowd.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace docent::simulator {
namespace {

constexpr double kNeighbourCell = 1.5;      // [m] of the neighbour search
constexpr double kWallGap = 0.26;           // [m] no centre comes nearer to a wall, however broad the person
constexpr double kPersonalRobotGap = 0.05;  // [m] nobody walks nearer to the robot, but those who push or do not look
constexpr double kSimulationStep = 0.02;    // [s]
constexpr double kEntersAway = 2.5;         // [m] between the outlines: no recorded person appears nearer to the robot
constexpr double kHurry = 3.0;              // [m/s] at most, of a recorded person who was pushed off their track

}  // namespace

std::optional<double> crowd_density(std::string_view level) {
  if (level == "empty") return 0.0;
  if (level == "quiet") return 0.02;
  if (level == "busy") return 0.08;
  if (level == "packed") return 0.2;
  return std::nullopt;
}

Crowd::Crowd(const World& world, WalkableFloor floor, const CrowdParams& params, std::size_t count, Rng rng,
             const RobotView& robot)
    : world_{world},
      params_{params},
      rng_{rng},
      physique_rng_{rng.stream("physique")},
      floor_{std::move(floor)},
      replay_{count > 0 ? world.pedestrians : std::vector<Recording>{}, rng.stream("replay")},
      robot_{robot} {
  fields_.resize(world_.attractions.size() + world_.entrances.size());
  Point2 high{};
  if (!world_.floor.empty()) cells_low_ = high = world_.floor.front();
  for (const Point2 corner : world_.floor) {
    cells_low_ = {std::min(cells_low_.x, corner.x), std::min(cells_low_.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  cell_columns_ = static_cast<int>((high.x - cells_low_.x) / kNeighbourCell) + 1;
  cell_rows_ = static_cast<int>((high.y - cells_low_.y) / kNeighbourCell) + 1;
  let_recorded_in(0.0, robot);
  const auto recorded = static_cast<std::size_t>(std::lround(mean_people(world.pedestrians)));
  const std::size_t others = count - std::min(count, recorded);
  for (std::size_t i = 0; i < others; ++i) {
    people_.push_back(new_person(0.0));
    Person& person = people_.back();
    // Those of the start came at different times.
    person.leaves_at = rng_.uniform(60.0, params_.stay_max);
    place_anywhere(person, robot, static_cast<double>(i) < params_.near_share * static_cast<double>(count));
  }
  sort_into_cells();
}

Person Crowd::new_person(double now) {
  Person person;
  person.id = next_id_++;
  if (next_group_left_ == 0) {
    groups_.push_back({});
    next_group_left_ = static_cast<int>(rng_.integer(1, 4));
  }
  --next_group_left_;
  person.group = static_cast<int>(groups_.size()) - 1;
  person.is_child = rng_.chance(params_.child_share);
  if (person.is_child) {
    person.radius = rng_.uniform(0.15, 0.18);
    person.height = rng_.uniform(0.95, 1.35);
    person.preferred_speed = rng_.uniform(0.8, 1.3);
  } else {
    person.radius = rng_.uniform(0.22, 0.28);
    person.height = rng_.uniform(1.55, 1.95);
    person.preferred_speed = rng_.uniform(0.6, 1.4);
  }
  person.side = rng_.chance(0.5) ? 1.0 : -1.0;
  person.leaves_at = now + rng_.uniform(params_.stay_min, params_.stay_max);
  person.bored_until = now + rng_.uniform(0.0, 40.0);
  person.progress_at = now;
  person.ignores_robot = params_.ignoring_share > 0.0 && rng_.chance(params_.ignoring_share);
  if (params_.heedless_share > 0.0 && rng_.chance(params_.heedless_share))
    person.ignores_robot = person.is_heedless = true;
  build(person);
  return person;
}

void Crowd::build(Person& person) {
  constexpr double kOnWheels = 0.9;  // [m/s] with a pram, or in a wheelchair
  person.physique = draw_physique(params_.physique, {person.is_child, person.height, person.radius}, physique_rng_);
  person.radius = room_of(person.physique, person.radius);
  if (person.physique.aid == Aid::pram || person.physique.aid == Aid::wheelchair)
    person.preferred_speed = std::min(person.preferred_speed, kOnWheels);
  if (params_.physique.bodies == Bodies::legs)
    person.gait = Gait{unit(Angle::radians(physique_rng_.uniform(-std::numbers::pi, std::numbers::pi)))};
}

void Crowd::place_anywhere(Person& person, const RobotView& robot, bool near_robot) {
  std::optional<Point2> place;
  for (int attempt = 0; attempt < 400; ++attempt) {
    const auto point = floor_.random_point(rng_, 0.35);
    if (!point) break;
    place = point;
    const double away = distance(*point, robot.position);
    if (away < 1.2 || (near_robot && away > 5.0)) continue;
    const bool is_taken = std::any_of(people_.begin(), people_.end(), [&](const Person& other) {
      return &other != &person && distance(other.position, *point) < 0.6;
    });
    if (!is_taken) break;
  }
  person.position = person.progress_from = place.value_or(robot.position + Point2{3.0, 0.0});
}

void Crowd::enter(Person& person) {
  const auto door = static_cast<std::size_t>(rng_.integer(0, static_cast<std::int64_t>(world_.entrances.size()) - 1));
  const Point2 entrance = world_.entrances[door];
  for (int attempt = 0; attempt < 30; ++attempt) {
    const Point2 point = entrance + Point2{rng_.uniform(-1.5, 1.5), rng_.uniform(-1.5, 1.5)};
    if (!floor_.is_reachable(point) || floor_.clearance(point) < 0.3) continue;
    if (distance(point, robot_.position) < 1.5) continue;
    person.position = person.progress_from = point;
    return;
  }
  // The door is beset: they come in elsewhere, out of the robot's sight.
  place_anywhere(person, robot_, false);
}

void Crowd::let_recorded_in(double now, const RobotView& robot) {
  replay_.begin(now, waiting_);
  // A person who would appear right before the robot comes in a little later on their way, or not at all.
  std::erase_if(waiting_, [&](const Walk& walk) {
    if (replay_.is_over(walk, now)) return true;
    const Point2 place = replay_.at(walk, now);
    if (distance(place, robot.position) < robot_.radius + kRecordedRadius + kEntersAway) return false;
    Person person;
    person.id = next_id_++;
    person.is_extra = true;
    person.activity = Activity::recorded;
    person.radius = kRecordedRadius;
    build(person);
    person.walk = walk;
    person.position = person.progress_from = place;
    people_.push_back(person);
    return true;
  });
}

void Crowd::add_standing(std::span<const Point2> places, double until, std::optional<double> heeds) {
  for (const Point2 place : places) {
    if (floor_.clearance(place) < 0.2 || distance(place, robot_.position) < robot_.radius + 0.3) continue;
    Person person = new_person(0.0);
    person.is_extra = true;
    person.activity = Activity::stand;
    person.position = person.goal = person.progress_from = place;
    person.until = until;
    person.leaves_at = until + rng_.uniform(5.0, 60.0);
    person.heeds = heeds.value_or(-1.0);
    people_.push_back(person);
  }
}

Point2 Crowd::place_near(Point2 centre, double within) {
  for (int attempt = 0; attempt < 200; ++attempt) {
    const Point2 place = centre + rng_.uniform(0.0, within) * unit(Angle::radians(rng_.uniform(-3.14, 3.14)));
    if (floor_.clearance(place) < 0.3 || distance(place, robot_.position) < robot_.radius + 0.5) continue;
    const bool is_taken = std::any_of(people_.begin(), people_.end(),
                                      [&](const Person& other) { return distance(other.position, place) < 0.55; });
    if (!is_taken) return place;
  }
  return centre;
}

void Crowd::add_pushers(int count, Point2 at, double heading, double until) {
  constexpr double kHalfRing = 1.1;  // [rad] to each side
  for (int i = 0; i < count; ++i) {
    Person person = new_person(0.0);
    person.is_extra = true;
    person.activity = Activity::press;
    const double share = count > 1 ? 2.0 * i / (count - 1) - 1.0 : 0.0;
    person.slot = heading + std::numbers::pi + kHalfRing * share;
    person.position = person.progress_from = place_near(at, 1.2);
    person.until = until;
    person.leaves_at = until + rng_.uniform(5.0, 60.0);
    people_.push_back(person);
  }
}

void Crowd::add_runners(int count, Point2 at, double within, double until) {
  for (int i = 0; i < count; ++i) {
    Person person = new_person(0.0);
    person.is_extra = person.is_child = true;
    person.radius = rng_.uniform(0.15, 0.18);
    person.height = rng_.uniform(0.95, 1.35);
    person.preferred_speed = rng_.uniform(1.4, 1.9);
    build(person);
    person.activity = Activity::romp;
    person.home = at;
    person.ground = within;
    person.position = person.progress_from = place_near(at, within);
    person.until = until;
    person.leaves_at = until + rng_.uniform(5.0, 60.0);
    people_.push_back(person);
  }
}

void Crowd::add_escort(int count, double near, double far, double now, double until) {
  constexpr double kOpenAhead = 0.75;  // [rad] to each side
  for (int i = 0; i < count; ++i) {
    Person person = new_person(now);
    person.is_extra = true;
    person.activity = Activity::escort;
    const double share = (i + rng_.uniform(0.3, 0.7)) / count;
    person.slot = kOpenAhead + share * 2.0 * (std::numbers::pi - kOpenAhead);
    person.keeps_distance = rng_.uniform(near, far);
    person.preferred_speed = std::max(person.preferred_speed, 1.0);
    person.until = until;
    person.leaves_at = until + rng_.uniform(5.0, 60.0);
    person.attention_until = 1e9;  // they came for the robot
    const Angle bearing = Angle::radians(robot_.heading + person.slot);
    person.position = robot_.position + (robot_.radius + person.radius + person.keeps_distance) * unit(bearing);
    if (floor_.clearance(person.position) < 0.26 || !floor_.is_clear(robot_.position, person.position, 0.0))
      place_anywhere(person, robot_, true);
    person.progress_from = person.position;
    people_.push_back(person);
  }
}

void Crowd::change_world(const World& world) {
  world_.solids = world.solids;
  floor_ = WalkableFloor{world_};
  for (Person& person : people_) person.room = 0.0;
  for (FlowField& field : fields_) field.clear();
  robot_field_.clear();
  robot_field_at_ = -1e9;
}

void Crowd::sort_into_cells() {
  const auto cell_of = [&](const Person& person) {
    const Point2 place = person.position - cells_low_;
    const int column = std::clamp(static_cast<int>(place.x / kNeighbourCell), 0, cell_columns_ - 1);
    const int row = std::clamp(static_cast<int>(place.y / kNeighbourCell), 0, cell_rows_ - 1);
    return static_cast<std::size_t>(row * cell_columns_ + column);
  };
  cell_begin_.assign(static_cast<std::size_t>(cell_columns_ * cell_rows_) + 1, 0);
  cell_of_.clear();
  for (const Person& person : people_) {
    cell_of_.push_back(static_cast<std::uint32_t>(cell_of(person)));
    ++cell_begin_[cell_of_.back()];
  }
  std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());  // where cells end
  outlines_.resize(people_.size());
  for (std::size_t i = people_.size(); i-- > 0;) {
    const Person& person = people_[i];
    outlines_[--cell_begin_[cell_of_[i]]] = {person.position, person.velocity, person.radius, i};
  }
}

void Crowd::step(double now, double dt, const RobotView& robot) {
  now_ = now;
  seen_[seen_count_++ % seen_.size()] = robot;
  const auto delay = std::min(static_cast<std::size_t>(params_.reaction_time / kSimulationStep),
                              std::min(seen_count_, seen_.size()) - 1);
  robot_ = seen_[(seen_count_ - 1 - delay) % seen_.size()];
  robot_.position = robot_.position + (static_cast<double>(delay) * kSimulationStep) * robot_.velocity;

  sort_into_cells();
  constexpr std::size_t kDecisionSteps = 5;
  constexpr double kFarOff = 12.0;  // [m] no sensor reaches there: they decide half as often
  const std::uint64_t first = (kDecisionSteps - steps_ % kDecisionSteps) % kDecisionSteps;
  for (std::size_t i = first; i < people_.size(); i += kDecisionSteps) {
    const bool is_far = distance(people_[i].position, robot.position) > kFarOff;
    if (!is_far || (steps_ + i) % (2 * kDecisionSteps) == 0) decide(i, now);
  }
  if (steps_ % 50 == 0 && params_.near_share > 0.0) draw_people_near(now);
  for (std::size_t i = 0; i < people_.size(); ++i) {
    if (people_[i].activity == Activity::recorded) {
      follow_track(people_[i], now, dt);
    } else {
      move(i, dt, robot);
    }
  }

  // A person who has left makes room for another; one who was put there by a scenario just goes.
  const auto has_left = [](const Person& person) { return person.activity == Activity::leave && person.has_arrived; };
  const auto gone = std::erase_if(people_, [&](const Person& person) { return person.is_extra && has_left(person); });
  for (Person& person : people_) {
    if (gone > 0) person.near_count = 0;  // indices of others have changed
    if (!has_left(person)) continue;
    Person other = new_person(now);
    enter(other);
    person = other;
  }
  let_recorded_in(now, robot);
  ++steps_;
}

void Crowd::follow_track(Person& person, double now, double dt) const {
  if (replay_.is_over(person.walk, now)) {
    person.activity = Activity::leave;
    person.has_arrived = true;
    return;
  }
  const Point2 way = replay_.at(person.walk, now) - person.position;
  const double length = norm(way);
  const Point2 step = length > kHurry * dt ? (kHurry * dt / length) * way : way;
  person.velocity = person.wanted = (1.0 / dt) * step;
  if (params_.physique.bodies == Bodies::legs) person.gait.walk(person.velocity, dt, person.physique);
  person.position = person.position + step;
}

void Crowd::keep_off(Person& person, Point2& next, const RobotView& robot) const {
  const double most = robot.radius + person.physique.reach + kPersonalRobotGap;
  const Point2 from_robot = next - robot.position;
  if (dot(from_robot, from_robot) > 1.01 * most * most) return;  // no root for most
  const double away = norm(from_robot);
  const double least =
      away > 1e-6 ? robot.radius + reach_to(person, (-1.0 / away) * from_robot) + kPersonalRobotGap : most;
  const bool walks_into_it = person.activity == Activity::push || ignores_robot(person) ||
                             person.activity == Activity::press || person.activity == Activity::romp ||
                             (person.is_inattentive && dot(person.velocity, from_robot) < -0.2 * away);
  if (walks_into_it || away <= 1e-6 || away >= least) return;
  const double before = distance(person.position, robot.position);
  if (away >= before) return;
  next = robot.position + (before / away) * from_robot;
  const Point2 outward = (1.0 / away) * from_robot;
  const double inward = std::min(0.0, dot(person.velocity, outward));
  person.velocity = person.velocity - inward * outward;
}

void Crowd::move(std::size_t index, double dt, const RobotView& robot) {
  Person& person = people_[index];
  const Point2 change = person.wanted - person.velocity;
  const double limit = (dot(change, person.velocity) < 0.0 ? params_.braking : params_.acceleration) * dt;
  const double size = norm(change);
  person.velocity = size > limit ? person.velocity + (limit / size) * change : person.wanted;
  if (params_.physique.bodies == Bodies::legs) person.gait.walk(person.velocity, dt, person.physique);

  Point2 next = person.position + dt * person.velocity;
  for (int k = 0; k < person.near_count; ++k) {
    const Person& other = people_[person.near[static_cast<std::size_t>(k)]];
    const Point2 apart = next - other.position;
    const double reach = person.radius + other.radius;
    if (dot(apart, apart) >= reach * reach) continue;
    const double away = norm(apart);
    const double overlap = reach - away;
    // Shoulders give: people in a throng slide past each other, not through.
    if (overlap > 0.0 && away > 1e-6) next = next + (std::min(0.5 * overlap, 0.5 * dt) / away) * apart;
  }
  keep_off(person, next, robot);
  const double need = std::min(person.radius, kWallGap);
  const Point2 since = next - person.roomy_at;
  // The clearance falls by less than 1.5 m a metre: where there was room enough, walls need not be looked for.
  if (2.25 * dot(since, since) < person.room * person.room) {
    person.position = next;
    return;
  }
  const double gap = floor_.clearance(next);
  person.roomy_at = next;
  person.room = std::max(0.0, gap - need);
  if (gap < need) {
    const Point2 outward = floor_.away_from_walls(next);
    next = next + (need - gap) * outward;
    const double inward = std::min(0.0, dot(person.velocity, outward));
    person.velocity = person.velocity - inward * outward;
    if (floor_.clearance(next) < need - 0.02 && floor_.clearance(next) < floor_.clearance(person.position)) {
      next = person.position;
      person.velocity = {};
    }
  }
  person.position = next;
}

double Crowd::give_way(std::size_t index, Point2 robot, double reach) {
  Person& person = people_[index];
  const Point2 apart = person.position - robot;
  const double away = norm(apart);
  if (away >= reach) return 0.0;
  const Point2 outward = away > 1e-6 ? (1.0 / away) * apart : Point2{1.0, 0.0};
  const Point2 place = robot + reach * outward;
  const double inward = std::min(0.0, dot(person.velocity, outward));
  person.velocity = person.velocity - inward * outward;
  person.is_inattentive = false;      // that was noticed
  constexpr double kRemembers = 3.0;  // [s]
  person.bumped_until = now_ + kRemembers;
  if (floor_.clearance(place) < std::min({person.radius, kWallGap, floor_.clearance(person.position)})) {
    return reach - away;
  }
  person.position = place;
  return 0.0;
}

}  // namespace docent::simulator
