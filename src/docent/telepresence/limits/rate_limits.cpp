#include "docent/telepresence/limits/rate_limits.h"

#include <algorithm>
#include <vector>

namespace docent::telepresence {

double RateLimits::tokens(const Bucket& bucket, Time now) const {
  const double passed = std::max(0.0, to_seconds(now - bucket.since));
  return std::min(rate_.burst, bucket.tokens + rate_.per_second * passed);
}

bool RateLimits::take(const std::string& caller, Time now) {
  auto place = buckets_.find(caller);
  if (place == buckets_.end()) {
    if (buckets_.size() >= most_) forget(now);
    place = buckets_.emplace(caller, Bucket{rate_.burst, now}).first;
  }
  Bucket& bucket = place->second;
  bucket = {tokens(bucket, now), std::max(bucket.since, now)};
  if (bucket.tokens < 1.0) return false;
  bucket.tokens -= 1.0;
  return true;
}

void RateLimits::forget(Time now) {
  // Half of them at a time, so that it is seldom done.
  std::vector<double> levels;
  for (const auto& [caller, bucket] : buckets_) levels.push_back(tokens(bucket, now));
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  const double level = *middle;
  std::size_t left = (buckets_.size() + 1) / 2;
  std::erase_if(buckets_,
                [&](const auto& entry) { return left > 0 && tokens(entry.second, now) >= level && left-- > 0; });
}

}  // namespace docent::telepresence
