#include "docent/collision_avoidance/watches/clock_offset.h"

#include <algorithm>
#include <cmath>

namespace docent {

bool ClockOffset::receive(Time now, Time stamp) {
  constexpr double kCreep = 0.0005;  // [s/s] more than two quartz clocks drift apart
  constexpr double kFuture = 1.0;    // [s] before what the clock said so far
  constexpr double kAgree = 0.3;     // [s]
  constexpr int kEnough = 3;         // messages that agree: the clock was set
  const double delay = to_seconds(now - stamp);
  if (received_ && delay < least_ - kFuture) {
    early_count_ = early_count_ > 0 && std::abs(delay - early_) < kAgree ? early_count_ + 1 : 1;
    early_ = delay;
    if (early_count_ < kEnough) return false;
  }
  early_count_ = 0;
  const double since = received_ ? std::max(0.0, to_seconds(now - *received_)) : 0.0;
  least_ = received_ ? std::min(least_ + kCreep * since, delay) : delay;
  lateness_ = delay - least_;
  received_ = now;
  return true;
}

}  // namespace docent
