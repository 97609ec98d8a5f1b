#include "docent/collision_avoidance/avoider/input_watches.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

std::optional<Complaint> InputWatches::complaint_of_laser(Time now, std::size_t index,
                                                          const ObstacleMemory& memory) const {
  const std::string& name = lasers_[index];
  // What is said of its sweeps comes first: readings that are not believed are missing, too.
  auto found = worse(scanners_[index].complaint(), complaint_of(sweeps_[index], now, "sweep of the " + name));
  if (memory.is_frozen(index)) found = worse(Complaint{0.0, "the " + name + " is frozen"}, found);
  const double missing = memory.invalid_share(index);
  if (!found && missing > params_.nearly_all) return Complaint{0.0, "the " + name + " gives no readings"};
  if (missing > params_.many_missing)
    found = worse(found, Complaint{params_.crippled_speed, "the " + name + " gives too few readings"});
  return found;
}

std::optional<Complaint> InputWatches::complaint_of_lasers(Time now, const ObstacleMemory& memory) const {
  std::optional<Complaint> found;
  for (std::size_t i = 0; i < lasers_.size(); ++i) {
    auto of_this = complaint_of_laser(now, i, memory);
    if (found && of_this) of_this->reason = found->reason + "; " + of_this->reason;  // each is named
    if (of_this) of_this->max_speed = std::min(of_this->max_speed, found ? found->max_speed : of_this->max_speed);
    if (of_this) found = std::move(of_this);
  }
  return found;
}

std::optional<Complaint> InputWatches::complaint(Time now, const ObstacleMemory& memory) const {
  auto found = odometry_.complaint(now);
  found = worse(std::move(found), complaint_of_lasers(now, memory));
  if (params_.needs_sonar) found = worse(found, sonars_.complaint(now, true));
  found = worse(found, tactile_.complaint(now, params_.has_tactile));
  found = worse(found, infrareds_.complaint(now, params_.has_infrared));
  for (const auto& [name, freshness] : cameras_) {
    if (freshness.is_stale(now, params_.camera_patience))
      found = worse(found, Complaint{0.0, "no fresh lines of the camera " + name});
  }
  if (virtual_.silence(now) > params_.virtual_timeout)
    found = worse(found, Complaint{0.0, "no fresh virtual measurements"});
  return found;
}

void InputWatches::cap_by_age(Time now, double max_speed, SpeedCap& cap) const {
  const auto cap_by = [&](const Freshness& freshness, const std::string& name) {
    const double share = std::clamp(1.0 - (freshness.age(now) - params_.fresh) / params_.fading, 0.0, 1.0);
    cap.lower(max_speed * share, "the " + name + " comes late");
  };
  cap_by(odometry_.freshness(), "odometry");
  for (std::size_t i = 0; i < lasers_.size(); ++i) cap_by(sweeps_[i], "sweep of the " + lasers_[i]);
}

void InputWatches::cap_by_proof(SpeedCap& cap) const {
  for (std::size_t i = 0; i < scanners_.size(); ++i)
    if (scanners_[i].is_unproven())
      cap.lower(scanners_[i].unproven_speed(), "nothing has borne out the " + lasers_[i] + " yet");
}

void InputWatches::cap_by_position(Time now, double driven, double max_speed, SpeedCap& cap) const {
  const double age = virtual_.age(now);
  const double worn = std::min((age - params_.position_fresh) / (params_.virtual_timeout - params_.position_fresh),
                               driven / params_.position_worn);
  cap.lower(max_speed * std::clamp(1.0 - worn, 0.0, 1.0), "the position is not fresh");
}

bool InputWatches::await_sweep(Time now, double soon) const {
  return std::any_of(sweeps_.begin(), sweeps_.end(), [&](const Freshness& freshness) {
    return std::abs(freshness.period() - freshness.silence(now)) <
           std::min(soon, params_.nearly_due * freshness.period());
  });
}

}  // namespace docent::collision_avoidance
