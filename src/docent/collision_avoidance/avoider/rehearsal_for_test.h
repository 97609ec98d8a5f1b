#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/random.h"
#include "docent/collision_avoidance/avoider/avoider.h"
#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance {

/// A walker in a straight line; stops at the robot's outline instead of walking through it.
struct RehearsalPerson {
  Point2 place;
  Point2 velocity{};
  double radius = 0.22;
};

/// A small world for tests: walls, walkers, a base with latency and limited accelerations, two noisy lasers, virtual
/// measurements of hazards that the lasers do not see. Steps of 10 ms.
class Rehearsal {
 public:
  explicit Rehearsal(std::uint64_t seed = 1, const AvoiderParams& params = without_sonar(),
                     const std::vector<std::string>& lasers = {"front laser", "rear laser"},
                     std::unique_ptr<LocalPlanner> planner = nullptr)
      : avoider{limits, params, lasers, std::move(planner)}, rng_{seed}, has_rear_{lasers.size() > 1} {}

  static AvoiderParams without_sonar() {
    AvoiderParams params;
    params.needs_sonar = false;
    return params;
  }

  BaseLimits limits;
  Avoider avoider;
  std::vector<Segment> walls;
  std::vector<Segment> hazards;
  std::vector<RehearsalPerson> people;
  double noise = 0.02;  ///< [m] of the lasers, one standard deviation
  bool front_works = true, rear_works = true, odometry_works = true, virtual_works = true, target_works = true;
  bool checks_choices = false;              ///< whatever was chosen is checked at once, as the module does
  bool front_repeats = false;               ///< the front laser gives its last sweep again and again
  double blind_from = 0.0, blind_to = 0.0;  ///< [rad] base frame: the front laser gives this there:
  float blind_range = std::numeric_limits<float>::quiet_NaN();
  double front_missing = 0.0;                                     ///< share of the front laser's readings that are none
  std::function<void(SensorSweep&)> spoil = [](SensorSweep&) {};  ///< done to what both lasers say
  std::function<void(VirtualSweep&)> remeasure = [](VirtualSweep&) {};  ///< done to what was measured virtually
  bool virtual_is_nan = false;                                          ///< one of the virtual measurements
  double sensor_clock = 0.0;    ///< [s] before ours, of the lasers' computer, which localizes
  double odometry_clock = 0.0;  ///< [s] of the base's
  Pose2 raw_from_map;           ///< what the odometry has made of the map: a change is a jump
  AvoiderTarget target;
  std::optional<HandSteering> hand;  ///< of an operator, ten times a second

  // What happened.
  Pose2 map_from_base;
  Velocity velocity;
  Time now{};
  double driven = 0.0;
  double top_speed = 0.0;
  double least_wall = std::numeric_limits<double>::infinity();  ///< [m] outline to walls and hazards
  double worst_push = 0.0;                                      ///< [m/s] greatest speed towards a person when touching
  double last_speed_change = 0.0;
  AvoiderDecision decision;

  void box(double x0, double y0, double x1, double y1) {
    walls.push_back({{x0, y0}, {x1, y0}});
    walls.push_back({{x1, y0}, {x1, y1}});
    walls.push_back({{x1, y1}, {x0, y1}});
    walls.push_back({{x0, y1}, {x0, y0}});
  }

  void drive_to(std::vector<Point2> via) {
    target.mode = AvoiderTarget::Mode::drive;
    target.via = std::move(via);
    target.is_final = true;
  }

  void run(double duration) {
    const Time end = now + seconds(duration);
    while (now < end) step();
  }
  /// True when the last via-point was reached within `timeout`.
  bool run_until_arrived(double timeout) {
    const Time end = now + seconds(timeout);
    while (now < end) {
      step();
      if (distance(map_from_base.position(), target.via.back()) < target.position_tolerance &&
          std::abs(velocity.linear) < 0.02) {
        return true;
      }
    }
    return false;
  }

 private:
  void step() {
    constexpr double kStep = 0.01;
    now = now + seconds(kStep);
    ++ticks_;
    move_base(kStep);
    move_people(kStep);
    judge();
    if (ticks_ % 5 == 0 && odometry_works)
      avoider.add_odometry(now, now + seconds(odometry_clock), {raw_from_map * map_from_base, velocity});
    if (ticks_ % 10 == 0) {
      if (front_works) see(0, 0.0);
      if (rear_works && has_rear_) see(1, std::numbers::pi);
    }
    if (ticks_ % 20 == 0 && virtual_works) see_virtually();
    if (ticks_ % 20 == 5 && target_works) avoider.set_target(now, now, target_in_raw());
    if (ticks_ % 10 == 7 && hand) avoider.steer_by_hand(now, *hand);
    if (ticks_ % 25 == 3) {
      give(avoider.decide(now));
      if (!checks_choices) return;
      if (auto made = avoider.reflex(now)) give(*made);
    }
  }

  [[nodiscard]] AvoiderTarget target_in_raw() const {
    AvoiderTarget result = target;
    for (Point2& via : result.via) via = raw_from_map * via;
    result.heading = raw_from_map.theta + target.heading;
    return result;
  }

  void give(const AvoiderDecision& made) {
    decision = made;
    commands_.add(now, made.command);
  }

  void move_base(double dt) {
    const BaseState next = advance({map_from_base, velocity}, commands_.at(now - seconds(limits.latency)), limits, dt);
    driven += distance(next.odom_from_base.position(), map_from_base.position());
    map_from_base = next.odom_from_base;
    velocity = next.velocity;
    top_speed = std::max(top_speed, velocity.linear);
  }

  void move_people(double dt) {
    for (auto& person : people) {
      const Point2 next = person.place + dt * person.velocity;
      const Point2 offset = next - map_from_base.position();
      if (norm(offset) < limits.radius + person.radius) {
        const double towards = velocity.linear * dot(unit(map_from_base.theta), (1.0 / norm(offset)) * offset);
        worst_push = std::max(worst_push, towards);
        if (dot(person.velocity, offset) < 0.0) continue;
      }
      person.place = next;
    }
  }

  void judge() {
    for (const auto* set : {&walls, &hazards}) {
      for (const auto& wall : *set) {
        least_wall = std::min(least_wall, distance(wall, map_from_base.position()) - limits.radius);
      }
    }
  }

  void see(std::size_t sensor, double heading) {
    SensorSweep sweep{now + seconds(sensor_clock),
                      {0.0, 0.0, Angle::radians(heading)},
                      -0.5 * std::numbers::pi + 0.5 * kBeam,
                      kBeam,
                      0.02,
                      10.0,
                      {}};
    const Pose2 map_from_sensor = map_from_base * sweep.base_from_sensor;
    for (int i = 0; i < 180; ++i) {
      const Angle bearing = Angle::radians(sweep.first_bearing + i * kBeam);
      const Point2 direction = unit(map_from_sensor.theta + bearing);
      double range = sweep.max_range;
      for (const auto& wall : walls) {
        if (const auto hit = ray_distance(map_from_base.position(), direction, wall)) range = std::min(range, *hit);
      }
      for (const auto& person : people) {
        if (const auto hit = ray_distance(map_from_base.position(), direction, person.place, person.radius)) {
          range = std::min(range, *hit);
        }
      }
      if (range < sweep.max_range) range = std::max(0.05, range + rng_.normal(0.0, noise));
      const double in_base = (sweep.base_from_sensor.theta + bearing).radians();
      if (sensor == 0 && in_base > blind_from && in_base < blind_to) range = blind_range;
      if (sensor == 0 && front_missing > 0.0 && rng_.chance(front_missing)) range = std::nanf("");
      sweep.ranges.push_back(static_cast<float>(range));
    }
    if (sensor == 0 && front_repeats && !last_front_.empty()) sweep.ranges = last_front_;
    if (sensor == 0) last_front_ = sweep.ranges;
    spoil(sweep);
    avoider.add_sweep(now, sensor, sweep);
    if (auto made = avoider.reflex(now)) give(*made);
  }

  void see_virtually() {
    VirtualSweep sweep{now + seconds(sensor_clock), -std::numbers::pi, std::numbers::pi / 90.0, 6.0, {}};
    for (int i = 0; i < 180; ++i) {
      const Angle bearing = Angle::radians(sweep.first_bearing + i * sweep.bearing_step);
      double range = sweep.max_range;
      for (const auto& hazard : hazards) {
        const auto hit = ray_distance(map_from_base.position(), unit(map_from_base.theta + bearing), hazard);
        if (hit) range = std::min(range, *hit);
      }
      sweep.ranges.push_back(static_cast<float>(range));
    }
    remeasure(sweep);
    if (virtual_is_nan) sweep.ranges[7] = std::nanf("");
    avoider.add_virtual(now, sweep);
  }

  static constexpr double kBeam = std::numbers::pi / 180.0;
  Rng rng_;
  bool has_rear_;
  CommandHistory commands_;
  std::vector<float> last_front_;
  long ticks_ = 0;
};

}  // namespace docent::collision_avoidance
