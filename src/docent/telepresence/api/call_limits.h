#pragma once

#include <mutex>

#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/limits/rate_limits.h"

namespace docent::telepresence {

/// How often somebody may call /api/v1, by where they come from. Any thread.
class CallLimits {
 public:
  CallLimits(const ApiParams& params, const ForumParams& forum);

  /// nullopt: the call may be made.
  /// @param is_staff  they are known to have an account: what strangers do from their address is no matter of theirs
  [[nodiscard]] std::optional<ApiFault> why_not(const ApiRequest& request, const Endpoint& endpoint, bool is_staff,
                                                Time now);

 private:
  struct Few {
    RateLimits of_address;
    RateLimits of_far;  ///< of all far visitors, from wherever they are said to come
  };
  std::mutex mutex_;
  RateLimits reads_, writes_;
  Few posts_, reports_;
};

}  // namespace docent::telepresence
