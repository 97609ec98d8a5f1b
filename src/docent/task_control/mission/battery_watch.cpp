#include "docent/task_control/mission/battery_watch.h"

#include <algorithm>
#include <cmath>

namespace docent::task_control {

void BatteryWatch::report(double charge, std::optional<bool> is_charging, Time now) {
  if (!charge_ || is_charging != is_charging_ || now <= step_began_) {
    step_charge_ = charge;
    step_began_ = now;
  }
  charge_ = charge;
  is_charging_ = is_charging;
  heard_ = extrapolated_from_ = now;
  const double change = charge - step_charge_;
  if (std::abs(change) < kStep) return;
  const double rate = change / to_seconds(now - step_began_);
  if (rate > 0.0) {
    rise_ = std::clamp(rate, expected_rise_ / kMost, expected_rise_ * kMost);
  } else {
    drain_ = std::clamp(-rate, expected_drain_, expected_drain_ * kMost);
  }
  step_charge_ = charge;
  step_began_ = now;
}

std::optional<double> BatteryWatch::charge(Time now) const {
  if (!is_silent(now)) return charge_;
  const double rate = is_charging_.value_or(false) ? 0.0 : -drain_;
  return std::clamp(*charge_ + rate * to_seconds(now - extrapolated_from_), 0.0, 1.0);
}

void BatteryWatch::is_away_from_charger(Time now) {
  if (!is_silent(now) || !is_charging_.value_or(false)) return;
  is_charging_.reset();
  extrapolated_from_ = now;
}

}  // namespace docent::task_control
