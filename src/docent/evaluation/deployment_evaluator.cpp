#include "docent/evaluation/deployment_evaluator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::evaluation {
namespace {

constexpr double kContactSpeed = 0.1;  ///< [m/s] towards a person; slower, they walked into the robot
constexpr double kPass = 1.0;          ///< [m], outline to outline
constexpr double kPassEnd = 1.2;       ///< [m]
constexpr double kMoves = 0.05;        ///< [m/s]
constexpr double kTurns = 0.1;         ///< [rad/s]
constexpr double kCharge = 0.05;       ///< of the battery: a rise that is a charge
constexpr double kDepleted = 0.01;

/// A goal in one of these states is being driven to.
bool is_active(std::optional<GoalStatus> state) {
  return state == GoalStatus::driving || state == GoalStatus::turning || state == GoalStatus::blocked ||
         state == GoalStatus::waiting;
}

}  // namespace

std::optional<Point2> DeploymentEvaluator::true_place() const {
  if (truth_.empty()) return std::nullopt;
  return Point2{truth_.latest().x, truth_.latest().y};
}

void DeploymentEvaluator::add(const transport::TopicInfo& topic, Time time,
                              const std::shared_ptr<const void>& message) {
  const auto is = [name = std::string_view{topic.name}](const auto& wanted) { return name == wanted.name; };
  const auto as = [&message]<class T>(const Topic<T>& /*wanted*/) -> const T& {
    return *static_cast<const T*>(message.get());
  };
  latency_.add(topic, time, message);
  ages_.add(topic, time, message);
  if (is(topics::kTrueState)) {
    add_state(std::static_pointer_cast<const docent_msgs::TrueState>(message));
  } else if (is(topics::kBelief)) {
    localization_.add_belief(as(topics::kBelief));
  } else if (is(topics::kPeople)) {
    people_.add(as(topics::kPeople));
  } else if (is(topics::kGoalState)) {
    add_goal_state(as(topics::kGoalState));
  } else if (is(topics::kDriveGoal)) {
    is_relocalizing_ = as(topics::kDriveGoal).relocalize;
  } else if (is(topics::kRequestBoard)) {
    requests_.add_board(time, as(topics::kRequestBoard), true_place());
  } else if (is(topics::kTask)) {
    requests_.add_task(as(topics::kTask));
  } else if (is(topics::kEvent)) {
    requests_.add_event(time, as(topics::kEvent), true_place());
  } else if (is(topics::kReaction)) {
    const auto step = parse<Rung>(as(topics::kReaction).step);
    report_.blocked.local_detours += step == Rung::local_detour ? 1 : 0;
    report_.blocked.global_detours += step == Rung::global_detour ? 1 : 0;
  } else if (is(topics::kHorn)) {
    ++report_.blocked.horn;
  } else if (is(topics::kHealth)) {
    add_health(as(topics::kHealth));
  } else if (is(topics::kTrueContact)) {
    add_contact(as(topics::kTrueContact));
  } else if (is(topics::kTrueOffer)) {
    const docent_msgs::TrueOffer& offer = as(topics::kTrueOffer);
    requests_.add_offer(time, offer);
    restarts_ordered_ += offer.kind == "kill" || offer.kind == "restart" ? 1 : 0;
  } else if (is(topics::kRunInfo)) {
    const docent_msgs::RunInfo& run = as(topics::kRunInfo);
    report_.museum = run.museum;
    report_.mode = run.mode;
    report_.seed = run.seed;
    report_.crowd = run.crowd;
    report_.config_hash = run.config_hash;
    report_.simd = run.simd;
    report_.crippled = run.crippled;
  }
}

void DeploymentEvaluator::add_state(std::shared_ptr<const docent_msgs::TrueState> message) {
  const docent_msgs::TrueState& state = *message;
  const Time time = from_message(state.header.stamp);
  if (truth_.empty()) {
    start_ = time;
    first_distance_m_ = state.distance_m;
    first_contact_seconds_ = state.contact_seconds;
  } else if (time <= truth_.latest_time()) {
    return;
  } else if (goal_is_active_ && !is_relocalizing_) {
    const double dt = to_seconds(time - truth_.latest_time());
    report_.travel_seconds += dt;
    report_.travel_distance_m += state.distance_m - truth_.latest().distance_m;
    const bool stands = std::abs(state.linear) < kMoves && std::abs(state.angular) < kTurns;
    if (stands) report_.standing_seconds += dt;
    if (is_blocked_) report_.blocked.seconds += dt;
  }
  report_.area_violations += was_inside_ && !state.inside_area ? 1 : 0;
  was_inside_ = state.inside_area;
  report_.max_speed_mps = std::max(report_.max_speed_mps, std::abs(state.linear));
  count_passes(state);
  count_battery(state.battery);
  truth_.add(std::move(message));
  localization_.step(truth_);
  people_.step(truth_);
}

bool is_contact(const docent_msgs::TrueContact& touch) {
  const bool excused = touch.braked_in_time && touch.other_speed > touch.robot_speed;
  return parse<ContactKind>(touch.kind) != ContactKind::people || (touch.robot_speed > kContactSpeed && !excused);
}

void DeploymentEvaluator::add_contact(const docent_msgs::TrueContact& contact) {
  DeploymentReport::Contacts& contacts = report_.contacts;
  // What is no word of ours was something that stood there.
  switch (parse<ContactKind>(contact.kind).value_or(ContactKind::furniture)) {
    case ContactKind::people:
      ++(is_contact(contact) ? contacts.people : report_.bumped_by_people);
      break;
    case ContactKind::walls:
      ++contacts.walls;
      break;
    case ContactKind::hazards:
      ++contacts.hazards;
      break;
    case ContactKind::furniture:
      ++contacts.furniture;
      break;
  }
}

void DeploymentEvaluator::add_goal_state(const docent_msgs::GoalState& goal) {
  const auto state = parse<GoalStatus>(goal.state);
  goal_is_active_ = !goal.id.empty() && is_active(state);
  const bool blocked = goal_is_active_ && state == GoalStatus::blocked;
  report_.blocked.events += blocked && !is_blocked_ ? 1 : 0;
  is_blocked_ = blocked;
  if (!truth_.empty()) follow_trip(goal);
}

void DeploymentEvaluator::follow_trip(const docent_msgs::GoalState& goal) {
  const auto state = parse<GoalStatus>(goal.state);
  const bool is_under_way = goal_is_active_ && !is_relocalizing_ && state != GoalStatus::turning;
  if (trip_ && trip_->goal == goal.id && (state == GoalStatus::turning || state == GoalStatus::arrived)) {
    report_.trips.push_back(
        {to_seconds(truth_.latest_time() - trip_->begin), truth_.latest().distance_m - trip_->distance_m});
  }
  if (!is_under_way) {
    trip_.reset();
  } else if (!trip_ || trip_->goal != goal.id) {
    trip_ = Trip{goal.id, truth_.latest_time(), truth_.latest().distance_m};
  }
}

void DeploymentEvaluator::add_health(const docent_msgs::Health& health) {
  if (health.pid == 0) return;  // in virtual time modules are no processes
  const auto [place, is_new] = pids_.try_emplace(health.module, health.pid);
  if (is_new || place->second == health.pid) return;
  place->second = health.pid;
  ++restarts_seen_;
}

void DeploymentEvaluator::count_passes(const docent_msgs::TrueState& state) {
  // The nearest person's gap is given outline to outline; that tells the robot's own radius.
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& person : state.people)
    nearest = std::min(nearest,
                       distance(Point2{person.x, person.y}, {state.x, state.y}) - static_cast<double>(person.radius));
  const double robot_radius = nearest - state.nearest_person_m;
  if (!std::isfinite(robot_radius)) return is_passing_.clear();
  const bool moves = std::abs(state.linear) > kMoves;
  std::map<std::uint32_t, bool> near_by;
  for (const auto& person : state.people) {
    const double gap =
        distance(Point2{person.x, person.y}, {state.x, state.y}) - static_cast<double>(person.radius) - robot_radius;
    if (gap > kPassEnd) continue;
    const auto before = is_passing_.find(person.id);
    const bool was_passing = before != is_passing_.end() && before->second;
    const bool passes = was_passing || (gap < kPass && moves);
    report_.passes_within_1m += passes && !was_passing ? 1 : 0;
    near_by[person.id] = passes;
  }
  is_passing_ = std::move(near_by);
}

void DeploymentEvaluator::count_battery(double level) {
  battery_low_ = std::min(battery_low_, level);
  const bool rises = level > battery_low_ + kCharge;
  report_.battery.charges += rises && !is_charging_ ? 1 : 0;
  if (!truth_.empty() && level < truth_.latest().battery) {  // falls again: the charge is over
    if (rises) battery_low_ = level;
    is_charging_ = false;
  } else if (rises) {
    is_charging_ = true;
  }
  report_.battery.depleted += level <= kDepleted && !is_depleted_ ? 1 : 0;
  is_depleted_ = level <= kDepleted;
}

std::optional<DeploymentReport::Latency> DeploymentEvaluator::latency() const {
  const Quantiles& all = latency_.latencies();
  if (!(all.at(0.5) > 0.0)) return std::nullopt;
  const auto of = [](const Quantiles& ages) {
    return DeploymentReport::Age{ages.count(), ages.at(0.5), ages.at(0.99)};
  };
  return DeploymentReport::Latency{all.count(),           all.at(0.5),         all.at(0.99),
                                   latency_.unanswered(), of(ages_.beliefs()), of(ages_.hazards())};
}

DeploymentReport DeploymentEvaluator::report() const {
  DeploymentReport report = report_;
  report.latency = latency();
  if (truth_.empty()) return report;
  const Time end = truth_.latest_time();
  report.virtual_seconds = to_seconds(end - start_);
  report.distance_m = truth_.latest().distance_m - first_distance_m_;
  report.contact_seconds_wheels_turning = truth_.latest().contact_seconds - first_contact_seconds_;
  report.localization = localization_.result();
  report.people = people_.result();
  report.module_restarts = std::max(restarts_seen_, restarts_ordered_);
  requests_.fill(report, end);
  return report;
}

}  // namespace docent::evaluation
