#pragma once

#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/people/free_memory.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::people {

/// What in a scan is taken for somebody.
struct SightingParams {
  double range = 6.0;          ///< [m], > 0: people are looked for so far away
  int least_points = 2;        ///< beams on a person, at least
  double legs_apart = 0.38;    ///< [m], >= 0: gap between two narrow things that may be the legs of one person, or one
                               ///< person's sides beside another who stands before them
  double one_person = 0.6;     ///< [m], > 0: width of one person with legs apart
  double surely_thing = 4.0;   ///< [nat], > 0: what was there and looks so much more like a thing is remembered as one
  double part_of_thing = 0.3;  ///< 0..1: share of the points on remembered things from which on it is a piece of one
  template <class V>
  void visit(V& v) {
    v("range", range);
    v("least_points", least_points);
    v("legs_apart", legs_apart);
    v("one_person", one_person);
    v("surely_thing", surely_thing);
    v("part_of_thing", part_of_thing);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// One sweep, and what the map says of its beams.
struct PeopleSweep {
  Pose2 odom_from_base;
  sensor_models::RangeSweep sweep;
  std::vector<sensor_models::BeamOrigin> origins;  ///< [beams]
};

/// Something person-sized that the map does not hold, or that came to where the floor was free.
struct PersonSighting {
  Point2 position;          ///< [m] of its middle, odom
  double radius = 0.22;     ///< [m] that fits best
  double breadth = 0.0;     ///< [m] of its widest piece without a gap or a step: of one leg, or of a body
  int points = 0;           ///< beams on it
  bool by_map = false;      ///< half of them or more are surely not the map
  bool is_mapped = false;   ///< the map could tell
  bool has_come = false;    ///< most of them end where the floor was free before
  double thing_gain = 0.0;  ///< [nat] see BodyFit: above 0 its shape is rather a bench's, a panel's, a column's
};

/// People in a sweep [Rhino1999] 3.1.7, [Minerva2000] 3.3: what the inverse filter lets pass, and, where the map tells
/// nothing, what stands by itself or has come; cut into runs of neighbouring beams; narrow runs side by side joined as
/// the legs of one person; and each explained by discs as wide as people.
/// @param memory  is told what shows itself to be a thing: where somebody hides a part, the rest may look like a person
/// @param known  [m] odom: where people are expected. O(beams * log beams + points * bodies).
[[nodiscard]] std::vector<PersonSighting> find_people(const PeopleSweep& seen, FreeMemory& memory,
                                                      std::span<const Point2> known, const SightingParams& params);

}  // namespace docent::people
