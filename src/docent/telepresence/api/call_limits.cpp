#include "docent/telepresence/api/call_limits.h"

#include <algorithm>

#include "docent/telepresence/limits/network.h"

namespace docent::telepresence {
namespace {

constexpr double kReadsAtOnce = 10.0;   // [s] worth of them
constexpr double kWritesAtOnce = 20.0;  // [s] likewise
constexpr double kFarShare = 5.0;       // addresses that all who come from far away count as

/// So many in a while, and as many at once.
Rate in_a_while(double count, const ForumParams& forum) { return {count / forum.while_s, std::max(1.0, count)}; }

}  // namespace

CallLimits::CallLimits(const ApiParams& params, const ForumParams& forum)
    : reads_{{params.reads_per_second, std::max(1.0, kReadsAtOnce * params.reads_per_second)}},
      writes_{{params.writes_per_second, std::max(1.0, kWritesAtOnce * params.writes_per_second)}},
      posts_{RateLimits{in_a_while(forum.posts_of_address, forum)},
             RateLimits{in_a_while(kFarShare * forum.posts_of_address, forum)}},
      reports_{RateLimits{in_a_while(forum.reports_of_address, forum)},
               RateLimits{in_a_while(kFarShare * forum.reports_of_address, forum)}} {}

std::optional<ApiFault> CallLimits::why_not(const ApiRequest& request, const Endpoint& endpoint, bool is_staff,
                                            Time now) {
  const std::string network = network_of(request.address);
  const std::scoped_lock lock{mutex_};
  if (!(endpoint.changes() ? writes_ : reads_).take(is_staff ? "login " + request.token : network, now))
    return ApiFault::too_fast;
  if (is_staff || endpoint.scarce == Scarce::no) return std::nullopt;
  Few& few = endpoint.scarce == Scarce::posts ? posts_ : reports_;
  const bool is_within = few.of_address.take(network, now) && (!request.is_far || few.of_far.take({}, now));
  return is_within ? std::nullopt : std::optional{ApiFault::too_often};
}

}  // namespace docent::telepresence
