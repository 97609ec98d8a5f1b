#pragma once

#include <optional>

#include "docent/base/time.h"

namespace docent::robot {

/// Lets the last command through while it is fresh, and zero otherwise (architecture 8.1). What is not a number is
/// zero; what is too fast is cut off.
class CommandWatchdog {
 public:
  struct Command {
    double linear = 0.0;   ///< [m/s]
    double angular = 0.0;  ///< [rad/s]
    friend bool operator==(const Command&, const Command&) = default;
  };

  /// @param patience  [s] after its receipt a command is void
  CommandWatchdog(double patience, double max_speed, double max_turn_rate)
      : patience_{patience}, max_speed_{max_speed}, max_turn_rate_{max_turn_rate} {}

  void receive(Time now, const Command& command);
  [[nodiscard]] Command output(Time now) const;
  [[nodiscard]] bool is_fresh(Time now) const;

 private:
  double patience_;
  double max_speed_;
  double max_turn_rate_;
  Command command_;
  std::optional<Time> received_;
};

}  // namespace docent::robot
