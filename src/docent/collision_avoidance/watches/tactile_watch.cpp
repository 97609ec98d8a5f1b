#include "docent/collision_avoidance/watches/tactile_watch.h"

#include <algorithm>

namespace docent::collision_avoidance {

void TactileWatch::feel(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan) {
  freshness_.receive(now, stamp);
  repeats_ = scan != 0 && scan == scan_ ? repeats_ + 1 : 0;
  scan_ = scan;
  const auto gone = std::count(segments.begin(), segments.end(), kNoReading);
  const double share = segments.empty() ? 0.0 : static_cast<double>(gone) / static_cast<double>(segments.size());
  missing_ += params_.memory * (share - missing_);
}

std::optional<Complaint> TactileWatch::complaint(Time now, bool required) const {
  if (!(freshness_.period() > 0.0) && !required) return std::nullopt;
  if (freshness_.is_silent(now, params_.complaints.patience)) return Complaint{0.0, "the tactile ring is silent"};
  auto found = complaint_of(freshness_, now, "tactile ring's word", params_.complaints);
  if (repeats_ >= params_.repeats) found = worse(found, Complaint{0.0, "the tactile ring is frozen"});
  if (missing_ > params_.many_missing)
    found = worse(found, Complaint{missing_ > params_.nearly_all ? 0.0 : params_.complaints.crippled_speed,
                                   "the tactile ring gives too few readings"});
  return found;
}

}  // namespace docent::collision_avoidance
