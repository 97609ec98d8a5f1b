#include "docent/telepresence/limits/fair_share.h"

#include <algorithm>

namespace docent::telepresence {
namespace {

constexpr double kOfNewcomers = 1.0 / 3.0;

}  // namespace

bool FairShare::take(const std::string& caller, Time now) {
  forget(now);
  auto place = shares_.find(caller);
  if (place == shares_.end()) {
    if (shares_.size() >= params_.most) return false;
    place = shares_.emplace(caller, Share{std::max(1.0, kOfNewcomers * params_.burst), now}).first;
  }
  Share& share = place->second;
  const double rate = params_.per_second / static_cast<double>(shares_.size());
  share.tokens = std::min(params_.burst, share.tokens + rate * std::max(0.0, to_seconds(now - share.since)));
  share.since = std::max(share.since, now);
  if (share.tokens < 1.0) return false;
  share.tokens -= 1.0;  // also where all together have to wait: nobody saves up what they could not say
  return all_.take({}, now);
}

void FairShare::forget(Time now) {
  if (now - looked_ < std::chrono::seconds{1}) return;
  looked_ = now;
  std::erase_if(shares_, [&](const auto& entry) { return now - entry.second.since > params_.counts_for; });
}

}  // namespace docent::telepresence
