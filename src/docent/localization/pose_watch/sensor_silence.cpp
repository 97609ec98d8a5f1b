#include "docent/localization/pose_watch/sensor_silence.h"

#include <utility>

namespace docent::localization {

SensorSilence::SensorSilence(std::vector<std::string> names, Duration limit)
    : names_{std::move(names)}, limit_{limit}, heard_(names_.size()) {}

std::optional<std::string> SensorSilence::first_silent(Time now) const {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (now - heard_[i] > limit_) return names_[i];
  return std::nullopt;
}

}  // namespace docent::localization
