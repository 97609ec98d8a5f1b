#include "docent/robot/watchdog.h"

#include <algorithm>
#include <cmath>

namespace docent::robot {

void CommandWatchdog::receive(Time now, const Command& command) {
  received_ = now;
  if (!std::isfinite(command.linear) || !std::isfinite(command.angular)) {
    command_ = {};
    return;
  }
  command_ = {std::clamp(command.linear, -max_speed_, max_speed_),
              std::clamp(command.angular, -max_turn_rate_, max_turn_rate_)};
}

bool CommandWatchdog::is_fresh(Time now) const {
  return received_ && now >= *received_ && now - *received_ <= seconds(patience_);
}

CommandWatchdog::Command CommandWatchdog::output(Time now) const { return is_fresh(now) ? command_ : Command{}; }

}  // namespace docent::robot
