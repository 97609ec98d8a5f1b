#include "docent/modules/web/operators/operator_desk.h"

#include <system_error>
#include <utility>

#include "docent/base/files.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"

namespace docent::modules {
namespace {

constexpr Duration kSteeringPeriod = std::chrono::milliseconds{100};
constexpr Duration kStale = std::chrono::milliseconds{300};  // a hand that was not heard for so long holds nothing
constexpr Duration kLeaseLasts = std::chrono::seconds{2};    // without word from its holder

}  // namespace

OperatorDesk::OperatorDesk(transport::Bus& bus, std::filesystem::path stop_file, Note note)
    : bus_{bus},
      stop_file_{std::move(stop_file)},
      note_{std::move(note)},
      steering_{bus.publisher(topics::kSteering)},
      stops_{bus.publisher(topics::kStop)},
      limits_publisher_{bus.publisher(topics::kLimits)} {
  bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& limits) { limits_ = limits; });
  // Another gateway has a stop button too.
  bus_.subscribe<docent_msgs::Stop>(topics::kStop, [this](const auto& stop) {
    if (from_message(stop.header.stamp) > from_message(stop_.header.stamp)) stop_ = stop;
  });
  if (auto by = read_file(stop_file_)) {
    stop_ = {{to_message(bus_.now()), ""}, true, *by};
    stops_.publish(stop_);
  }
  bus_.every(kSteeringPeriod, [this] { publish_steering(); });
}

std::optional<Reason> OperatorDesk::take(const telepresence::Caller& caller,
                                         const telepresence::ClientMessage& message) {
  if (const auto* lease = std::get_if<telepresence::LeaseMessage>(&message)) return take_lease(caller, lease->wants);
  if (const auto* wish = std::get_if<telepresence::SteerMessage>(&message)) return steer(caller, *wish);
  if (const auto* wish = std::get_if<telepresence::StopMessage>(&message)) return stop(caller, wish->stopped);
  if (const auto* hours = std::get_if<telepresence::SetHoursMessage>(&message)) return set_hours(caller, hours->mode);
  return std::nullopt;
}

Reason OperatorDesk::take_lease(const telepresence::Caller& caller, bool wants) {
  const bool is_holder = lease_ && lease_->holder.id == caller.id;
  if (!wants) {
    if (is_holder) release();
    return {};
  }
  if (lease_ && !is_holder) return {ReasonWord::no_lease, lease_->holder.name};
  if (!is_holder) note_(caller.name, "lease", "taken");
  lease_ = Lease{caller, {}, bus_.now()};
  return {};
}

Reason OperatorDesk::steer(const telepresence::Caller& caller, const telepresence::SteerMessage& wish) {
  if (!lease_ || lease_->holder.id != caller.id)
    return {ReasonWord::no_lease, lease_ ? lease_->holder.name : std::string{}};
  const bool is_news = lease_->wish.pressed != wish.pressed;
  lease_->wish = wish;
  lease_->heard = bus_.now();
  if (is_news) publish_steering();  // above all: a hand that lets go
  return {};
}

Reason OperatorDesk::stop(const telepresence::Caller& caller, bool is_stopped) {
  stop_ = {{to_message(bus_.now()), ""}, is_stopped, caller.name};
  stops_.publish(stop_);  // first, whatever the disk says
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

Reason OperatorDesk::set_hours(const telepresence::Caller& caller, OperatingMode mode) {
  docent_msgs::Limits limits = limits_.value_or(docent_msgs::Limits{});
  limits.mode = to_text(mode);
  limits_ = limits;
  limits_publisher_.publish(limits);
  note_(caller.name, "hours", limits.mode);
  return {};
}

void OperatorDesk::left(const telepresence::Caller& caller) {
  if (lease_ && lease_->holder.id == caller.id) release();
}

void OperatorDesk::release() {
  note_(lease_->holder.name, "lease", "given back");
  steering_.publish({{to_message(bus_.now()), ""}, lease_->holder.name, false, 0.0, 0.0});
  lease_.reset();
}

void OperatorDesk::publish_steering() {
  if (!lease_) return;
  const Duration silent = bus_.now() - lease_->heard;
  if (silent > kLeaseLasts) return release();
  const bool is_pressed = lease_->wish.pressed && silent <= kStale;
  const telepresence::SteerMessage wish = is_pressed ? lease_->wish : telepresence::SteerMessage{};
  steering_.publish({{to_message(bus_.now()), ""}, lease_->holder.name, is_pressed, wish.forward, wish.turn});
}

telepresence::documents::OperationMessage OperatorDesk::document() const {
  return {lease_ ? lease_->holder.name : "", lease_ && lease_->wish.pressed, stop_.is_stopped, stop_.by,
          limits_ ? limits_->mode : ""};
}

}  // namespace docent::modules
