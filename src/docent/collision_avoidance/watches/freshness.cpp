#include "docent/collision_avoidance/watches/freshness.h"

#include <algorithm>

namespace docent::collision_avoidance {

void Freshness::receive(Time now, Time stamp) {
  if (!clock_.receive(now, stamp)) return;
  if (received_) {
    const double since = std::max(0.0, to_seconds(now - *received_));
    const double longest = period_ > 0.0 ? params_.longest_pause * period_ : params_.first_period;
    const double interval = std::min(since, longest);
    period_ = period_ > 0.0 ? period_ + params_.learning * (interval - period_) : interval;
  }
  received_ = now;
}

double Freshness::silence(Time now) const {
  return received_ ? to_seconds(now - *received_) : std::numeric_limits<double>::infinity();
}

double Freshness::age(Time now) const { return silence(now) + clock_.lateness(); }

double Freshness::patience(double least) const { return std::max(least, params_.stale_periods * period_); }

}  // namespace docent::collision_avoidance
