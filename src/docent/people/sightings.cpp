#include "docent/people/sightings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/geometry/point_transform.h"
#include "docent/people/body_fit.h"

namespace docent::people {
namespace {

struct Point {
  Point2 at;  ///< odom
  double range = 0.0;
  std::size_t order = 0;  ///< of its beam by bearing
  bool by_map = false;
  bool is_mapped = false;
  bool has_come = false;
};
struct Run : std::vector<Point> {
  bool are_legs = false;  ///< two narrow ones
};

/// Two beams on one body lie nearer to each other than this: the step at the rim of a disc, and the beams' distance.
double neighbour_gap(double range) { return 0.10 + 0.05 * range; }

double width_of(const Run& run) { return distance(run.front().at, run.back().at); }

std::vector<std::size_t> by_bearing(const sensor_models::RangeSweep& sweep) {
  std::vector<std::size_t> order(sweep.beams.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sweep.beams[a].bearing < sweep.beams[b].bearing; });
  return order;
}

/// Consecutive points without a step. `beams` in the whole turn; the last run may go on in the first.
std::vector<Run> runs_of(const std::vector<Point>& points, std::size_t beams) {
  constexpr std::size_t kMostSkipped = 3;  // stray readings between
  std::vector<Run> runs;
  const auto goes_on = [](const Point& a, const Point& b, std::size_t skipped) {
    return skipped <= kMostSkipped && distance(a.at, b.at) <= neighbour_gap(std::min(a.range, b.range));
  };
  for (const Point& point : points) {
    if (runs.empty() || !goes_on(runs.back().back(), point, point.order - runs.back().back().order))
      runs.emplace_back();
    runs.back().push_back(point);
  }
  if (runs.size() > 1 && goes_on(runs.back().back(), runs.front().front(),
                                 runs.front().front().order + beams - runs.back().back().order)) {
    runs.back().insert(runs.back().end(), runs.front().begin(), runs.front().end());
    runs.erase(runs.begin());
  }
  return runs;
}

/// Narrow runs side by side become one.
void join_legs(std::vector<Run>& runs, const SightingParams& params) {
  constexpr double kLeg = 0.3;  // [m]
  for (std::size_t i = 0; i + 1 < runs.size();) {
    const Run& left = runs[i];
    const Run& right = runs[i + 1];
    const bool joins = width_of(left) < kLeg && width_of(right) < kLeg &&
                       distance(left.back().at, right.front().at) < params.legs_apart &&
                       distance(left.front().at, right.back().at) < params.one_person;
    if (!joins) {
      ++i;
      continue;
    }
    runs[i].insert(runs[i].end(), right.begin(), right.end());
    runs[i].are_legs = true;
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
}

/// A run of returns that stands by itself: both neighbours end clearly behind it.
class Isolation {
 public:
  Isolation(const sensor_models::RangeSweep& sweep, const std::vector<std::size_t>& order)
      : sweep_{sweep}, order_{order} {}
  /// `first`, `last`: in the order of bearings.
  [[nodiscard]] bool holds(std::size_t first, std::size_t last) const {
    return is_behind(first, first + order_.size() - 1) && is_behind(last, last + 1);
  }

 private:
  [[nodiscard]] bool is_behind(std::size_t edge, std::size_t neighbour) const {
    constexpr double kBehind = 0.4;  // [m]
    const sensor_models::SweepBeam& here = sweep_.beams[order_[edge % order_.size()]];
    const sensor_models::SweepBeam& next = sweep_.beams[order_[neighbour % order_.size()]];
    return next.no_return || next.range > here.range + kBehind;
  }
  const sensor_models::RangeSweep& sweep_;
  const std::vector<std::size_t>& order_;
};

/// What the map does not know: only what has come, or stands by itself as narrow as a person.
void keep_what_may_be_people(std::vector<Run>& runs, const Isolation& isolation, const SightingParams& params) {
  constexpr double kNarrowest = 0.06;  // [m]
  std::erase_if(runs, [&](Run& run) {
    const bool known = std::any_of(run.begin(), run.end(), [](const Point& point) { return point.by_map; });
    if (known) return false;
    const double width = width_of(run);
    if (width > kNarrowest && width < params.one_person && isolation.holds(run.front().order, run.back().order))
      return false;
    std::erase_if(run, [](const Point& point) { return !point.has_come; });
    return run.empty();
  });
}

/// Neighbouring beams that end on one face: no beam passes between them, and none meets another leg behind.
bool is_unbroken(const Point& a, const Point& b) {
  constexpr double kStep = 0.08;                       // [m]
  constexpr double kBetween = 0.12;                    // [m] beams of a degree at 6 m
  const bool are_neighbours = b.order <= a.order + 1;  // less where bearings wrap round
  return are_neighbours && std::abs(b.range - a.range) < kStep && distance(a.at, b.at) < kBetween;
}

PersonSighting sighting_of(const Run& run, const Body& body, double thing_gain, const FreeMemory& memory,
                           const SightingParams& params) {
  constexpr double kRim = 0.15;    // [m]
  constexpr double kPiece = 10.0;  // [nat] that a piece of a thing is rather a thing
  PersonSighting sighting;
  sighting.position = body.centre;
  sighting.radius = body.radius;
  int by_map = 0;
  int come = 0;
  int things = 0;
  const Point* first = nullptr;  // of an unbroken piece
  const Point* last = nullptr;
  for (const Point& point : run) {
    if (!run.are_legs && std::abs(distance(point.at, body.centre) - body.radius) > kRim) continue;
    if (last == nullptr || !is_unbroken(*last, point)) first = &point;
    last = &point;
    sighting.breadth = std::max(sighting.breadth, distance(first->at, point.at));
    ++sighting.points;
    by_map += point.by_map ? 1 : 0;
    sighting.is_mapped = sighting.is_mapped || point.is_mapped;
    come += point.has_come ? 1 : 0;
    things += !point.has_come && memory.is_thing(point.at) ? 1 : 0;
  }
  sighting.by_map = by_map > 0 && 2 * by_map >= sighting.points;
  sighting.has_come = come > 0 && 2 * come >= sighting.points;
  sighting.thing_gain = thing_gain;
  if (!sighting.has_come && things > params.part_of_thing * sighting.points) sighting.thing_gain = kPiece;
  return sighting;
}

/// What was there before and shows itself to be a thing.
void remember_thing(const Run& run, double thing_gain, FreeMemory& memory, const SightingParams& params) {
  if (thing_gain <= params.surely_thing) return;
  if (std::any_of(run.begin(), run.end(), [](const Point& point) { return point.has_come; })) return;
  for (const Point& point : run) memory.mark_thing(point.at);
}

/// Two legs are one body, unless two people are known to stand there, one half hidden.
void join_bodies(BodyFit& fit, std::span<const Point2> points, Point2 sensor, std::span<const Point2> known) {
  constexpr double kWithin = 0.4;   // [m]
  constexpr double kRadius = 0.22;  // [m]
  constexpr double kBehind = 0.1;   // [m] a body's middle behind the near side of its legs
  const auto here = std::count_if(known.begin(), known.end(), [&](Point2 place) {
    return std::any_of(points.begin(), points.end(), [&](Point2 point) { return distance(place, point) < kWithin; });
  });
  if (fit.bodies.size() < 2 || here >= 2) return;
  const Point2 middle = 0.5 * (points.front() + points.back());
  fit.bodies = {{middle + kBehind * unit(direction(sensor, middle)), kRadius, static_cast<int>(points.size())}};
}

/// Legs in mid-stride, or with somebody seen between them, are two sightings nearer to each other than people stand.
void join_near(std::vector<PersonSighting>& people) {
  constexpr double kOne = 0.32;  // [m] less than the 0.38 m that people keep: a middle errs
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t j = i + 1; j < people.size();) {
      PersonSighting& one = people[i];
      const PersonSighting& other = people[j];
      if (distance(one.position, other.position) >= kOne) {
        ++j;
        continue;
      }
      const double share = static_cast<double>(other.points) / (one.points + other.points);
      one.position = one.position + share * (other.position - one.position);
      one.radius = std::max(one.radius, other.radius);
      one.breadth = std::max(one.breadth, other.breadth);
      one.points += other.points;
      one.by_map = one.by_map || other.by_map;
      one.is_mapped = one.is_mapped || other.is_mapped;
      one.has_come = one.has_come || other.has_come;
      one.thing_gain = std::min(one.thing_gain, other.thing_gain);
      people.erase(people.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
}

}  // namespace

Result<void> SightingParams::validate() const {
  if (!(range > 0.0)) return fail("sightings.range must be > 0");
  if (!(least_points >= 1)) return fail("sightings.least_points must be >= 1");
  if (!(legs_apart >= 0.0)) return fail("sightings.legs_apart must be >= 0");
  if (!(one_person > 0.0)) return fail("sightings.one_person must be > 0");
  if (!(surely_thing > 0.0)) return fail("sightings.surely_thing must be > 0");
  if (!(part_of_thing >= 0.0 && part_of_thing <= 1.0)) return fail("sightings.part_of_thing must be in 0..1");
  return {};
}

std::vector<PersonSighting> find_people(const PeopleSweep& seen, FreeMemory& memory, std::span<const Point2> known,
                                        const SightingParams& params) {
  const std::vector<std::size_t> order = by_bearing(seen.sweep);
  // Beams that the map explains part the runs; those it knows nothing of are looked at apart.
  std::vector<Point> unmapped;
  std::vector<Point> unknown;
  const PointTransform odom_from_base{seen.odom_from_base};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const sensor_models::SweepBeam& beam = seen.sweep.beams[order[i]];
    const sensor_models::BeamOrigin origin = seen.origins[order[i]];
    if (beam.no_return || beam.range > params.range || origin == sensor_models::BeamOrigin::map) continue;
    const Point2 at = odom_from_base * sensor_models::endpoint(beam);
    const Point point{at,
                      beam.range,
                      i,
                      origin == sensor_models::BeamOrigin::not_map,
                      origin != sensor_models::BeamOrigin::unknown,
                      memory.has_come(at)};
    (origin == sensor_models::BeamOrigin::unknown ? unknown : unmapped).push_back(point);
  }
  std::vector<Run> runs = runs_of(unmapped, order.size());
  std::erase_if(runs, [](const Run& run) {  // what only may be the map is no person by itself
    return std::none_of(run.begin(), run.end(), [](const Point& point) { return point.by_map || point.has_come; });
  });
  std::vector<Run> strangers = runs_of(unknown, order.size());
  keep_what_may_be_people(strangers, Isolation{seen.sweep, order}, params);
  runs.insert(runs.end(), strangers.begin(), strangers.end());
  join_legs(runs, params);

  std::vector<PersonSighting> people;
  std::vector<Point2> points;
  for (const Run& run : runs) {
    if (static_cast<int>(run.size()) < params.least_points) continue;
    points.clear();
    for (const Point& point : run) points.push_back(point.at);
    BodyFit fit = fit_bodies(points, seen.odom_from_base.position(), known);
    remember_thing(run, fit.thing_gain, memory, params);
    if (run.are_legs) join_bodies(fit, points, seen.odom_from_base.position(), known);
    for (const Body& body : fit.bodies) {
      const PersonSighting sighting = sighting_of(run, body, fit.thing_gain, memory, params);
      if (sighting.points >= params.least_points) people.push_back(sighting);
    }
  }
  join_near(people);
  return people;
}

}  // namespace docent::people
