#include "docent/collision_avoidance/freshness.h"

#include <algorithm>
#include <cmath>

namespace docent {

void Freshness::receive(Time now, Time stamp) {
  constexpr double kCreep = 0.0005;  // [s/s] more than two quartz clocks drift apart
  constexpr double kFuture = 1.0;    // [s] before what the clock said so far
  constexpr double kAgree = 0.3;     // [s]
  constexpr int kEnough = 3;         // messages that agree: the clock was set
  const double delay = to_seconds(now - stamp);
  if (received_ && delay < offset_ - kFuture) {
    early_count_ = early_count_ > 0 && std::abs(delay - early_) < kAgree ? early_count_ + 1 : 1;
    early_ = delay;
    if (early_count_ < kEnough) return;  // not received: it may be of any age
  }
  early_count_ = 0;
  if (!received_) {
    offset_ = delay;
  } else {
    const double since = std::max(0.0, to_seconds(now - *received_));
    offset_ = std::min(offset_ + kCreep * since, delay);
    // A pause must not teach us that pauses are normal.
    const double interval = period_ > 0.0 ? std::min(since, 2.0 * period_) : std::min(since, 1.0);
    period_ = period_ > 0.0 ? period_ + 0.1 * (interval - period_) : interval;
  }
  lateness_ = delay - offset_;
  received_ = now;
}

double Freshness::silence(Time now) const {
  return received_ ? to_seconds(now - *received_) : std::numeric_limits<double>::infinity();
}

double Freshness::age(Time now) const { return silence(now) + lateness_; }

bool Freshness::is_stale(Time now, double least) const { return age(now) > std::max(least, 2.5 * period_); }

}  // namespace docent
