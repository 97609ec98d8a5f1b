#include "docent/localization/judgement/hindrance.h"

#include <cmath>
#include <cstdio>

namespace docent::localization {
namespace {

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f m", value);
  return text;
}

}  // namespace

std::string hindrance_of(const Doubt& doubt, const VerdictParams& params) {
  constexpr double kMuchUnmapped = 0.3;  // of the walls
  if (doubt.mass <= 0.0) return "it has seen nothing yet";
  if (doubt.contradiction > params.most_contradiction)
    return percent(doubt.contradiction) +
           " of the readings pass through walls of the map; if that stays so, a mount, a range or the map is wrong";
  if (doubt.agreement < params.least_agreement)
    return "the map explains only " + percent(doubt.agreement) + " of the readings: people all round, or another map";
  if (doubt.unmapped > kMuchUnmapped) return percent(doubt.unmapped) + " of the walls in sight are not on the map";
  if (doubt.share < params.enough_share)
    return "the likeliest place has " + percent(doubt.share) + ", others look like it";
  if (doubt.mass < params.enough_mass) return "the likeliest place has " + percent(doubt.mass) + " of the belief";
  if (doubt.spread > params.widest_spread) return "the place is known to " + metres(doubt.spread) + " only";
  if (doubt.confirmation < 1.0) return "the place is not borne out yet: it has to move and look on";
  return {};
}

}  // namespace docent::localization
