#include "docent/collision_avoidance/avoider/avoider.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "docent/geometry/polygon.h"

namespace docent {

namespace {

constexpr double kLeastReach = 3.5;       // [m] obstacles farther away do not matter to a slow robot within one cycle
constexpr double kStepsIn = 2.5;          // [m] at walking speed
constexpr double kBySomebody = 0.4;       // [m] from a beam that the map does not explain
constexpr double kJudgedTogether = 0.15;  // [s]
constexpr double kStillJudged = 0.6;      // [s] until what came into view since counts for more
constexpr double kFastWalk = 1.5;         // [m/s] of who may come towards the robot
constexpr double kNearlyAll = 0.9;        // of a sweep's readings: the sensor is covered or has failed
constexpr double kManyMissing = 0.35;     // of a sweep's readings
constexpr double kCameraPatience = 1.5;   // [s]
constexpr double kStandsTouched = 1.0;    // [s] after a touch
constexpr double kFlinches = 0.4;         // [s] then it may leave who touched it: away from them, nobody minds
constexpr double kElsewhere = 0.8;        // [rad] from the touch before: another one
constexpr double kNearThing = 1.0;        // [m] from the body to where a thing touched it that no sensor sees: it is
constexpr double kDent = 0.03;            // [m] into the body: what touches it there is pressed, deeper it is not there
constexpr double kFeelsItsWay = 0.15;     // [m/s] larger than the place, and only another touch tells how much
constexpr double kBegins = 0.04;          // [m] of a way; one that is shorter is none
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Nothing is inside the robot: whoever was foreseen there has come up to its outline, on the way that they came.
Point2 stopped_at_outline(Point2 at, Point2 velocity, const BaseLimits& limits) {
  constexpr double kStep = 0.02;     // [m]
  constexpr double kFarthest = 0.6;  // [m]
  const double speed = norm(velocity);
  for (double back = 0.0; speed > 0.0 && back < kFarthest; back += kStep) {
    const Point2 before = at - (back / speed) * velocity;
    if (limits.gap_to(before) >= 0.0) return before;
  }
  return limits.edge(Angle::radians(std::atan2(at.y, at.x)));
}

}  // namespace

Result<void> AvoiderParams::validate() const {
  if (auto valid = window.validate(); !valid) return valid;
  if (!(lookahead >= 0.3 && lookahead <= 5.0)) return fail("avoid.lookahead must lie between 0.3 and 5 m");
  if (!(lookahead_time >= 0.0 && lookahead_time <= 5.0)) return fail("avoid.lookahead_time must lie in 0..5 s");
  if (auto valid = people.validate(); !valid) return valid;
  if (method != "cautious_window" && method != "dynamic_window")
    return fail("avoid.method must be cautious_window or dynamic_window");
  if (!(seen_for >= 0.0 && seen_for <= 60.0)) return fail("avoid.seen_for must lie in 0..60 s");
  if (!(arrival_deceleration > 0.0)) return fail("avoid.arrival_deceleration must be > 0 m/s2");
  if (!(target_timeout > 0.0 && virtual_timeout > 0.0)) return fail("avoid: timeouts must be > 0 s");
  return {};
}

Avoider::Avoider(const BaseLimits& limits, const AvoiderParams& params, std::vector<std::string> lasers)
    : limits_{limits},
      params_{params},
      lasers_{std::move(lasers)},
      window_{limits, params.window},
      seen_{params.seen_for},
      max_speed_{std::min(0.7, limits.max_speed)},
      sweep_freshness_(lasers_.size()),
      odometry_watch_{limits} {}

void Avoider::add_odometry(Time now, Time stamp, const BaseState& state) {
  const Time taken = local_time_.receive("odometry", now, stamp);
  const auto unbroken = unbroken_.add(taken, state.odom_from_base);
  odometry_watch_.receive(now, stamp, state, unbroken.jumped, commands_);
  // A base that derives its velocity from its pose says nonsense in a jump.
  const bool keeps = unbroken.jumped && !odometry_.empty();
  odometry_.add(taken, {unbroken.odom_from_base, keeps ? odometry_.newest().velocity : state.velocity});
}

void Avoider::add_sweep(Time now, std::size_t sensor, SensorSweep sweep) {
  if (sensor >= lasers_.size() || odometry_.empty()) return;
  sweep_freshness_[sensor].receive(now, sweep.stamp);
  sweep.stamp = local_time_.receive("laser " + std::to_string(sensor), now, sweep.stamp);
  const Pose2 odom_from_base = odometry_.pose_at(sweep.stamp);
  memory_.add_sweep(sensor, sweep, odom_from_base);
  seen_.add(sensor, std::move(sweep), odom_from_base);
}

void Avoider::add_sonar(Time now, std::size_t index, SonarReading reading) {
  if (odometry_.empty()) return;
  const Time stamp = std::exchange(reading.stamp, local_time_.receive("sonars", now, reading.stamp));
  const Pose2 odom_from_base = odometry_.pose_at(reading.stamp);
  sonar_watch_.hear(now, stamp, index, reading.range, reading.range < reading.max_range, odom_from_base);
  memory_.add_sonar(index, reading, odom_from_base);
}

void Avoider::add_infrared(Time now, std::size_t index, SonarReading reading) {
  if (odometry_.empty()) return;
  const Time stamp = std::exchange(reading.stamp, local_time_.receive("infrared", now, reading.stamp));
  const Pose2 odom_from_base = odometry_.pose_at(reading.stamp);
  infrared_watch_.hear(now, stamp, index, reading.range, reading.range < reading.max_range, odom_from_base);
  memory_.add_infrared(index, reading, odom_from_base);
}

void Avoider::add_lines(Time now, Time stamp, const std::string& source, double lifetime,
                        std::span<const Segment> in_base) {
  if (odometry_.empty()) return;
  line_freshness_[source].receive(now, stamp);
  const Time taken = local_time_.receive("camera " + source, now, stamp, LocalTime::kWayOfAPicture);
  memory_.add_lines(source, taken, lifetime, in_base, odometry_.pose_at(taken));
}

void Avoider::add_tactile(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan) {
  tactile_watch_.feel(now, stamp, segments, scan);
  if (odometry_.empty()) return;
  const Time taken = local_time_.receive("tactile", now, stamp);
  memory_.stand(odometry_.pose_at(taken).position(), limits_.inradius() - kDent);
  const double step = 2.0 * std::numbers::pi / static_cast<double>(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i] == 0 || segments[i] == TactileWatch::kNoReading) continue;
    const Angle bearing = Angle::radians(step * static_cast<double>(i));
    const Angle in_odom = odometry_.newest().odom_from_base.theta + bearing;
    const bool is_new = !touched_ || now - *touched_ > seconds(kStandsTouched) ||
                        std::abs((in_odom - touched_from_).radians()) > kElsewhere;
    if (is_new) {
      touched_since_ = now;
      touched_from_ = in_odom;
    }
    touched_ = now;
    memory_.add_touch(taken, limits_.edge(bearing), odometry_.pose_at(taken));
  }
}

void Avoider::add_virtual(Time now, VirtualSweep sweep) {
  const auto is_unfit = [](float range) { return std::isnan(range); };
  if (odometry_.empty() || std::any_of(sweep.ranges.begin(), sweep.ranges.end(), is_unfit)) return;
  virtual_freshness_.receive(now, sweep.stamp);
  sweep.stamp = local_time_.receive_handed_on("virtual", now, sweep.stamp);
  odom_from_virtual_ = odometry_.pose_at(sweep.stamp);
  virtual_ = std::move(sweep);
}

void Avoider::add_person_beams(Time now, Time stamp, std::span<const Point2> in_base, bool localized) {
  if (odometry_.empty()) return;
  const Time taken = local_time_.receive_handed_on("person beams", now, stamp);
  const Pose2 odom_from_base = odometry_.pose_at(taken);
  // Each laser may be judged by itself: one must not wipe out what the other has met.
  std::erase_if(unmapped_, [&](const Unmapped& beam) { return now - beam.heard > seconds(kJudgedTogether); });
  for (const auto& point : in_base) unmapped_.push_back({odom_from_base * point, now});
  std::vector<Point2> places;
  places.reserve(unmapped_.size());
  for (const Unmapped& beam : unmapped_) places.push_back(beam.in_odom);
  near_unmapped_.emplace(places, odom_from_base.position(), kBySomebody);
  unmapped_time_ = taken;
  beams_localized_ = localized;
}

void Avoider::set_target(Time now, Time stamp, AvoiderTarget target) {
  target_freshness_.receive(now, stamp);
  const Pose2& odom_from_raw = unbroken_.odom_from_raw(local_time_.receive("target", now, stamp));
  for (Point2& via : target.via) via = odom_from_raw * via;
  target.heading = odom_from_raw.theta + target.heading;
  target_ = std::move(target);
}

std::optional<Complaint> Avoider::complaint_of_laser(Time now, std::size_t index) const {
  const std::string& name = lasers_[index];
  auto found = complaint_of(sweep_freshness_[index], now, "sweep of the " + name);
  if (memory_.is_frozen(index)) found = worse(Complaint{0.0, "the " + name + " is frozen"}, found);
  const double missing = memory_.invalid_share(index);
  if (!found && missing > kNearlyAll) return Complaint{0.0, "the " + name + " gives no readings"};
  if (missing > kManyMissing)
    found = worse(found, Complaint{kCrippledSpeed, "the " + name + " gives too few readings"});
  return found;
}

std::optional<Complaint> Avoider::complaint_of_inputs(Time now) const {
  if (!params_.watches) return std::nullopt;
  auto found = odometry_watch_.complaint(now);
  for (std::size_t i = 0; i < lasers_.size(); ++i) found = worse(found, complaint_of_laser(now, i));
  if (params_.needs_sonar) found = worse(found, sonar_watch_.complaint(now, true));
  found = worse(found, tactile_watch_.complaint(now, params_.has_tactile));
  found = worse(found, infrared_watch_.complaint(now, params_.has_infrared));
  for (const auto& [source, freshness] : line_freshness_) {
    if (freshness.is_stale(now, kCameraPatience))
      found = worse(found, Complaint{0.0, "no fresh lines of the camera " + source});
  }
  if (virtual_freshness_.silence(now) > params_.virtual_timeout)
    found = worse(found, Complaint{0.0, "no fresh virtual measurements"});
  return found;
}

std::optional<Complaint> Avoider::complaint(Time now) const {
  return params_.watches ? worse(complaint_of_inputs(now), doubt_.complaint()) : std::nullopt;
}

std::string Avoider::fault(Time now) const {
  const auto found = complaint(now);
  return found && found->max_speed <= 0.0 ? found->reason : "";
}

bool Avoider::is_touched(Time now, double within) const {
  const bool may_leave = params_.method != "dynamic_window" && now - touched_since_ > seconds(kFlinches);
  return touched_ && now - *touched_ < seconds(within) && !may_leave;
}

BaseState Avoider::state_when_effective(Time now) const {
  return predict(odometry_.newest(), odometry_.newest_stamp(), now + seconds(limits_.latency), commands_, limits_);
}

double Avoider::reach() const {
  const double speed = std::min(max_speed_, limits_.max_speed);
  const double until_it_stands = window_.hold() + speed / limits_.deceleration;
  return std::max(kLeastReach, limits_.radius + 0.5 * speed * until_it_stands + kFastWalk * until_it_stands);
}

double Avoider::steps_in() const {
  const double speed = std::min(max_speed_, limits_.max_speed);
  const double until_it_stands = window_.hold() + speed / limits_.deceleration;
  const double way = speed * window_.hold() + speed * speed / (2.0 * limits_.deceleration);
  return std::max(kStepsIn, limits_.radius + way + params_.people.surprise * until_it_stands);
}

void Avoider::tell_nearest(std::span<const Obstacle> obstacles, const BaseLimits& limits, AvoiderDecision& decision) {
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_unknown) continue;
    double& nearest = obstacle.is_virtual ? decision.nearest_virtual : decision.nearest_real;
    nearest = std::min(nearest, obstacle.is_border ? norm(obstacle.at) : limits.gap_to(obstacle.at));
  }
}

std::vector<Obstacle> Avoider::obstacles_from(const Pose2& odom_from_base, Time when) const {
  std::vector<Obstacle> result;
  const double reach = this->reach();
  const Pose2 base_from_odom = inverse(odom_from_base);
  const PointTransform of_points{base_from_odom};
  const auto turned = [&](Point2 in_odom) { return of_points * in_odom - base_from_odom.position(); };
  if (!params_.blind_to_people) {
    const bool judged = beams_localized_ && near_unmapped_ && when - unmapped_time_ < seconds(kStillJudged);
    const double steps_in = this->steps_in();
    const std::vector<ObstaclePoint> points = memory_.points(when);
    result.reserve(points.size());
    for (const auto& point : points) {
      Point2 at = of_points * point.in_odom;
      if (limits_.gap_to(at) < 0.0) at = stopped_at_outline(at, turned(point.velocity), limits_);
      const double away = norm(at);
      if (away > reach) continue;
      if (params_.method == "dynamic_window") {  // where they are now
        result.push_back({at, {}, params_.window.real_margin, point.person, false});
        continue;
      }
      const bool moves = point.velocity != Point2{};
      bool person = point.person;
      bool may_step = moves || !point.straight;
      if (judged && !moves && (person || away < steps_in)) {  // what the map explains is no person
        may_step = near_unmapped_->is_near(point.in_odom);
        person = person && may_step;
      }
      result.push_back({at, turned(point.velocity), params_.window.real_margin, person, false});
      result.back().may_step = may_step && away < steps_in;
      result.back().is_low = point.low;
    }
    for (const double bearing : memory_.blind_directions()) {
      // Nobody knows what is there: as if something were just within the margin, wherever the robot is.
      result.push_back({limits_.edge(Angle::radians(bearing), params_.window.real_margin - 1e-3),
                        {},
                        params_.window.real_margin,
                        false,
                        false});
    }
    for (const Point2 at : seen_.unknown(odom_from_base, limits_, params_.window.real_margin, when)) {
      result.push_back({.at = at, .margin = params_.window.real_margin});
      result.back().is_unknown = true;
    }
  }
  if (virtual_ && odom_from_virtual_) {
    const Pose2 base_from_virtual = base_from_odom * *odom_from_virtual_;
    const double turn = (2.0 * std::numbers::pi - 0.5 * virtual_->bearing_step) / virtual_->bearing_step;
    for (std::size_t i = 0; i < virtual_->ranges.size(); ++i) {
      const double range = virtual_->ranges[i];
      if (!(range < virtual_->max_range)) continue;
      const double bearing = virtual_->first_bearing + static_cast<double>(i) * virtual_->bearing_step;
      // A zero would lie in no direction at all.
      const Point2 at = base_from_virtual * (std::max(range, 0.02) * unit(Angle::radians(bearing)));
      if (norm(at) >= reach) continue;
      const bool is_border = static_cast<double>(i) > turn;
      const double margin = is_border ? params_.window.border_margin : params_.window.virtual_margin;
      result.push_back({at, {}, margin, false, true, is_border});
    }
  }
  return result;
}

Avoider::Carrot Avoider::carrot(const Pose2& odom_from_base, double speed, std::span<const Obstacle> obstacles) const {
  const double lookahead = std::max(params_.lookahead, params_.lookahead_time * speed);
  const Pose2 base_from_odom = inverse(odom_from_base);
  std::vector<Point2> path;
  for (const auto& via : target_->via) path.push_back(base_from_odom * via);
  // The nearest place of the polyline is where we are on it.
  std::size_t leg = 0;
  Point2 here = path.front();
  double least = norm(path.front());
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point2 near = nearest_point({path[i], path[i + 1]}, {});
    if (norm(near) < least) {
      least = norm(near);
      here = near;
      leg = i;
    }
  }
  // From there on: the farthest point within the lookahead that can be reached straight, so that corners are not cut.
  // When only the next few steps are open, somebody stands on the path: the lookahead's end, and steer around.
  constexpr double kStep = 0.1;
  constexpr double kOpenEnough = 0.7;
  Carrot result{here, norm(here)};
  Point2 at = here;
  Point2 end = here;
  bool is_inside = true;
  double along = 0.0;
  for (std::size_t next = here == path.front() ? 0 : leg + 1; next < path.size(); ++next) {
    double rest = distance(at, path[next]);
    while (rest > 1e-9) {
      const double step = std::min(kStep, rest);
      at = at + (step / rest) * (path[next] - at);
      rest -= step;
      along += step;
      const double way = norm(at);
      is_inside = is_inside && way <= lookahead;
      if (!is_inside) continue;
      end = at;
      if (straight_free_way(std::atan2(at.y, at.x), obstacles, limits_.radius, way) >= way - 0.05) result.in_base = at;
    }
  }
  if (norm(result.in_base) < kOpenEnough) result.in_base = end;
  result.remaining += along;
  return result;
}

bool Avoider::must_slide_off(double bearing, std::span<const Obstacle> obstacles) const {
  constexpr double kAhead = 0.25 * std::numbers::pi;
  bool is_held = false;
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_unknown || straight_free_way(bearing, {&obstacle, 1}, limits_.radius, 1.0) >= kBegins) continue;
    const double off = std::abs(Angle::radians(std::atan2(obstacle.at.y, obstacle.at.x) - bearing).radians());
    if (off < kAhead && !obstacle.is_virtual) return false;
    is_held = true;
  }
  return is_held;
}

double Avoider::steer_around(Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles) {
  const double wanted = std::atan2(carrot.y, carrot.x);
  const double need = std::clamp(norm(carrot), 0.3, 1.5);
  constexpr int kSteps = 16;  // 5 degrees each, to 80 degrees on either side: more is no way to the goal
  constexpr double kStep = 5.0 * std::numbers::pi / 180.0;
  constexpr double kNone = 2.0;
  const bool slides = must_slide_off(wanted, obstacles);
  double best = wanted;
  double least = kInfinity;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double bearing = wanted + i * kStep;
    const double way = straight_free_way(bearing, obstacles, limits_.radius, need);
    double cost = std::abs(i) * kStep + 1.4 * (1.0 - way / need);
    if (slides && way < kBegins) cost += kNone;
    if (steered_in_odom_) {
      const Angle in_odom = odom_from_base.theta + Angle::radians(bearing);
      cost += 0.25 * std::abs((in_odom - *steered_in_odom_).radians());
    }
    if (cost < least) {
      least = cost;
      best = bearing;
    }
  }
  steered_in_odom_ = odom_from_base.theta + Angle::radians(best);
  const double bearing = Angle::radians(best).radians();
  // What lies behind may be reached by turning either way: noise must not change the mind half way round.
  constexpr double kBehind = 2.4;
  if (std::abs(bearing) < 1.5) turning_side_ = 0.0;
  if (std::abs(bearing) < kBehind) return bearing;
  if (turning_side_ == 0.0) turning_side_ = std::copysign(1.0, bearing);
  return turning_side_ * kBehind;
}

void Avoider::cap_speed(double cap, std::string_view why, AvoiderDecision& decision) const {
  if (cap >= decision.speed_cap) return;
  decision.speed_cap = std::max(0.0, cap);
  decision.reason = why;
}

void Avoider::cap_by_knowledge(Time now, AvoiderDecision& decision) const {
  if (!params_.watches) return;
  if (const auto found = complaint(now)) cap_speed(found->max_speed, found->reason, decision);
  const auto cap_by_age = [&](const Freshness& freshness, const std::string& name) {
    const double share = std::clamp(1.0 - (freshness.age(now) - 0.2) / 0.3, 0.0, 1.0);
    cap_speed(max_speed_ * share, "the " + name + " comes late", decision);
  };
  cap_by_age(odometry_watch_.freshness(), "odometry");
  for (std::size_t i = 0; i < lasers_.size(); ++i) cap_by_age(sweep_freshness_[i], "sweep of the " + lasers_[i]);

  if (virtual_) {
    // What was computed for where we were still holds while we stand; driving wears it out.
    const double age = virtual_freshness_.age(now);
    const double driven = odometry_.driven_since(virtual_->stamp);
    const double worn = std::min((age - 0.6) / (params_.virtual_timeout - 0.6), driven / 0.3);
    cap_speed(max_speed_ * std::clamp(1.0 - worn, 0.0, 1.0), "the position is not fresh", decision);
  }
}

void Avoider::cap_by_surroundings(std::span<const Obstacle> obstacles, AvoiderDecision& decision) const {
  const auto& window = params_.window;
  for (const auto& obstacle : obstacles) {
    const double way = norm(obstacle.at);
    if (obstacle.is_unknown || way < 1e-6) continue;
    const double slack = slack_to(obstacle, limits_);
    const double ahead = obstacle.at.x / way;
    // The security distance grows with the speed [Buhmann1995]: read backwards, the speed with the distance. On the
    // border of its area, or beyond, the robot is slow whichever way it goes.
    if (ahead > -0.2 || (obstacle.is_border && slack < 0.0)) {
      cap_speed(window.speed_with(slack),
                obstacle.is_border    ? "the border of its area is near"
                : obstacle.is_virtual ? "a hazard is near"
                                      : "something is near",
                decision);
    }
  }
}

Steering Avoider::steering_for(const Carrot& ahead, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                               AvoiderDecision& decision) {
  Steering steering;
  steering.bearing = std::atan2(ahead.in_base.y, ahead.in_base.x);
  steering.distance = norm(ahead.in_base);
  if (params_.method == "dynamic_window") return steering;
  steering.bearing = steer_around(ahead.in_base, odom_from_base, obstacles);
  cap_by_surroundings(obstacles, decision);
  return steering;
}

std::optional<Velocity> Avoider::slowed_for_people(std::span<const Obstacle> obstacles) const {
  constexpr double kStep = 0.05;     // [m/s]
  constexpr double kSharpest = 3.0;  // [1/m]
  if (params_.method == "dynamic_window" || command_.linear <= params_.people.harmless) return std::nullopt;
  const double curvature = std::clamp(command_.angular / command_.linear, -kSharpest, kSharpest);
  double speed = command_.linear;
  BrakingWay braking{speed, curvature, limits_, params_.people};
  for (const auto& obstacle : obstacles) {
    if (!obstacle.may_step && !obstacle.person && obstacle.velocity == Point2{}) continue;
    const PersonPoint person{obstacle.at, obstacle.velocity, limits_.radius + obstacle.margin};
    while (speed > params_.people.harmless && !braking.is_forgivable(person)) {
      speed -= kStep;
      braking = {speed, curvature, limits_, params_.people};
    }
  }
  // The choice may be so much too bold by noise alone; not where anything faster than harmless is too fast.
  if (speed > params_.people.harmless && speed > command_.linear - 1.5 * kStep) return std::nullopt;
  speed = std::max(speed, params_.people.harmless);
  return Velocity{speed, command_.angular * speed / command_.linear};
}

void Avoider::judge_blocking(Time now, Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                             AvoiderDecision& decision) const {
  const double bearing = std::atan2(carrot.y, carrot.x);
  const Obstacle* blocker = nullptr;
  double least = std::min(0.7, norm(carrot));
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_unknown) continue;  // nobody stands there who could be asked: the robot turns and looks
    const double way = straight_free_way(bearing, {&obstacle, 1}, limits_.radius, 2.0);
    if (way < least) {
      least = way;
      blocker = &obstacle;
    }
  }
  if (blocker == nullptr || std::abs(decision.command.linear) > 0.06) return;
  decision.path_blocked = true;
  decision.state = AvoiderDecision::State::blocked;
  decision.reason = blocker->is_border    ? "the border of its area is in the way"
                    : blocker->is_virtual ? "a hazard is in the way"
                                          : "something is in the way";
  if (blocker->is_virtual) return;
  const bool judged = beams_localized_ && near_unmapped_ && now - unmapped_time_ < seconds(kStillJudged);
  const Point2 in_odom = odom_from_base * blocker->at;
  decision.unmapped_obstacle = judged ? near_unmapped_->is_near(in_odom) : blocker->person;
  if (decision.unmapped_obstacle) decision.reason = "somebody is in the way";
  decision.low_obstacle = blocker->is_low && !decision.unmapped_obstacle;
}

AvoiderDecision Avoider::finish(Time now, AvoiderDecision decision) {
  // Whatever else hinders it: what is broken must be known.
  if (auto found = complaint(now)) decision.reason = std::move(found->reason);
  command_ = decision.command;
  commands_.add(now, command_);
  return decision;
}

AvoiderDecision Avoider::stand(Time now, AvoiderDecision decision, std::string reason) {
  decision.command = {};
  decision.state = AvoiderDecision::State::stopped;
  decision.reason = std::move(reason);
  steered_in_odom_.reset();
  return finish(now, std::move(decision));
}

bool Avoider::awaits_sweep(Time now, double soon) const {
  constexpr double kNear = 0.25;  // of a period: a fast laser is not for ever about to come
  return std::any_of(sweep_freshness_.begin(), sweep_freshness_.end(), [&](const Freshness& freshness) {
    return std::abs(freshness.period() - freshness.silence(now)) < std::min(soon, kNear * freshness.period());
  });
}

AvoiderDecision Avoider::decide(Time now) {
  AvoiderDecision decision;
  decision.speed_cap = 0.0;
  decision.nearest_real = decision.nearest_virtual = reach();
  if (odometry_.empty()) return stand(now, std::move(decision), "no fresh odometry");

  const BaseState start = state_when_effective(now);
  const Time effective = now + seconds(limits_.latency);
  auto obstacles = obstacles_from(start.odom_from_base, effective);
  // Where to go among people is chosen as they stand: who walks is elsewhere soon. How fast is for the reflex to say,
  // which foresees them at every scan.
  for (Obstacle& obstacle : obstacles) obstacle.velocity = {};
  tell_nearest(obstacles, limits_, decision);
  if (auto why = fault(now); !why.empty()) return stand(now, std::move(decision), std::move(why));
  if (!target_ || target_->mode == AvoiderTarget::Mode::stop) return stand(now, std::move(decision), "");
  if (target_freshness_.age(now) > params_.target_timeout) return stand(now, std::move(decision), "no fresh target");
  if (is_touched(now, kStandsTouched)) return stand(now, std::move(decision), "the robot was touched");

  decision.speed_cap = std::min(max_speed_, limits_.max_speed);
  Steering steering;
  Point2 wanted{};
  if (target_->mode == AvoiderTarget::Mode::turn) {
    const double error = (target_->heading - start.odom_from_base.theta).radians();
    if (std::abs(error) < 0.6 * target_->heading_tolerance) return stand(now, std::move(decision), "");
    steering = {error, 100.0, 0.0, false};
    decision.speed_cap = 0.0;
    decision.state = AvoiderDecision::State::turning;
  } else if (target_->via.empty()) {
    return stand(now, std::move(decision), "");
  } else {
    const Carrot ahead = carrot(start.odom_from_base, start.velocity.linear, obstacles);
    wanted = ahead.in_base;
    if (target_->is_final) {
      const double to_goal = norm(inverse(start.odom_from_base) * target_->via.back());
      if (to_goal < 0.5 * target_->position_tolerance) return stand(now, std::move(decision), "");
      const double rest = std::max(0.0, ahead.remaining - 0.2 * target_->position_tolerance);
      cap_speed(std::max(0.08, std::sqrt(2.0 * params_.arrival_deceleration * rest)), "", decision);
    }
    cap_by_knowledge(now, decision);
    for (const Point2& thing : memory_.touched_things(now)) {
      if (limits_.gap_to(inverse(start.odom_from_base) * thing) >= kNearThing) continue;
      cap_speed(kFeelsItsWay, "something that only touch finds is near", decision);
      decision.low_obstacle = true;
    }
    steering = steering_for(ahead, start.odom_from_base, obstacles, decision);
    // Sharp turns slowly, and on the spot when the way lies behind.
    const double turn = std::abs(steering.bearing);
    cap_speed(max_speed_ * std::clamp(1.35 - turn / 1.1, 0.0, 1.0), "", decision);
    steering.speed_cap = decision.speed_cap;
    decision.state = AvoiderDecision::State::driving;
  }

  auto choice = window_.choose(start.velocity, command_, obstacles, steering);
  decision.command = choice.command;
  decision.window = std::move(choice.window);
  if (choice.is_braking) decision.reason = "braking";
  if (target_->mode == AvoiderTarget::Mode::drive)
    judge_blocking(now, wanted, start.odom_from_base, obstacles, decision);
  return finish(now, std::move(decision));
}

std::optional<AvoiderDecision> Avoider::reflex(Time now) {
  if (odometry_.empty() || (std::abs(command_.linear) < 1e-9 && std::abs(command_.angular) < 1e-9)) return std::nullopt;
  AvoiderDecision decision;
  decision.nearest_real = decision.nearest_virtual = reach();
  if (auto why = fault(now); !why.empty()) return stand(now, std::move(decision), std::move(why));
  if (is_touched(now, 0.2)) return stand(now, std::move(decision), "the robot was touched");
  const BaseState start = state_when_effective(now);
  // A disc turns in its own place; another body sweeps more.
  const bool stays = std::abs(start.velocity.linear) < 0.03 && std::abs(command_.linear) < 0.03;
  if (stays && limits_.outline.empty()) return std::nullopt;
  const auto obstacles = obstacles_from(start.odom_from_base, now + seconds(limits_.latency));
  tell_nearest(obstacles, limits_, decision);
  // Less margin than at the choice, or the noise of every sweep would brake; until the next sweep, then brake.
  constexpr double kSlack = 0.03;
  constexpr double kUntilNextSweep = 0.12;
  const auto is_safe = [&](const Velocity& command) {
    return can_brake_in_time(start.velocity, command, kUntilNextSweep, obstacles, limits_, kSlack);
  };
  if (is_safe(command_)) {
    const auto slowed = slowed_for_people(obstacles);
    if (!slowed) return std::nullopt;
    if (is_safe(*slowed)) {
      decision.command = *slowed;
      decision.state = AvoiderDecision::State::driving;
      decision.speed_cap = slowed->linear;
      decision.reason = "people are near";
      return finish(now, std::move(decision));
    }
  }
  return stand(now, std::move(decision), "braking");
}

}  // namespace docent
