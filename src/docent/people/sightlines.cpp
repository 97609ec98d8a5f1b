#include "docent/people/sightlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::people {
namespace {

constexpr double kBefore = 0.15;  // [m] before the near side

}  // namespace

Sightlines::Sightlines(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_base)
    : base_from_odom_{inverse(odom_from_base)}, beams_{sweep.beams} {
  std::stable_sort(
      beams_.begin(), beams_.end(),
      [](const sensor_models::SweepBeam& a, const sensor_models::SweepBeam& b) { return a.bearing < b.bearing; });
}

template <class F>
bool Sightlines::for_each_towards(Point2 in_odom, double radius, F&& f) const {
  constexpr double kMiddle = 0.7;  // of the radius: beams at the rim may pass
  const Point2 place = base_from_odom_ * in_odom;
  const double away = norm(place);
  if (away <= radius) return false;
  const double middle = std::atan2(place.y, place.x);
  const double half = std::asin(std::min(1.0, kMiddle * radius / away));
  for (const double turn : {-2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi}) {
    const double first = middle + turn - half;
    const double last = middle + turn + half;
    if (beams_.empty() || last < beams_.front().bearing || first > beams_.back().bearing) continue;
    auto beam = std::lower_bound(beams_.begin(), beams_.end(), first,
                                 [](const sensor_models::SweepBeam& b, double bearing) { return b.bearing < bearing; });
    for (; beam != beams_.end() && beam->bearing <= last; ++beam) f(*beam, away);
  }
  return true;
}

Look Sightlines::look(Point2 in_odom, double radius) const {
  constexpr double kBehind = 0.35;  // [m]
  int passing = 0;
  int before = 0;
  int all = 0;
  const bool is_outside = for_each_towards(in_odom, radius, [&](const sensor_models::SweepBeam& beam, double away) {
    ++all;
    passing += beam.no_return || beam.range > away + kBehind ? 1 : 0;
    before += !beam.no_return && beam.range < away - radius - kBefore ? 1 : 0;
  });
  if (!is_outside) return Look::unclear;
  if (2 * passing > all) return Look::free;
  if (2 * before > all) return Look::hidden;
  return Look::unclear;
}

double Sightlines::share_on(Point2 in_odom, double radius) const {
  constexpr double kRim = 0.12;  // [m]
  const Point2 place = base_from_odom_ * in_odom;
  int on = 0;
  int open = 0;
  const bool is_outside = for_each_towards(in_odom, radius, [&](const sensor_models::SweepBeam& beam, double away) {
    if (!beam.no_return && beam.range < away - radius - kBefore) return;
    ++open;
    on +=
        !beam.no_return && std::abs(distance(sensor_models::endpoint(beam), place) - radius) < kRim && beam.range < away
            ? 1
            : 0;
  });
  return is_outside && open > 0 ? static_cast<double>(on) / open : 1.0;
}

}  // namespace docent::people
