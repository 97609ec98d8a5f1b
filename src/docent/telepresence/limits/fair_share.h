#pragma once

#include <map>
#include <string>

#include "docent/base/time.h"
#include "docent/telepresence/limits/rate_limits.h"

namespace docent::telepresence {

struct FairShareParams {
  double per_second = 100.0;  ///< of all callers together
  double burst = 10.0;        ///< that one who was silent may do at once; whoever is new a third of it
  Duration counts_for = std::chrono::seconds{10};  ///< a caller who was silent for so long takes no share
  std::size_t most = 10'000;                       ///< callers at a time; more are refused
};

/// Shares what a thin line carries evenly among those who call just now, so that nobody who calls a lot, nor many who
/// do, leave nothing for the others. One thread.
class FairShare {
 public:
  explicit FairShare(const FairShareParams& params)
      : params_{params}, all_{{kRoom * params.per_second, kAtOnce * params.per_second}} {}
  /// False: the caller, or all together, have to wait.
  [[nodiscard]] bool take(const std::string& caller, Time now);

 private:
  static constexpr double kRoom = 1.25;   ///< all shares together use up their sum: the bound is for many who are new
  static constexpr double kAtOnce = 3.0;  ///< [s] worth of what all may say at once
  struct Share {
    double tokens = 0.0;
    Time since;
  };
  void forget(Time now);

  const FairShareParams params_;
  RateLimits all_;
  std::map<std::string, Share> shares_;
  Time looked_;
};

}  // namespace docent::telepresence
