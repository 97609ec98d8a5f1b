#include "docent/telepresence/limits/call_limits.h"

namespace docent::telepresence {
namespace {

Rate of_all_far(const Rate& of_address) {
  return {CallLimits::kFarShare * of_address.per_second, CallLimits::kFarShare * of_address.burst};
}

}  // namespace

CallLimits::CallLimits(const CallRates& rates)
    : reads_{rates.reads},
      writes_{rates.writes},
      posts_{RateLimits{rates.posts}, RateLimits{of_all_far(rates.posts)}},
      reports_{RateLimits{rates.reports}, RateLimits{of_all_far(rates.reports)}} {}

CallLimits::Pace CallLimits::take(const CountedCall& call, Time now) {
  const std::scoped_lock lock{mutex_};
  if (!(call.changes ? writes_ : reads_).take(call.caller, now)) return Pace::too_fast;
  if (call.is_staff || call.scarce == Scarce::no) return Pace::fine;
  Few& few = call.scarce == Scarce::posts ? posts_ : reports_;
  const bool is_within = few.of_address.take(call.caller, now) && (!call.is_far || few.of_far.take({}, now));
  return is_within ? Pace::fine : Pace::too_often;
}

}  // namespace docent::telepresence
