#include "docent/collision_avoidance/watches/ring_watch.h"

#include <cmath>

namespace docent::collision_avoidance {

void RingWatch::hear(Time now, Time stamp, std::size_t index, double range, bool is_echo, const Pose2& odom_from_base) {
  if (ring_.size() <= index) ring_.resize(index + 1);
  any_.receive(now, stamp);
  ring_[index].freshness.receive(now, stamp);
  missing_ += params_.memory * ((std::isnan(range) ? 1.0 : 0.0) - missing_);
  if (!std::isnan(range)) watch_for_freeze(ring_[index], range, is_echo, odom_from_base);
}

void RingWatch::watch_for_freeze(Sensor& sensor, double range, bool is_echo, const Pose2& odom_from_base) {
  const double heard = is_echo ? range : -1.0;
  if (heard != sensor.range) {
    sensor.range = heard;
    sensor.odom_from_base = odom_from_base;
    repeats_ = 0;
    return;
  }
  const Pose2 moved = inverse(sensor.odom_from_base) * odom_from_base;
  if (is_echo && (norm(moved.position()) > params_.moved || std::abs(moved.theta.radians()) > params_.turned))
    ++repeats_;
}

std::optional<std::size_t> RingWatch::silent_pair(Time now) const {
  const auto is_silent = [&](std::size_t index) {
    const Freshness& sensor = ring_[index % ring_.size()].freshness;
    return sensor.period() > 0.0 && sensor.is_silent(now, params_.patience);
  };
  for (std::size_t i = 0; i < ring_.size(); ++i)
    if (is_silent(i) && is_silent(i + 1)) return i;
  return std::nullopt;
}

std::optional<Complaint> RingWatch::complaint(Time now, bool required) const {
  if (ring_.empty() && !required) return std::nullopt;
  auto found = complaint_of(any_, now, one_, params_.complaints);
  if (const auto pair = silent_pair(now); pair && !found)
    found = {0.0, "no fresh " + one_ + " of number " + std::to_string(*pair) + " and the next"};
  if (repeats_ >= params_.repeats) found = worse(found, Complaint{0.0, "the " + all_ + " are frozen"});
  if (missing_ > params_.many_missing)
    found = worse(found, Complaint{missing_ > params_.nearly_all ? 0.0 : params_.complaints.crippled_speed,
                                   "the " + all_ + " give too few readings"});
  return found;
}

}  // namespace docent::collision_avoidance
