#include "docent/people/standing_things.h"

#include <algorithm>
#include <cmath>

#include "docent/geometry/point_transform.h"

namespace docent::people {
namespace {

constexpr int kSurelyFree = 5;                              // sweeps in a row
constexpr double kJustBegun = 3.0;                          // [s]
constexpr double kThingSide = 0.2;                          // [m]
constexpr Duration kRemembered = std::chrono::minutes{30};  // without being seen again
constexpr double kSurely = 1.0 + 1e-9;                      // more than rounding may do
constexpr double kSlow = 0.05;                              // how fast a place follows what is seen there

}  // namespace

Result<void> StandingThingParams::validate() const {
  if (!(person_stands > 0.0)) return fail("things.person_stands must be > 0");
  if (!(person_odds > 1.0)) return fail("things.person_odds must be > 1");
  if (!(same_place > 0.0)) return fail("things.same_place must be > 0");
  if (!(unwatched >= 0.0)) return fail("things.unwatched must be >= 0");
  return {};
}

double StandingThingParams::patience() const { return person_stands * std::log(person_odds); }

const StandingThings::Place* StandingThings::nearest(Point2 in_map) const {
  const Place* best = nullptr;
  double least = params_.same_place;
  for (const Place& place : places_) {
    const Point2 off = place.in_map - in_map;
    if (dot(off, off) > kSurely * least * least) continue;  // most: no root is needed for them
    const double away = norm(off);
    if (away > least) continue;
    least = away;
    best = &place;
  }
  return best;
}

void StandingThings::see(Point2 in_map, bool came, Time now) {
  if (const Place* known = nearest(in_map)) {
    Place& place = places_[static_cast<std::size_t>(known - places_.data())];
    place.stood += std::min(params_.unwatched, std::max(0.0, to_seconds(now - place.seen)));
    place.in_map = place.in_map + kSlow * (in_map - place.in_map);
    // A place that was taken before did not become free for a newcomer.
    place.came = place.came || (came && place.stood < kJustBegun);
    place.seen = now;
    place.seen_free = 0;
    return;
  }
  places_.push_back({in_map, 0.0, came, 0, now});
}

void StandingThings::forget(const Sightlines& sightlines, const Pose2& odom_from_map, Point2 robot_in_map, double range,
                            Time now) {
  const PointTransform of_points{odom_from_map};
  std::erase_if(places_, [&](Place& place) {
    if (now - place.seen > kRemembered) return true;
    if (distance(place.in_map, robot_in_map) > range) return false;
    if (sightlines.look(of_points * place.in_map, kThingSide) != Look::free) {
      place.seen_free = 0;
      return false;
    }
    return ++place.seen_free >= kSurelyFree;
  });
}

bool StandingThings::is_thing(Point2 in_map) const {
  const Place* place = nearest(in_map);
  return place != nullptr && !place->came && place->stood > params_.patience();
}

}  // namespace docent::people
