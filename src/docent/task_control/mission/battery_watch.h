#pragma once

#include <optional>

#include "docent/base/time.h"

namespace docent::task_control {

/// What the battery says of itself, and at what rates its charge falls and rises. Charge: share of a full battery,
/// 0..1. Both rates are measured over steps of kStep; the discharge is never taken for slower than expected, for a
/// robot that stands still now will drive. While the battery is silent, its charge is extrapolated: it falls, and where
/// it charged before, it stays, for nobody knows whether it still does. Deterministic.
class BatteryWatch {
 public:
  static constexpr double kStep = 0.02;
  static constexpr double kMost = 4.0;  ///< times the expected rate: what is faster is a battery that corrects itself

  /// @param drain_per_s, charge_per_s  expected [1/s], > 0
  BatteryWatch(double drain_per_s, double charge_per_s)
      : expected_drain_{drain_per_s}, expected_rise_{charge_per_s}, drain_{drain_per_s}, rise_{charge_per_s} {}

  /// @param is_charging  nullopt: the battery does not say
  void report(double charge, std::optional<bool> is_charging, Time now);

  /// nullopt: nothing was ever heard of it.
  [[nodiscard]] std::optional<double> charge(Time now) const;
  /// nullopt: it does not say, or it said that it charges and is silent now.
  [[nodiscard]] std::optional<bool> is_charging(Time now) const {
    return is_silent(now) && is_charging_.value_or(false) ? std::nullopt : is_charging_;
  }
  /// The robot is not at its charger: a silent battery that charged before no longer does.
  void is_away_from_charger(Time now);
  [[nodiscard]] double drain_per_s() const { return drain_; }
  [[nodiscard]] double charge_per_s() const { return rise_; }
  /// Nothing was heard for longer than kSilent, though it spoke before.
  [[nodiscard]] bool is_silent(Time now) const { return charge_ && now - heard_ > kSilent; }

 private:
  static constexpr Duration kSilent = std::chrono::seconds{10};  ///< batteries report once a second

  double expected_drain_;
  double expected_rise_;
  double drain_;
  double rise_;
  std::optional<double> charge_;
  std::optional<bool> is_charging_;
  Time heard_;
  Time extrapolated_from_;
  double step_charge_ = 0.0;  ///< where the present step began
  Time step_began_;
};

}  // namespace docent::task_control
