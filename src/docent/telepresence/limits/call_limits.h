#pragma once

#include <mutex>
#include <string>

#include "docent/base/time.h"
#include "docent/telepresence/limits/rate_limits.h"

namespace docent::telepresence {

/// What one address may do little of, however many people come from it.
enum class Scarce { no, posts, reports };

/// Of one address.
struct CallRates {
  Rate reads, writes;   ///< calls, and of these those that change something
  Rate posts, reports;  ///< of what is scarce
};

/// A call, as far as it is counted.
struct CountedCall {
  std::string caller;     ///< a network (limits/network.h); of somebody with an account what they alone have
  bool is_staff = false;  ///< what strangers do from their address is no matter of theirs
  bool is_far = false;    ///< from where they come is what a gateway far away says
  bool changes = false;
  Scarce scarce = Scarce::no;
};

/// How often somebody may call, by where they come from. Any thread.
class CallLimits {
 public:
  static constexpr double kFarShare = 5.0;  ///< addresses that all who come from far away count as

  explicit CallLimits(const CallRates& rates);
  enum class Pace { fine, too_fast, too_often };
  [[nodiscard]] Pace take(const CountedCall& call, Time now);

 private:
  struct Few {
    RateLimits of_address;
    RateLimits of_far;  ///< of all far visitors together
  };
  std::mutex mutex_;
  RateLimits reads_, writes_;
  Few posts_, reports_;
};

}  // namespace docent::telepresence
