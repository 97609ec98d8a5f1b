#include "docent/transport/reader_watch.h"

#include <algorithm>

namespace docent::transport {
namespace {

double seconds_between(ReaderWatch::Clock::time_point from, ReaderWatch::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

void ReaderWatch::hear(Clock::time_point at) {
  if (count_ > 0) {
    const double interval = std::min(seconds_between(heard_, at), params_.least);
    period_ = count_ == 1 ? interval : period_ + params_.learning * (interval - period_);
  }
  heard_ = at;
  ++count_;
  wait_ = 0.0;
}

bool ReaderWatch::is_deaf(Clock::time_point at, bool lives) {
  if (count_ < params_.regular || !lives) return false;
  if (wait_ == 0.0) wait_ = std::max(params_.least, params_.periods * period_);
  if (seconds_between(heard_, at) < wait_) return false;
  wait_ += std::min(2.0 * wait_, params_.most);
  return true;
}

}  // namespace docent::transport
