#include "docent/telepresence/service/operator_desk.h"

#include <system_error>
#include <utility>

#include "docent/base/files.h"
#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

constexpr Duration kStale = std::chrono::milliseconds{300};  // a hand that was not heard for so long holds nothing
constexpr Duration kLeaseLasts = std::chrono::seconds{2};    // without word from its holder

}  // namespace

OperatorDesk::OperatorDesk(RobotLink& robot, std::filesystem::path stop_file, Note note, Time now)
    : robot_{robot}, stop_file_{std::move(stop_file)}, note_{std::move(note)} {
  if (auto by = read_file(stop_file_)) {
    stop_ = {{to_message(now), ""}, true, *by};
    robot_.tell(stop_);
  }
}

void OperatorDesk::see(const docent_msgs::Stop& stop) {
  if (from_message(stop.header.stamp) > from_message(stop_.header.stamp)) stop_ = stop;
}

std::optional<Reason> OperatorDesk::take(const Caller& caller, const ClientMessage& message, Time now) {
  if (const auto* lease = std::get_if<LeaseMessage>(&message)) return take_lease(caller, lease->wants, now);
  if (const auto* wish = std::get_if<SteerMessage>(&message)) return steer(caller, *wish, now);
  if (const auto* wish = std::get_if<StopMessage>(&message)) return stop(caller, wish->stopped, now);
  if (const auto* hours = std::get_if<SetHoursMessage>(&message)) return set_hours(caller, hours->mode);
  return std::nullopt;
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

Reason OperatorDesk::stop(const Caller& caller, bool is_stopped, Time now) {
  stop_ = {{to_message(now), ""}, is_stopped, caller.name};
  robot_.tell(stop_);  // first, whatever the disk says
  note_(caller.name, "stop", is_stopped ? "pressed" : "released");
  fault_.clear();
  std::error_code error;
  if (is_stopped) {
    if (auto kept = write_file_atomically(stop_file_, caller.name); !kept) fault_ = kept.error().message;
  } else if (std::filesystem::remove(stop_file_, error); error) {
    fault_ = stop_file_.string() + ": cannot be removed: " + error.message();
  }
  return {};
}

Reason OperatorDesk::set_hours(const Caller& caller, OperatingMode mode) {
  docent_msgs::Limits limits = limits_.value_or(docent_msgs::Limits{});
  limits.mode = to_text(mode);
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
  return {lease_ ? lease_->holder.name : "", lease_ && lease_->wish.pressed, stop_.is_stopped, stop_.by,
          limits_ ? limits_->mode : ""};
}

}  // namespace docent::telepresence
