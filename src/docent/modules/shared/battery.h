#pragma once

#include <cstdint>
#include <optional>

#include "docent/messages/standard_messages.h"

namespace docent::modules {

/// A message that nobody has filled in. Drivers leave `present` false whether there is a battery or not.
[[nodiscard]] inline bool says_nothing(const sensor_msgs::BatteryState& battery) {
  return !battery.present && battery.percentage == 0.0F && !(battery.voltage > 0.0F) && !(battery.charge > 0.0F);
}
/// The charger says that the battery is full, and holds it there.
[[nodiscard]] inline bool is_full(const sensor_msgs::BatteryState& battery) {
  constexpr std::uint8_t kFull = 4;
  return battery.power_supply_status == kFull;
}

/// Whether the battery says that it charges, or is full at its charger; nullopt: it says nothing of this.
[[nodiscard]] inline std::optional<bool> is_charging(const sensor_msgs::BatteryState& battery) {
  constexpr std::uint8_t kUnknown = 0;
  constexpr std::uint8_t kCharging = 1;
  if (battery.power_supply_status == kUnknown) return std::nullopt;
  return battery.power_supply_status == kCharging || is_full(battery);
}

}  // namespace docent::modules
