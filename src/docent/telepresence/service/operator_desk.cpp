#include "docent/telepresence/service/operator_desk.h"

#include <algorithm>
#include <utility>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

constexpr Duration kStale = std::chrono::milliseconds{300};  // a hand that was not heard for so long holds nothing
constexpr Duration kConfirmedWithin = std::chrono::seconds{2};
constexpr Duration kLeaseLasts = std::chrono::seconds{2};  // without word from its holder

}  // namespace

OperatorDesk::OperatorDesk(RobotLink& robot, StopRegister& button, Note note, std::map<std::string, double> mode_speeds)
    : robot_{robot}, button_{button}, note_{std::move(note)}, mode_speeds_{std::move(mode_speeds)} {}

bool OperatorDesk::take(const Caller& caller, const ClientMessage& message, Time now) {
  if (const auto* lease = std::get_if<LeaseMessage>(&message)) {
    answers_.push_back({caller.id, lease->id, take_lease(caller, lease->wants, now)});
  } else if (const auto* steering = std::get_if<SteerMessage>(&message)) {
    const Reason why_not = steer(caller, *steering, now);
    if (!why_not.is_none()) answers_.push_back({caller.id, {}, why_not});
  } else if (const auto* wish = std::get_if<StopMessage>(&message)) {
    stop(caller, *wish, now);
  } else if (const auto* hours = std::get_if<SetHoursMessage>(&message)) {
    answers_.push_back({caller.id, hours->id, set_hours(caller, hours->mode)});
  } else {
    return false;
  }
  return true;
}

Reason OperatorDesk::take_lease(const Caller& caller, bool wants, Time now) {
  const bool is_holder = lease_ && lease_->holder.id == caller.id;
  if (!wants) {
    if (is_holder) release(now);
    return {};
  }
  if (lease_ && !is_holder) return {ReasonWord::no_lease, lease_->holder.name};
  if (!is_holder) note_(caller.name, "lease", "taken");
  lease_ = Lease{caller, {}, now};
  return {};
}

Reason OperatorDesk::steer(const Caller& caller, const SteerMessage& wish, Time now) {
  if (!lease_ || lease_->holder.id != caller.id)
    return {ReasonWord::no_lease, lease_ ? lease_->holder.name : std::string{}};
  const bool is_news = lease_->wish.pressed != wish.pressed;
  lease_->wish = wish;
  lease_->heard = now;
  if (is_news) steer_on(now);  // above all: a hand that lets go
  return {};
}

void OperatorDesk::stop(const Caller& caller, const StopMessage& wish, Time now) {
  if (wish.stopped) {
    button_.press(caller.role == Role::kiosk ? "the robot's screen" : caller.name);
  } else if (!button_.release(caller.name, static_cast<std::uint64_t>(wish.number)) && button_.state().is_stopped) {
    answers_.push_back({caller.id, wish.id, {ReasonWord::another_stop, button_.state().by}});
    return;
  }
  robot_.tell_stop();
  unconfirmed_.push_back({caller.id, wish.id, button_.state().number, now + kConfirmedWithin});
  note_(button_.state().by, "stop", wish.stopped ? "pressed" : "released");
}

std::vector<OperatorDesk::Answer> OperatorDesk::answers(Time now) {
  std::erase_if(unconfirmed_, [&](const Unconfirmed& order) {
    const bool is_confirmed = button_.is_confirmed(order.number, now);
    if (!is_confirmed && now < order.given_up) return false;
    answers_.push_back({order.viewer, order.id, is_confirmed ? Reason{} : Reason{ReasonWord::stop_unconfirmed}});
    return true;
  });
  return std::exchange(answers_, {});
}

std::optional<double> OperatorDesk::speed_in(const std::string& mode) const {
  if (parse<OperatingMode>(mode) == OperatingMode::hours) {
    std::optional<double> fastest;
    for (const auto& [name, speed] : mode_speeds_) fastest = std::max(fastest.value_or(speed), speed);
    return fastest;
  }
  const auto place = mode_speeds_.find(mode);
  return place == mode_speeds_.end() ? std::nullopt : std::optional{place->second};
}

void OperatorDesk::see(const docent_msgs::Limits& limits) {
  const bool is_own = limits_ && limits_->mode == limits.mode && limits_->max_speed == limits.max_speed;
  if (!is_own) {  // what this desk has told comes back, too
    const auto allowed = speed_in(limits.mode);
    slower_ = !allowed || limits.max_speed < *allowed ? std::optional{limits.max_speed} : std::nullopt;
  }
  limits_ = limits;
}

Reason OperatorDesk::set_hours(const Caller& caller, OperatingMode mode) {
  docent_msgs::Limits limits = limits_.value_or(docent_msgs::Limits{});
  limits.mode = to_text(mode);
  // Each mode has a pace of its own; whoever wanted the robot slower than its mode still does.
  limits.max_speed = speed_in(limits.mode).value_or(limits.max_speed);
  if (slower_) limits.max_speed = std::min(limits.max_speed, *slower_);
  limits_ = limits;
  robot_.tell(limits);
  note_(caller.name, "hours", limits.mode);
  return {};
}

void OperatorDesk::left(const Caller& caller, Time now) {
  if (lease_ && lease_->holder.id == caller.id) release(now);
}

void OperatorDesk::release(Time now) {
  note_(lease_->holder.name, "lease", "given back");
  robot_.tell(docent_msgs::Steering{{to_message(now), ""}, lease_->holder.name, false, 0.0, 0.0});
  lease_.reset();
}

void OperatorDesk::steer_on(Time now) {
  if (!lease_) return;
  const Duration silent = now - lease_->heard;
  if (silent > kLeaseLasts) return release(now);
  const bool is_pressed = lease_->wish.pressed && silent <= kStale;
  const SteerMessage wish = is_pressed ? lease_->wish : SteerMessage{};
  robot_.tell(docent_msgs::Steering{{to_message(now), ""}, lease_->holder.name, is_pressed, wish.forward, wish.turn});
}

documents::OperationMessage OperatorDesk::document() const {
  return {lease_ ? lease_->holder.name : "",
          lease_ && lease_->wish.pressed,
          button_.state().is_stopped,
          button_.state().by,
          static_cast<int>(button_.state().number),
          limits_ ? limits_->mode : ""};
}

}  // namespace docent::telepresence
