#include "docent/task_control/mission/staff_call.h"

#include <algorithm>
#include <cmath>

namespace docent::task_control {
namespace {

/// What is wrong with the charger itself, not with the way there.
bool is_of_charger(const Reason& why) {
  return why.word() == ReasonWord::charger_occupied || why.word() == ReasonWord::charger_no_current;
}

constexpr Duration kFirstLook = std::chrono::seconds{60};  // at the charger, until its gauge must have risen

}  // namespace

Result<void> StaffCallParams::validate() const {
  if (!(call_below >= 0.0 && call_below <= 1.0)) return fail("staff.call_below must be in 0..1");
  if (!(trouble_below >= 0.0 && trouble_below <= 1.0)) return fail("staff.trouble_below must be in 0..1");
  if (trouble_tries < 1) return fail("staff.trouble_tries must be >= 1");
  if (way_tries < 1) return fail("staff.way_tries must be >= 1");
  if (!(call_again_s > 0.0)) return fail("staff.call_again_s must be > 0");
  if (!(retry_most_s >= 0.0)) return fail("staff.retry_most_s must be >= 0");
  if (!(current_s > 0.0)) return fail("staff.current_s must be > 0");
  return {};
}

void StaffCall::failed(const Reason& why) {
  why_ = why;
  ++failures_;
}

void StaffCall::docked() {
  if (why_.word() != ReasonWord::charger_no_current) why_ = {};
}

double StaffCall::retry_s(double first_s) const {
  const double doubled = first_s * std::exp2(std::clamp(failures_ - 1, 0, 10));
  return std::max(first_s, std::min(doubled, params_.retry_most_s));
}

void StaffCall::watch_current(double charge, bool is_at_charger, bool is_full, Time now) {
  if (!is_at_charger) return dock_.reset();
  if (!dock_) dock_ = Dock{now, charge, charge, now};
  const bool rises = charge >= dock_->most + kStep;
  if (rises) {
    dock_->most = charge;
    dock_->rose = now;
  }
  if (is_full || (rises && charge >= dock_->began_with + kRise)) {  // whatever was wrong is over
    why_ = {};
    failures_ = 0;
    told_.reset();
    dock_->gives_none = false;
    return;
  }
  const bool is_in_vain = charge <= dock_->most - kFall || now - dock_->rose >= seconds(params_.current_s);
  if (!is_in_vain || dock_->gives_none) return;
  dock_ = Dock{now, charge, charge, now, true};
  failed(ReasonWord::charger_no_current);
}

bool StaffCall::is_time_to_call(double charge, Time now) const {
  const bool is_soon_charged = dock_ && !dock_->gives_none && now - dock_->rose < kFirstLook;
  const bool is_low = charge < params_.call_below && !is_soon_charged;
  const bool is_trouble = is_of_charger(why_)
                              ? failures_ >= (charge < params_.trouble_below ? 1 : params_.trouble_tries)
                              : failures_ >= params_.way_tries;
  if (!is_low && (why_.is_none() || !is_trouble)) return false;
  return !told_ || told_->why != reason() || now - told_->when >= seconds(params_.call_again_s);
}

std::optional<Happening> StaffCall::watch(double charge, bool is_at_charger, bool is_full, Time now) {
  watch_current(charge, is_at_charger, is_full, now);
  if (!is_time_to_call(charge, now)) return std::nullopt;
  told_ = Told{reason(), now};
  return Happening{EventKind::staff_called, reason().text(), words(), charge};
}

Reason StaffCall::reason() const { return why_.is_none() ? Reason{ReasonWord::battery_low} : why_; }

std::string StaffCall::words() const {
  const Reason why = reason();
  if (why.word() == ReasonWord::charger_occupied) return "something stands on the charger: please clear it";
  if (why.word() == ReasonWord::charger_no_current) return "the charger gives no current: please look at it";
  if (why.word() == ReasonWord::battery_low) return "the battery is low and does not charge yet";
  return "the robot does not get to its charger (" + why.text() + ")";
}

}  // namespace docent::task_control
