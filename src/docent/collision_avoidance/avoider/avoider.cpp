#include "docent/collision_avoidance/avoider/avoider.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "docent/collision_avoidance/body/braking.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::collision_avoidance {
namespace {
constexpr double kRounding = 1e-9;  // [m/s], [rad/s]

motion_models::UnbrokenOdometryParams of_base(const BaseLimits& limits, motion_models::UnbrokenOdometryParams params) {
  params.base = {limits.max_speed, limits.max_turn_rate};
  return params;
}

}  // namespace

Avoider::Avoider(const BaseLimits& limits, const AvoiderParams& params, std::vector<std::string> lasers,
                 std::unique_ptr<LocalPlanner> planner)
    : limits_{limits},
      params_{params},
      caution_{params.caution(limits)},
      planner_{planner ? std::move(planner) : params.make_planner(limits)},
      window_{limits, params.window},
      surroundings_{limits, params.surroundings(), params.virtual_obstacles()},
      inputs_{limits, params.inputs(), std::move(lasers)},
      carried_off_{inputs_.lasers(), params.carried_off},
      unbroken_{of_base(limits, params.odometry)},
      sweep_order_(inputs_.lasers()),
      max_speed_{std::min(params.first_max_speed, limits.max_speed)} {}

void Avoider::add_odometry(Time now, Time stamp, const BaseState& state) {
  const bool stands = state.velocity.linear == 0.0 && state.velocity.angular == 0.0;
  stamp = odometry_stamps_.mend(now, stamp, state.odom_from_base, stands);
  const Time taken = local_time_.receive("odometry", now, stamp);
  const auto unbroken = unbroken_.add(taken, state.odom_from_base);
  inputs_.hear_odometry(now, stamp, state, unbroken.jumped, commands_);
  if (unbroken.is_late) return;
  if (unbroken.is_set_back) odometry_.forget();
  // A base that derives its velocity from its pose says nonsense in a jump.
  const bool keeps = unbroken.jumped && !odometry_.empty();
  odometry_.add(taken, {unbroken.odom_from_base, keeps ? odometry_.newest().velocity : state.velocity});
}

void Avoider::add_sweep(Time now, std::size_t sensor, SensorSweep sweep) {
  if (sensor >= inputs_.lasers() || odometry_.empty()) return;
  sweep.stamp = stamp_or(sweep.stamp, now);
  inputs_.hear_sweep(now, sweep.stamp, sensor);
  sweep.stamp = local_time_.receive("laser " + std::to_string(sensor), now, sweep.stamp) - seconds(sweep.late);
  if (was_overtaken(sensor, sweep.stamp)) return;
  const Pose2 odom_from_base = odometry_.pose_at(sweep.stamp);
  constexpr Duration kCarriedOn = std::chrono::milliseconds{250};  // odometry that is so old tells of no motion
  const bool is_motion_known = sweep.stamp - odometry_.newest_stamp() <= kCarriedOn;
  if (params_.watches) {
    sweep = inputs_.judge_sweep(sensor, std::move(sweep), odom_from_base, is_motion_known);
    if (params_.stops_when_carried_off) carried_off_.see(sensor, sweep.stamp, inputs_.succession_of(sensor));
  }
  surroundings_.add_sweep(sensor, std::move(sweep), odom_from_base);
}

bool Avoider::was_overtaken(std::size_t sensor, Time stamp) {
  SweepOrder& order = sweep_order_[sensor];
  if (stamp == order.newest) return true;
  if (stamp < order.newest && ++order.older == 1) return true;  // a second one: the clock was set back
  order = {stamp, 0};
  return false;
}

void Avoider::add_sonar(Time now, std::size_t index, SonarReading reading) {
  if (odometry_.empty()) return;
  reading.stamp = stamp_or(reading.stamp, now);
  const Time stamp = std::exchange(reading.stamp, local_time_.receive("sonars", now, reading.stamp));
  const Pose2 odom_from_base = odometry_.pose_at(reading.stamp);
  inputs_.hear_sonar(now, stamp, index, reading, odom_from_base);
  surroundings_.memory().add_sonar(index, reading, odom_from_base);
}

void Avoider::add_infrared(Time now, std::size_t index, SonarReading reading) {
  if (odometry_.empty()) return;
  reading.stamp = stamp_or(reading.stamp, now);
  const Time stamp = std::exchange(reading.stamp, local_time_.receive("infrared", now, reading.stamp));
  const Pose2 odom_from_base = odometry_.pose_at(reading.stamp);
  inputs_.hear_infrared(now, stamp, index, reading, odom_from_base);
  surroundings_.memory().add_infrared(index, reading, odom_from_base);
}

void Avoider::add_lines(Time now, Time stamp, const std::string& source, double lifetime,
                        std::span<const Segment> in_base) {
  if (odometry_.empty()) return;
  stamp = stamp_or(stamp, now);
  inputs_.hear_lines(now, stamp, source);
  const Time taken = local_time_.receive_from_picture("camera " + source, now, stamp);
  surroundings_.memory().add_lines(source, taken, lifetime, in_base, odometry_.pose_at(taken));
}

void Avoider::add_tactile(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan) {
  stamp = stamp_or(stamp, now);
  inputs_.feel(now, stamp, segments, scan);
  if (odometry_.empty()) return;
  const Time taken = local_time_.receive("tactile", now, stamp);
  ObstacleMemory& memory = surroundings_.memory();
  const Pose2 odom_from_base = odometry_.pose_at(taken);
  memory.stand(odom_from_base.position(), limits_.inradius() - params_.touch.dent);
  surroundings_.felt().stand(odom_from_base.position(), limits_.inradius() - params_.touch.dent, now);
  const double step = 2.0 * std::numbers::pi / static_cast<double>(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i] == 0 || segments[i] == TactileWatch::kNoReading) continue;
    const Angle bearing = Angle::radians(step * static_cast<double>(i));
    contact_.feel(now, odometry_.newest().odom_from_base.theta + bearing);
    const TouchedBy who = memory.add_touch(taken, limits_.edge(bearing), odom_from_base);
    feel(now, who, bearing, odom_from_base);
  }
}

void Avoider::feel(Time now, TouchedBy who, Angle bearing, const Pose2& odom_from_base) {
  const double speed = odometry_.newest().velocity.linear * unit(bearing).x;
  const bool drove_into_it = speed > params_.touch.drives_into;
  if (who == TouchedBy::seen || (who == TouchedBy::somebody && !drove_into_it)) return;
  surroundings_.felt().feel(odom_from_base * limits_.edge(bearing), unit(odom_from_base.theta + bearing),
                            who == TouchedBy::somebody, now);
}

void Avoider::add_virtual(Time now, VirtualSweep sweep) {
  const auto is_unfit = [](float range) { return std::isnan(range); };
  if (odometry_.empty() || std::any_of(sweep.ranges.begin(), sweep.ranges.end(), is_unfit)) return;
  inputs_.hear_virtual(now, sweep.stamp);
  sweep.stamp = local_time_.receive_handed_on("virtual", now, sweep.stamp);
  const Pose2 odom_from_base = odometry_.pose_at(sweep.stamp);
  surroundings_.virtual_obstacles().take(std::move(sweep), odom_from_base);
}

void Avoider::add_place(Time now, Time stamp, const Pose2& map_from_robot, const Pose2& raw_from_robot, double mass) {
  const Time taken = local_time_.receive_handed_on("belief", now, stamp);
  const Pose2 map_from_odom = map_from_robot * inverse(unbroken_.odom_from_raw(taken) * raw_from_robot);
  inputs_.believe(taken, map_from_odom, mass);
  surroundings_.felt().believe(map_from_odom, mass);
  carried_off_.believe(taken, says_here_);
}

void Avoider::add_person_beams(Time now, Time stamp, std::span<const Point2> in_base, bool localized) {
  if (odometry_.empty()) return;
  const Time taken = local_time_.receive_handed_on("person beams", now, stamp);
  surroundings_.unmapped().add(now, taken, odometry_.pose_at(taken), in_base, localized);
}

void Avoider::set_target(Time now, Time stamp, AvoiderTarget target) {
  target_freshness_.receive(now, stamp);
  const Pose2& odom_from_raw = unbroken_.odom_from_raw(local_time_.receive("target", now, stamp));
  for (Point2& via : target.via) via = odom_from_raw * via;
  target.heading = odom_from_raw.theta + target.heading;
  target_ = std::move(target);
}

std::optional<Complaint> Avoider::complaint_of_inputs(Time now) const {
  if (!params_.watches) return std::nullopt;
  return inputs_.complaint(now, surroundings_.memory());
}

std::optional<Complaint> Avoider::complaint(Time now) const {
  return params_.watches ? worse(complaint_of_inputs(now), doubt_.complaint()) : std::nullopt;
}

std::string Avoider::fault(Time now) const {
  const auto found = complaint(now);
  return found && found->max_speed <= 0.0 ? found->reason : "";
}

bool Avoider::is_touched(Time now, double within) const {
  return contact_.is_touched(now, within) && !(caution_.leaves_who_touches() && contact_.may_leave(now));
}

BaseState Avoider::state_when_effective(Time now) const {
  return predict(odometry_.newest(), odometry_.newest_stamp(), now + seconds(limits_.latency), commands_, limits_);
}

void Avoider::tell_nearest(std::span<const Obstacle> obstacles, AvoiderDecision& decision) const {
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_unknown) continue;
    double& nearest = obstacle.is_virtual ? decision.nearest_virtual : decision.nearest_real;
    nearest = std::min(nearest, obstacle.is_border ? norm(obstacle.at) : limits_.gap_to(obstacle.at));
  }
}

void Avoider::cap_by_knowledge(Time now, SpeedCap& cap) const {
  if (!params_.has_lasers) cap.lower(params_.sonar_speed, "no laser looks ahead");
  if (!params_.watches) return;
  if (const auto found = complaint(now)) cap.lower(found->max_speed, found->reason);
  inputs_.cap_by_age(now, max_speed_, cap);
  inputs_.cap_by_proof(cap);
  carried_off_.cap(now, cap);
  if (const auto measured = surroundings_.virtual_obstacles().stamp())
    inputs_.cap_by_position(now, odometry_.driven_since(*measured), max_speed_, cap);
}

bool Avoider::cap_by_touched_things(Time now, const Pose2& odom_from_base, SpeedCap& cap) const {
  bool is_near = false;
  for (const Point2& thing : surroundings_.memory().touched_things(now)) {
    if (limits_.gap_to(inverse(odom_from_base) * thing) >= params_.touch.near) continue;
    cap.lower(params_.touch.feels_its_way, to_text(ReasonWord::felt_thing_near));
    is_near = true;
  }
  if (surroundings_.felt().gap(odom_from_base, limits_) < params_.touch.felt_near) {
    cap.lower(params_.touch.feels_its_way, to_text(ReasonWord::felt_thing_near));
    is_near = true;
  }
  return is_near;
}

void Avoider::judge_blocking(Time now, Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                             AvoiderDecision& decision) const {
  const double bearing = std::atan2(carrot.y, carrot.x);
  const Obstacle* blocker = nullptr;
  double least = std::min(params_.blocking.least_way, norm(carrot));
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_unknown) continue;  // nobody stands there who could be asked: the robot turns and looks
    const double way = straight_free_way(bearing, {&obstacle, 1}, limits_.radius, params_.blocking.horizon);
    if (way < least) {
      least = way;
      blocker = &obstacle;
    }
  }
  if (blocker == nullptr || std::abs(decision.command.linear) > params_.blocking.least_speed) return;
  decision.path_blocked = true;
  decision.state = AvoiderDecision::State::blocked;
  decision.reason = to_text(blocker->is_border    ? ReasonWord::border_in_way
                            : blocker->is_virtual ? ReasonWord::hazard_in_way
                                                  : ReasonWord::obstacle_in_way);
  if (blocker->is_virtual) return;
  const UnmappedPlaces& unmapped = surroundings_.unmapped();
  const Point2 in_odom = odom_from_base * blocker->at;
  decision.unmapped_obstacle = unmapped.judge(now) ? unmapped.is_near(in_odom) : blocker->person;
  if (decision.unmapped_obstacle) decision.reason = to_text(ReasonWord::person_in_way);
  decision.low_obstacle = blocker->is_low && !decision.unmapped_obstacle;
}

AvoiderDecision Avoider::finish(Time now, AvoiderDecision decision) {
  // Whatever else hinders it, but for a person's hand: what is broken must be known.
  if (auto found = complaint(now); found && !is_stopped_) decision.reason = std::move(found->reason);
  command_ = decision.command;
  commands_.add(now, command_);
  return decision;
}

AvoiderDecision Avoider::stand(Time now, AvoiderDecision decision, std::string reason) {
  decision.command = {};
  decision.state = AvoiderDecision::State::stopped;
  decision.reason = std::move(reason);
  planner_->forget();
  return finish(now, std::move(decision));
}

std::optional<std::string> Avoider::reason_to_stand(Time now) const {
  if (auto why = fault(now); !why.empty()) return why;
  if (is_stopped_) return to_text(ReasonWord::stopped_by_hand);
  std::optional<std::string> touched;
  if (is_touched(now, contact_.stands_for())) touched = to_text(ReasonWord::touched);
  if (const HandSteering* wish = hand(now)) {
    const bool is_dead = now - hand_->said > seconds(params_.hand.watchdog) || !wish->is_pressed;
    return is_dead ? to_text(ReasonWord::steered_by_hand) : touched;
  }
  if (dock_.wish(now) != nullptr) return touched ? touched : carried_off_.forbids_driving(now);
  if (!target_ || target_->mode == AvoiderTarget::Mode::stop) return "";
  if (target_freshness_.age(now) > params_.target_timeout) return "no fresh target";
  if (touched) return touched;
  return target_->mode == AvoiderTarget::Mode::drive ? carried_off_.forbids_driving(now) : std::nullopt;
}

const HandSteering* Avoider::hand(Time now) const {
  return hand_ && now - hand_->said <= seconds(params_.hand.watchdog + params_.hand.returns) ? &hand_->wish : nullptr;
}

std::optional<Steering> Avoider::steer_as_hand(Time now, const HandSteering& wish, AvoiderDecision& decision) const {
  const HandParams& hand = params_.hand;
  decision.reason = to_text(ReasonWord::steered_by_hand);
  if (std::abs(wish.forward) < hand.least && std::abs(wish.turn) < hand.least) return std::nullopt;
  if (std::abs(wish.forward) < hand.least) {
    decision.speed_cap = 0.0;
    decision.state = AvoiderDecision::State::turning;
    const double quarter = std::numbers::pi / 2.0;
    return Steering{wish.turn * quarter, params_.approach.far, 0.0, false};
  }
  const bool is_backwards = wish.forward < 0.0;
  SpeedCap cap{top_speed() * std::abs(wish.forward) * (is_backwards ? hand.backwards : 1.0), {}};
  cap_by_knowledge(now, cap);
  if (!cap.reason.empty()) decision.reason = cap.reason;
  decision.speed_cap = cap.speed;
  decision.state = AvoiderDecision::State::driving;
  const double aside = wish.turn * hand.full_turn;
  // Backwards, a stick to the left turns the robot's nose to the left, as it does in a car.
  const double bearing = is_backwards ? Angle::radians(std::numbers::pi - aside).radians() : aside;
  return Steering{bearing, hand.distance, cap.speed, is_backwards};
}

std::optional<Steering> Avoider::turn_to_heading(const BaseState& start, AvoiderDecision& decision) const {
  const double error = (target_->heading - start.odom_from_base.theta).radians();
  if (std::abs(error) < params_.approach.turned * target_->heading_tolerance) return std::nullopt;
  decision.speed_cap = 0.0;
  decision.state = AvoiderDecision::State::turning;
  return Steering{error, params_.approach.far, 0.0, false};
}

std::optional<SpeedCap> Avoider::cap_along_path(Time now, const BaseState& start, double remaining) const {
  const ApproachParams& approach = params_.approach;
  SpeedCap cap{top_speed(), {}};
  if (target_->is_final) {
    const double to_goal = norm(inverse(start.odom_from_base) * target_->via.back());
    if (to_goal < approach.arrived * target_->position_tolerance) return std::nullopt;
    const double rest = std::max(0.0, remaining - approach.aims_short * target_->position_tolerance);
    cap.lower(std::max(approach.least_speed, std::sqrt(2.0 * params_.arrival_deceleration * rest)), "");
  }
  cap_by_knowledge(now, cap);
  return cap;
}

AvoiderDecision Avoider::follow_path(Time now, const BaseState& start, std::span<const Obstacle> obstacles,
                                     AvoiderDecision decision) {
  if (target_->via.empty()) return stand(now, std::move(decision), "");
  const Pose2 base_from_odom = inverse(start.odom_from_base);
  std::vector<Point2> path;
  for (const auto& via : target_->via) path.push_back(base_from_odom * via);
  const double lookahead = std::max(params_.lookahead, params_.lookahead_time * start.velocity.linear);
  const Carrot ahead = carrot_on(path, lookahead, obstacles, limits_.radius, params_.carrot);
  auto cap = cap_along_path(now, start, ahead.remaining);
  if (!cap) return stand(now, std::move(decision), "");
  decision.low_obstacle = cap_by_touched_things(now, start.odom_from_base, *cap);

  const LocalTask task{start.velocity, command_,      start.odom_from_base, obstacles,
                       path,           ahead.in_base, max_speed_,           std::move(*cap)};
  decision = checked(task, planner_->plan(task), 0.0, std::move(decision));
  judge_blocking(now, task.carrot, start.odom_from_base, obstacles, decision);
  return finish(now, std::move(decision));
}

AvoiderDecision Avoider::follow_dock(Time now, const BaseState& start, std::span<const Obstacle> obstacles,
                                     AvoiderDecision decision) {
  SpeedCap cap{top_speed(), {}};
  cap_by_knowledge(now, cap);
  const LocalTask task{start.velocity, command_, start.odom_from_base, obstacles, {}, {}, max_speed_, std::move(cap)};
  LocalPlan plan{task};
  plan.command = *dock_.wish(now);
  planner_->forget();
  return finish(now, checked(task, std::move(plan), dock_.nearer(now, *dock_.wish(now)), std::move(decision)));
}

AvoiderDecision Avoider::checked(const LocalTask& task, LocalPlan plan, double nearer, AvoiderDecision decision) const {
  decision.command = within_limits(plan.command, task);
  if (!may_keep_to(decision.command, task, nearer)) {
    decision.command = {};
    plan.is_braking = true;
  }
  decision.window = std::move(plan.window);
  decision.speed_cap = std::min(plan.cap.speed, task.cap.speed);
  decision.reason = plan.is_braking ? to_text(ReasonWord::braking) : std::move(plan.cap.reason);
  decision.state = AvoiderDecision::State::driving;
  return decision;
}

Velocity Avoider::within_limits(const Velocity& command, const LocalTask& task) const {
  if (!std::isfinite(command.linear) || !std::isfinite(command.angular)) return {};
  const double cycle = params_.window.cycle;
  const double braked = task.velocity.linear - limits_.deceleration * cycle;
  const double fastest = std::max(std::min(task.cap.speed, limits_.max_speed), braked);
  const double turn = limits_.turn_acceleration * cycle;
  const double left = std::max(limits_.max_turn_rate, task.velocity.angular - turn);
  const double right = std::min(-limits_.max_turn_rate, task.velocity.angular + turn);
  Velocity result = command;
  const double linear = std::clamp(command.linear, std::min(-params_.window.creep_speed, fastest), fastest);
  if (std::abs(linear - command.linear) > kRounding) result = {linear, command.angular * linear / command.linear};
  if (result.angular < right - kRounding || result.angular > left + kRounding)
    result.angular = std::clamp(result.angular, right, left);
  return result;
}

bool Avoider::may_keep_to(const Velocity& command, const LocalTask& task, double nearer) const {
  const bool stays = command.linear == 0.0;
  if (stays && (limits_.outline.empty() || command.angular == 0.0)) return true;  // a disc turns in its own place
  const auto may_last = [&](double duration) {
    return can_brake_in_time(task.velocity, command, duration, task.obstacles, limits_, nearer);
  };
  return may_last(limits_.hold()) && (stays || may_last(params_.window.next_check));
}

AvoiderDecision Avoider::decide(Time now) {
  AvoiderDecision decision;
  decision.nearest_real = decision.nearest_virtual = surroundings_.reach(top_speed());
  if (odometry_.empty()) return stand(now, std::move(decision), "no fresh odometry");
  const BaseState start = state_when_effective(now);
  auto obstacles = obstacles_from(start.odom_from_base, now + seconds(limits_.latency));
  // Where to go among people is chosen as they stand: who walks is elsewhere soon. How fast is for the reflex to say,
  // which foresees them at every scan.
  for (Obstacle& obstacle : obstacles) obstacle.velocity = {};
  tell_nearest(obstacles, decision);
  if (auto why = reason_to_stand(now)) return stand(now, std::move(decision), std::move(*why));

  decision.speed_cap = top_speed();
  const HandSteering* wish = hand(now);
  if (wish == nullptr && dock_.wish(now) != nullptr) return follow_dock(now, start, obstacles, std::move(decision));
  if (wish == nullptr && target_->mode == AvoiderTarget::Mode::drive)
    return follow_path(now, start, obstacles, std::move(decision));
  const auto steering = wish != nullptr ? steer_as_hand(now, *wish, decision) : turn_to_heading(start, decision);
  if (!steering) return stand(now, std::move(decision), wish != nullptr ? to_text(ReasonWord::steered_by_hand) : "");
  auto choice = window_.choose(start.velocity, command_, obstacles, *steering);
  decision.command = choice.command;
  decision.window = std::move(choice.window);
  if (choice.is_braking) decision.reason = to_text(ReasonWord::braking);
  return finish(now, std::move(decision));
}

std::optional<AvoiderDecision> Avoider::reflex(Time now) {
  if (odometry_.empty() || (std::abs(command_.linear) < 1e-9 && std::abs(command_.angular) < 1e-9)) return std::nullopt;
  AvoiderDecision decision;
  decision.nearest_real = decision.nearest_virtual = surroundings_.reach(top_speed());
  if (auto why = fault(now); !why.empty()) return stand(now, std::move(decision), std::move(why));
  if (is_stopped_) return stand(now, std::move(decision), to_text(ReasonWord::stopped_by_hand));
  const HandSteering* wish = hand(now);
  if (wish != nullptr && (!wish->is_pressed || now - hand_->said > seconds(params_.hand.watchdog)))
    return stand(now, std::move(decision), to_text(ReasonWord::steered_by_hand));
  if (auto why = carried_off_.forbids_driving(now); why && wish == nullptr && command_.linear != 0.0)
    return stand(now, std::move(decision), std::move(*why));
  if (is_touched(now, params_.touch.brakes_for)) return stand(now, std::move(decision), to_text(ReasonWord::touched));
  const BaseState start = state_when_effective(now);
  // A disc turns in its own place; another body sweeps more.
  const ReflexParams& reflex = params_.reflex;
  const bool stays = std::abs(start.velocity.linear) < reflex.still && std::abs(command_.linear) < reflex.still;
  if (stays && limits_.outline.empty()) return std::nullopt;
  const auto obstacles = obstacles_from(start.odom_from_base, now + seconds(limits_.latency));
  tell_nearest(obstacles, decision);
  const auto is_safe = [&](const Velocity& command) {
    const double slack = std::max(reflex.slack, dock_.nearer(now, command));
    return can_brake_in_time(start.velocity, command, reflex.until_next_sweep, obstacles, limits_, slack);
  };
  if (is_safe(command_)) {
    const auto slowed = caution_.slowed_for_people(command_, obstacles);
    if (!slowed) return std::nullopt;
    if (is_safe(*slowed)) {
      decision.command = *slowed;
      decision.state = AvoiderDecision::State::driving;
      decision.speed_cap = slowed->linear;
      decision.reason = to_text(ReasonWord::people_near);
      return finish(now, std::move(decision));
    }
  }
  return stand(now, std::move(decision), to_text(ReasonWord::braking));
}

}  // namespace docent::collision_avoidance
