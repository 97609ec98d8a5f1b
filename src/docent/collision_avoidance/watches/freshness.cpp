#include "docent/collision_avoidance/watches/freshness.h"

#include <algorithm>

namespace docent {

void Freshness::receive(Time now, Time stamp) {
  if (!clock_.receive(now, stamp)) return;
  if (received_) {
    const double since = std::max(0.0, to_seconds(now - *received_));
    // A pause must not teach us that pauses are normal.
    const double interval = period_ > 0.0 ? std::min(since, 2.0 * period_) : std::min(since, 1.0);
    period_ = period_ > 0.0 ? period_ + 0.1 * (interval - period_) : interval;
  }
  received_ = now;
}

double Freshness::silence(Time now) const {
  return received_ ? to_seconds(now - *received_) : std::numeric_limits<double>::infinity();
}

double Freshness::age(Time now) const { return silence(now) + clock_.lateness(); }

bool Freshness::is_stale(Time now, double least) const { return age(now) > std::max(least, 2.5 * period_); }

}  // namespace docent
