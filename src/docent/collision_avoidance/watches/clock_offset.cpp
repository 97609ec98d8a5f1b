#include "docent/collision_avoidance/watches/clock_offset.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

bool ClockOffset::receive(Time now, Time stamp) {
  const double delay = to_seconds(now - stamp);
  if (received_ && delay < least_ - params_.future) {
    early_count_ = early_count_ > 0 && std::abs(delay - early_) < params_.agree ? early_count_ + 1 : 1;
    early_ = delay;
    if (early_count_ < params_.enough) return false;
  }
  early_count_ = 0;
  const double since = received_ ? std::max(0.0, to_seconds(now - *received_)) : 0.0;
  least_ = received_ ? std::min(least_ + params_.creep * since, delay) : delay;
  lateness_ = delay - least_;
  received_ = now;
  return true;
}

}  // namespace docent::collision_avoidance
