#include "docent/collision_avoidance/watches/message_rhythm.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

void MessageRhythm::receive(Time stamp) {
  if (!stamps_.empty()) {
    const double since_newest = to_seconds(stamp - stamps_.back());
    if (since_newest < -params_.begins_anew || since_newest > params_.longest_silence) stamps_.clear();
  }
  const auto place = std::lower_bound(stamps_.begin(), stamps_.end(), stamp);
  if (place != stamps_.end() && *place == stamp) return;
  stamps_.insert(place, stamp);
  while (stamps_.back() - stamps_.front() > seconds(params_.window)) stamps_.pop_front();
  learn();
}

double MessageRhythm::since(Time time) const {
  return static_cast<double>(stamps_.end() - std::upper_bound(stamps_.begin(), stamps_.end(), time));
}

void MessageRhythm::learn() {
  const double span = to_seconds(stamps_.back() - stamps_.front());
  if (span < params_.least) return;
  const double half = 0.5 * span;
  const double late = since(stamps_.back() - seconds(half));
  const double early = static_cast<double>(stamps_.size() - 1) - late;
  const double kept = half / std::max(1.0, std::min(early, late));
  const double elapsed = std::clamp(to_seconds(stamps_.back() - learnt_), 0.0, params_.window);
  learnt_ = stamps_.back();
  if (period_ == 0.0 || kept < period_) {
    period_ = kept;
  } else {
    period_ += (1.0 - std::exp(-elapsed / params_.forgets)) * (kept - period_);
  }
}

double MessageRhythm::missing(double within) const {
  if (period_ == 0.0 || stamps_.size() < 2) return 0.0;
  const double span = std::min(within, to_seconds(stamps_.back() - stamps_.front()));
  if (span < std::min(within, params_.least)) return 0.0;
  return std::max(0.0, 1.0 - since(stamps_.back() - seconds(span)) * period_ / span);
}

}  // namespace docent::collision_avoidance
