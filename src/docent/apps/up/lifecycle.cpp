#include "docent/apps/up/lifecycle.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace docent::apps::up_command {
namespace {

double seconds_between(Lifecycle::Time from, Lifecycle::Time to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

void Lifecycle::started(Time now) {
  running_ = true;
  heard_since_start_ = false;
  ++starts_;
  started_at_ = now;
  heard_at_ = now;
  state_ = has_health_ ? "starting" : "running";
  reason_.clear();
}

void Lifecycle::heard(Time now, std::string state, std::string reason) {
  if (!running_) return;  // the last words of one that is gone
  heard_since_start_ = true;
  heard_at_ = now;
  state_ = std::move(state);
  reason_ = std::move(reason);
}

void Lifecycle::ended(Time now, const std::string& how) {
  const bool was_healthy = seconds_between(started_at_, now) >= params_.healthy_s;
  delay_s_ = was_healthy || delay_s_ == 0.0 ? params_.first_delay_s : std::min(params_.last_delay_s, 2.0 * delay_s_);
  running_ = false;
  ended_at_ = now;
  how_ = how;
}

double Lifecycle::silence_s(Time now) const { return has_health_ ? seconds_between(heard_at_, now) : 0.0; }

Lifecycle::Step Lifecycle::next(Time now) const {
  if (!running_) {
    return starts_ == 0 || seconds_between(ended_at_, now) >= delay_s_ ? Step::start : Step::wait;
  }
  return silence_s(now) > (heard_since_start_ ? params_.hung_s : params_.starting_s) ? Step::kill : Step::wait;
}

std::string Lifecycle::status(Time now) const {
  char text[64];
  if (starts_ == 0) return "not started";
  if (!running_) {
    const double rest = std::max(0.0, delay_s_ - seconds_between(ended_at_, now));
    std::snprintf(text, sizeof text, "), starts again in %.1f s", rest);
    return "ended (" + how_ + text;
  }
  if (silence_s(now) > params_.silent_s && heard_since_start_) {
    std::snprintf(text, sizeof text, "not responding for %.0f s", std::floor(silence_s(now)));
    return text;
  }
  return reason_.empty() ? state_ : state_ + ": " + reason_;
}

}  // namespace docent::apps::up_command
