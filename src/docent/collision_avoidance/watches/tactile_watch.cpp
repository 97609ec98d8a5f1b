#include "docent/collision_avoidance/watches/tactile_watch.h"

#include <algorithm>

namespace docent {

namespace {

constexpr double kPatience = 0.8;  // [s]
constexpr int kRepeats = 2;        // one may be a message that was sent twice
constexpr double kMemory = 0.4;    // a message's share in the running mean
constexpr double kManyMissing = 0.25;
constexpr double kNearlyAll = 0.9;

}  // namespace

void TactileWatch::feel(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan) {
  freshness_.receive(now, stamp);
  repeats_ = scan != 0 && scan == scan_ ? repeats_ + 1 : 0;
  scan_ = scan;
  const auto gone = std::count(segments.begin(), segments.end(), kNoReading);
  const double share = segments.empty() ? 0.0 : static_cast<double>(gone) / static_cast<double>(segments.size());
  missing_ += kMemory * (share - missing_);
}

std::optional<Complaint> TactileWatch::complaint(Time now, bool required) const {
  if (!(freshness_.period() > 0.0) && !required) return std::nullopt;
  if (freshness_.silence(now) > std::max(kPatience, 2.5 * freshness_.period()))
    return Complaint{0.0, "the tactile ring is silent"};
  auto found = complaint_of(freshness_, now, "tactile ring's word", kPatience);
  if (repeats_ >= kRepeats) found = worse(found, Complaint{0.0, "the tactile ring is frozen"});
  if (missing_ > kManyMissing)
    found = worse(found,
                  Complaint{missing_ > kNearlyAll ? 0.0 : kCrippledSpeed, "the tactile ring gives too few readings"});
  return found;
}

}  // namespace docent
