#include "docent/collision_avoidance/watches/local_time.h"

#include <algorithm>
#include <optional>

namespace docent::collision_avoidance {

Time LocalTime::receive(const std::string& source, Time now, Time stamp, double honest_way) {
  Source& known = sources_[source];
  known.honest_way = honest_way;
  known.clock.receive(now, stamp);
  return std::min(now, stamp + seconds(offset_of(known)));
}

Time LocalTime::receive_handed_on(const std::string& topic, Time now, Time stamp) {
  ClockOffset& clock = handed_on_[topic];
  clock.receive(now, stamp);
  std::optional<double> offset;
  for (const auto& [name, source] : sources_) {
    const double candidate = offset_of(source);
    if (candidate <= clock.least_delay() + params_.disagreement)
      offset = std::max(offset.value_or(candidate), candidate);
  }
  return std::min(now, stamp + seconds(offset.value_or(0.0)));
}

double LocalTime::offset_of(const Source& source) const {
  double least = source.clock.least_delay();
  for (const auto& [name, other] : sources_) {
    const double delay = other.clock.least_delay();
    if (delay >= source.clock.least_delay() - source.honest_way) least = std::min(least, delay);
  }
  return least >= -params_.disagreement && least <= source.honest_way ? 0.0 : least;
}

}  // namespace docent::collision_avoidance
