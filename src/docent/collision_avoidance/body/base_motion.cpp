#include "docent/collision_avoidance/body/base_motion.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

namespace {

double approach(double value, double goal, double faster, double slower, double dt) {
  // Through zero: first the brakes, then the motor.
  if (value * goal < 0.0) {
    const double stop_time = std::abs(value) / slower;
    if (stop_time >= dt) return value - std::copysign(slower * dt, value);
    value = 0.0;
    dt -= stop_time;
  }
  const double rate = std::abs(goal) > std::abs(value) ? faster : slower;
  return value + std::clamp(goal - value, -rate * dt, rate * dt);
}

Pose2 moved(const Pose2& pose, double linear, double angular, double dt) {
  const Angle middle = pose.theta + Angle::radians(0.5 * angular * dt);
  const Point2 place = pose.position() + linear * dt * unit(middle);
  return {place.x, place.y, pose.theta + Angle::radians(angular * dt)};
}

}  // namespace

BaseState advance(const BaseState& state, const Velocity& command, const BaseLimits& limits, double dt) {
  const Velocity next{
      approach(state.velocity.linear, command.linear, limits.acceleration, limits.deceleration, dt),
      approach(state.velocity.angular, command.angular, limits.turn_acceleration, limits.turn_acceleration, dt)};
  return {moved(state.odom_from_base, 0.5 * (state.velocity.linear + next.linear),
                0.5 * (state.velocity.angular + next.angular), dt),
          next};
}

void CommandHistory::add(Time time, const Velocity& command) {
  commands_.emplace_back(time, command);
  while (commands_.size() > 2 && time - commands_[1].first > seconds(params_.memory)) commands_.pop_front();
}

Velocity CommandHistory::at(Time time) const {
  Velocity result;
  for (const auto& [given, command] : commands_) {
    if (given > time) break;
    result = command;
  }
  return result;
}

BaseState predict(BaseState state, Time from, Time to, const CommandHistory& commands, const BaseLimits& limits,
                  const PredictionParams& params) {
  Time time = std::max(from, to - seconds(params.longest));
  while (time < to) {
    const double dt = std::min(params.step, to_seconds(to - time));
    const Time middle = time + seconds(0.5 * dt);
    state = advance(state, commands.at(middle - seconds(limits.latency)), limits, dt);
    time = time + seconds(dt);
  }
  return state;
}

void BaseHistory::add(Time stamp, const BaseState& state) {
  if (!states_.empty() && stamp <= states_.back().first) {
    if (stamp == states_.back().first) states_.back().second = state;         // the newest of a burst
    if (states_.back().first - stamp < seconds(params_.begins_anew)) return;  // late or doubled
    states_.clear();                                                          // the clock or the base began anew
  }
  states_.emplace_back(stamp, state);
  while (states_.size() > 2 && stamp - states_.front().first > seconds(params_.memory)) states_.pop_front();
}

Pose2 BaseHistory::pose_at(Time time) const {
  const auto later =
      std::partition_point(states_.begin(), states_.end(), [&](const auto& entry) { return entry.first <= time; });
  if (later == states_.begin()) return states_.front().second.odom_from_base;
  const auto& [before_time, before] = *std::prev(later);
  if (later == states_.end()) {
    const double dt = std::clamp(to_seconds(time - before_time), 0.0, params_.carried_on);
    return moved(before.odom_from_base, before.velocity.linear, before.velocity.angular, dt);
  }
  const Pose2& a = before.odom_from_base;
  const Pose2& b = later->second.odom_from_base;
  const double share = to_seconds(time - before_time) / to_seconds(later->first - before_time);
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          a.theta + Angle::radians(share * (b.theta - a.theta).radians())};
}

double BaseHistory::driven_since(Time time) const {
  double length = 0.0;
  for (std::size_t i = states_.size(); i > 1 && states_[i - 1].first > time; --i) {
    length +=
        distance(states_[i - 1].second.odom_from_base.position(), states_[i - 2].second.odom_from_base.position());
  }
  return length;
}

}  // namespace docent::collision_avoidance
