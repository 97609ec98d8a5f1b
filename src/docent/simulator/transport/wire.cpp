#include "docent/simulator/transport/wire.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::simulator {
namespace {

constexpr double kMinute = 60.0;              // [s]
constexpr double kShortestHold = 0.2;         // of the longest
constexpr double kInBurst[] = {2e-4, 1e-3};   // [s] between messages that were held
constexpr double kOvertaken[] = {0.02, 0.1};  // [s] such a message comes later
constexpr double kSecond[] = {0.0, 0.05};     // [s] its double comes later

}  // namespace

Result<void> WireParams::validate() const {
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (!(delay >= 0.0 && delay <= 2.0)) return fail("delay must be 0..2");
  if (!(jitter >= 0.0 && jitter <= 1.0)) return fail("jitter must be 0..1");
  if (!(hiccups >= 0.0 && hiccups <= 600.0)) return fail("hiccups must be 0..600");
  if (!(hold >= 0.001 && hold <= 10.0)) return fail("hold must be 0.001..10");
  if (stamps != "sending" && stamps != "receipt" && stamps != "moving" && stamps != "zero")
    return fail("stamps must be sending, receipt, moving or zero, not '" + stamps + "'");
  for (const auto& [name, value] : {std::pair{"reorder", reorder}, std::pair{"twice", twice}, std::pair{"drop", drop}})
    if (!is_share(value)) return fail(std::string{name} + " must be 0..1");
  if (!(std::abs(clock) <= 1e6)) return fail("clock must be -1e6..1e6");
  if (!(std::abs(drift) <= 0.01)) return fail("drift must be -0.01..0.01");
  if (!(std::abs(set_back) <= 1e4)) return fail("set_back must be -1e4..1e4");
  if (!(every >= 1.0 && every <= 1e8)) return fail("every must be 1..1e8");
  return {};
}

Wire::Wire(const WireParams& params, const Rng& rng, Time begins)
    : params_{params},
      rng_{rng},
      begins_{begins},
      last_{begins - Duration{1}},
      next_hiccup_{begins},
      held_until_{begins},
      news_{begins} {
  if (params_.hiccups > 0.0) next_hiccup_ = begins + seconds(rng_.exponential(kMinute / params_.hiccups));
}

Time Wire::by_clock(Time time) const {
  const double since = to_seconds(time - begins_);
  return time + seconds(params_.clock + params_.drift * since - params_.set_back * std::floor(since / params_.every));
}

Time Wire::free_at(Time now) {
  while (params_.hiccups > 0.0 && now >= next_hiccup_) {
    held_until_ = std::max(held_until_, next_hiccup_ + seconds(params_.hold * rng_.uniform(kShortestHold, 1.0)));
    next_hiccup_ = next_hiccup_ + seconds(rng_.exponential(kMinute / params_.hiccups));
  }
  Time free = std::max(now + seconds(params_.delay), held_until_);
  if (params_.jitter > 0.0) free = std::max(free, now + seconds(params_.delay + rng_.uniform(0.0, params_.jitter)));
  return free > last_ ? free : last_ + seconds(rng_.uniform(kInBurst[0], kInBurst[1]));
}

Time Wire::stamp(Time now, Time comes, bool is_news) {
  if (params_.stamps == "zero") return {};
  if (params_.stamps == "receipt") return by_clock(comes);
  if (params_.stamps == "moving" && !is_news) return news_;
  return news_ = by_clock(now);
}

std::vector<Wire::Delivery> Wire::carry(Time now, bool is_news) {
  Time comes = free_at(now);
  if (rng_.chance(params_.drop)) return {};
  if (rng_.chance(params_.reorder)) {
    comes = comes + seconds(rng_.uniform(kOvertaken[0], kOvertaken[1]));
  } else {
    last_ = comes;
  }
  const Time stamped = stamp(now, comes, is_news);
  std::vector<Delivery> deliveries{{comes - now, stamped}};
  if (rng_.chance(params_.twice))
    deliveries.push_back({comes - now + seconds(rng_.uniform(kSecond[0], kSecond[1])), stamped});
  return deliveries;
}

}  // namespace docent::simulator
