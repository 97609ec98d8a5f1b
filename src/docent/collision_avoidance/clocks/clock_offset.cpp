#include "docent/collision_avoidance/clocks/clock_offset.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {
namespace {

constexpr double kLearning = 0.1;  // an interval's share in the usual one
constexpr double kHalf = 0.5;      // of a rise: who comes back so far was overtaken

}  // namespace

void ClockOffset::watch_for_set_back(double interval, Time stamp, double delay) {
  const bool is_pause = interval > params_.pause * interval_;
  const auto least_lately = [this] { return *std::min_element(delays_.begin(), delays_.end()); };
  // A silence that explains why it comes later: nothing before it is of account.
  if (is_pause && interval > kHalf * (delay - least_lately())) delays_.fill(delay);
  const double before = least_lately();
  if (stamp < newest_ && !suspicion_ && delay > before + params_.step) suspicion_ = {before, delay - before, delay};
  if (!suspicion_) {
    newest_ = std::max(newest_, stamp);
    return;
  }
  if (delay < suspicion_->before + kHalf * suspicion_->rise) {  // that one was overtaken
    suspicion_.reset();
    newest_ = std::max(newest_, stamp);
    return;
  }
  suspicion_->least = is_pause ? delay : std::min(suspicion_->least, delay);
  suspicion_->lasts = suspicion_->count == 0 || is_pause ? 0.0 : suspicion_->lasts + interval;
  suspicion_->count = is_pause ? 1 : suspicion_->count + 1;
  if (suspicion_->count < params_.bear_out || suspicion_->lasts < params_.caution) return;
  const double step = suspicion_->least - suspicion_->before;
  set_back_ += step;
  least_ = std::min(least_ + step, suspicion_->least);
  newest_ = stamp;
  suspicion_.reset();
}

bool ClockOffset::receive(Time now, Time stamp) {
  const double delay = to_seconds(now - stamp);
  if (received_ && delay < least_ - params_.future) {
    early_count_ = early_count_ > 0 && std::abs(delay - early_) < params_.agree ? early_count_ + 1 : 1;
    early_ = delay;
    if (early_count_ < params_.enough) return false;
    newest_ = stamp;
    delays_.fill(delay);
  }
  early_count_ = 0;
  const double since = received_ ? std::max(0.0, to_seconds(now - *received_)) : 0.0;
  const double before = least_;
  least_ = received_ ? std::min(least_ + params_.creep * since, delay) : delay;
  if (delay < before) set_back_ = std::max(0.0, set_back_ - (before - delay));  // it was set by less, or forward again
  if (received_) {
    watch_for_set_back(since, stamp, delay);
    interval_ += (interval_ > 0.0 ? kLearning : 1.0) * (since - interval_);
  } else {
    newest_ = stamp;
    delays_.fill(delay);
  }
  delays_[turn_++ % kLately] = delay;
  lateness_ = delay - least_;
  received_ = now;
  return true;
}

}  // namespace docent::collision_avoidance
