#include "docent/mapping/expectation_maximization/place.h"

#include <algorithm>
#include <cmath>

namespace docent::mapping {
namespace {

/// One point a cell along the beam, up to a cell before its end.
void append_free(Point2 from, Point2 to, double cell, std::vector<Point2>& free) {
  const double length = distance(from, to);
  for (double d = 0.5 * cell; d < length - 1.5 * cell; d += cell) free.push_back(from + (d / length) * (to - from));
}

/// Scans `first` to `last`, seen from the middle one.
SeenPlace place_of(std::span<const MappingScan> scans, std::size_t first, std::size_t last, double reach, double cell) {
  SeenPlace place;
  place.scan = (first + last) / 2;
  std::vector<Point2> occupied;
  std::vector<Point2> free;
  for (std::size_t i = first; i <= last; ++i) {
    const Pose2 middle_from_scan = inverse(scans[place.scan].odom_from_base) * scans[i].odom_from_base;
    for (const SurfacePoint& point : scans[i].points) {
      const Point2 at = middle_from_scan * point.at;
      const Point2 sensor = middle_from_scan * scans[i].sensors.front();
      if (norm(at) > reach) continue;
      occupied.push_back(at);
      append_free(sensor, at, cell, free);
    }
  }
  place.occupied = thinned_points(occupied, cell);
  place.free = thinned_points(free, cell);
  return place;
}

}  // namespace

std::vector<SeenPlace> places_of(std::span<const MappingScan> scans, const PlaceParams& params, double cell) {
  std::vector<SeenPlace> places;
  std::size_t first = 0;
  double way = 0.0;
  double turn = 0.0;
  double way_of_place = 0.0;
  double turn_of_place = 0.0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (i > 0) {
      const Pose2 step = inverse(scans[i - 1].odom_from_base) * scans[i].odom_from_base;
      way += norm(step.position());
      turn += std::abs(step.theta.radians());
    }
    const bool is_last = i + 1 == scans.size();
    if (way - way_of_place < params.way && turn - turn_of_place < params.turn && !is_last) continue;
    SeenPlace place = place_of(scans, first, i, params.reach, cell);
    if (!places.empty()) {
      place.before_from_here = inverse(scans[places.back().scan].odom_from_base) * scans[place.scan].odom_from_base;
      place.way = way - way_of_place;
      place.turn = turn - turn_of_place;
    }
    places.push_back(std::move(place));
    way_of_place = way;
    turn_of_place = turn;
    first = i;
  }
  return places;
}

}  // namespace docent::mapping
