#include "docent/modules/shared/museum_mode.h"

#include <algorithm>

namespace docent::modules {

std::string MuseumMode::name(Time now) const {
  return is_by_hours() ? museum::mode_at(museum_, minute_of_day(now)) : limits_->mode;
}

const museum::Mode* MuseumMode::mode(Time now) const {
  const auto place = museum_.modes.find(name(now));
  return place == museum_.modes.end() ? nullptr : &place->second;
}

std::optional<double> MuseumMode::max_speed(Time now) const {
  const auto allowed = allowed_speed(now);
  if (unknown_speed_ <= 0.0) return allowed;
  return allowed ? std::min(*allowed, unknown_speed_) : unknown_speed_;
}

std::optional<double> MuseumMode::allowed_speed(Time now) const {
  if (!is_by_hours()) return limits_->max_speed;
  const museum::Mode* present = mode(now);
  if (present == nullptr) return limits_ ? std::optional{limits_->max_speed} : std::nullopt;
  return limits_ ? std::min(present->max_speed, limits_->max_speed) : present->max_speed;
}

double MuseumMode::wait_s(Time now) const {
  const museum::Mode* present = mode(now);
  return present == nullptr ? 0.0 : present->wait_s;
}

double MuseumMode::volume(Time now) const {
  const double allowed = limits_ ? std::clamp(limits_->volume, 0.0, 1.0) : 1.0;
  return allowed * museum::volume_at(museum_, minute_of_day(now));
}

}  // namespace docent::modules
