#pragma once

#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/people/sightlines.h"

namespace docent::people {

/// What stands and is nobody.
struct StandingThingParams {
  double person_stands = 40.0;  ///< [s], > 0: how long visitors stand without a step, mean of an exponential
  double person_odds = 10.0;    ///< > 1: of a person to a person-shaped thing where neither map nor motion tell
  double same_place = 0.2;      ///< [m], > 0
  double unwatched = 20.0;      ///< [s], >= 0: a time out of sight counts at most so long
  template <class V>
  void visit(V& v) {
    v("person_stands", person_stands);
    v("person_odds", person_odds);
    v("same_place", same_place);
    v("unwatched", unwatched);
  }
  [[nodiscard]] Result<void> validate() const;
  /// [s] after which what never moved is rather a thing: the odds exp(-t / person_stands) * person_odds reach 1.
  [[nodiscard]] double patience() const;
};

/// Remembers, in the map's frame, where something person-sized has stood since it was first seen: moved furniture,
/// plants, podiums. A visitor comes and goes, and who was seen to come is nobody's furniture; a place that is seen
/// free is forgotten.
class StandingThings {
 public:
  explicit StandingThings(const StandingThingParams& params) : params_{params} {}

  /// Something stands there, and does not move. `came`: it was seen to come or to move before. O(places).
  void see(Point2 in_map, bool came, Time now);
  /// Forgets what the sweep sees free, and what was long not seen. O(places).
  void forget(const Sightlines& sightlines, const Pose2& odom_from_map, Point2 robot_in_map, double range, Time now);
  /// Whether what stands there is rather a thing than a person.
  [[nodiscard]] bool is_thing(Point2 in_map) const;

 private:
  struct Place {
    Point2 in_map;
    double stood = 0.0;  ///< [s]
    bool came = false;
    int seen_free = 0;  ///< sweeps in a row
    Time seen;
  };
  [[nodiscard]] const Place* nearest(Point2 in_map) const;

  StandingThingParams params_;
  std::vector<Place> places_;
};

}  // namespace docent::people
