#include "docent/collision_avoidance/clocks/local_time.h"

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
  // Who turns stamps into local time before it hands them on, as `localize` does, keeps our clock.
  std::optional<double> offset;
  if (clock.least_delay() >= -params_.disagreement) offset = 0.0;
  for (const auto& [name, source] : sources_) {
    const double candidate = offset_of(source) - source.clock.set_back();
    if (candidate <= clock.least_delay() + params_.disagreement)
      offset = std::max(offset.value_or(candidate), candidate);
  }
  return std::min(now, stamp + seconds(offset.value_or(0.0)));
}

double LocalTime::offset_of(const Source& source) const {
  // As if no clock had been set back: by how much is known of each.
  const double own = source.clock.least_delay() - source.clock.set_back();
  double least = own;
  for (const auto& [name, other] : sources_) {
    const double delay = other.clock.least_delay() - other.clock.set_back();
    if (delay >= own - source.honest_way) least = std::min(least, delay);
  }
  const bool is_ours = least >= -params_.disagreement && least <= source.honest_way;
  return source.clock.set_back() + (is_ours ? 0.0 : least);
}

}  // namespace docent::collision_avoidance
