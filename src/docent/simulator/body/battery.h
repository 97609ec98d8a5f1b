#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace docent::simulator {

/// The battery: about two hours of driving at 0.5 m/s, four of standing; 75 minutes at the charger fill it.
class Battery {
 public:
  /// @param dt [s], @param speed [m/s] of the wheels
  void step(double dt, double speed, bool is_charging) {
    constexpr double kCapacity = 560.0 * 3600.0;  // [J]
    constexpr double kStanding = 140.0;           // [W] computers and sensors
    constexpr double kDriving = 140.0;            // [W] more, at 0.5 m/s
    constexpr double kCharger = 600.0;            // [W]
    power_ = kStanding + kDriving * std::min(1.5, std::abs(speed) / 0.5);
    if (is_charging) power_ -= kCharger;
    is_charging_ = is_charging;
    charge_ = std::clamp(charge_ - power_ * dt / kCapacity, 0.0, 1.0);
  }
  [[nodiscard]] double charge() const { return charge_; }  ///< 0..1
  [[nodiscard]] bool is_empty() const { return charge_ <= 0.0; }
  [[nodiscard]] bool is_charging() const { return is_charging_; }
  [[nodiscard]] double voltage() const { return 22.0 + 4.0 * charge_; }  ///< [V]
  [[nodiscard]] double current() const { return -power_ / voltage(); }   ///< [A], negative: discharging
  /// What its driver says of charging from now on.
  enum class Word { truth, charges, nothing };
  void say(Word word) { word_ = word; }
  /// As sensor_msgs/BatteryState has it.
  [[nodiscard]] std::uint8_t supply_status() const {
    constexpr std::uint8_t kUnknown = 0, kCharging = 1, kDischarging = 2, kFull = 4;
    if (word_ == Word::nothing) return kUnknown;
    if (word_ == Word::charges) return kCharging;
    return !is_charging_ ? kDischarging : charge_ >= 1.0 ? kFull : kCharging;
  }
  void set_charge(double charge) { charge_ = std::clamp(charge, 0.0, 1.0); }

 private:
  double charge_ = 1.0;
  double power_ = 0.0;
  bool is_charging_ = false;
  Word word_ = Word::truth;
};

}  // namespace docent::simulator
