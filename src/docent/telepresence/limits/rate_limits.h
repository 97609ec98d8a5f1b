#pragma once

#include <map>
#include <string>

#include "docent/base/time.h"

namespace docent::telepresence {

/// What one caller may do: `burst` at once, then `per_second`.
struct Rate {
  double per_second = 1.0;
  double burst = 10.0;
};

/// A token bucket for each of many callers. Memory is bounded: of too many, those who have used least are forgotten,
/// which gives them what they had anyway. One thread.
class RateLimits {
 public:
  explicit RateLimits(Rate rate, std::size_t most = 10'000) : rate_{rate}, most_{most} {}
  /// False: the caller has to wait.
  [[nodiscard]] bool take(const std::string& caller, Time now);
  [[nodiscard]] std::size_t size() const { return buckets_.size(); }

 private:
  struct Bucket {
    double tokens;
    Time since;
  };
  [[nodiscard]] double tokens(const Bucket& bucket, Time now) const;
  void forget(Time now);

  Rate rate_;
  std::size_t most_;
  std::map<std::string, Bucket> buckets_;
};

}  // namespace docent::telepresence
