#pragma once

#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent {

struct ClusterParams {
  double gap = 0.3;           ///< [m], > 0: points nearer than this belong together
  int least_points = 3;       ///< nearby, a person gives more beams than this; fewer are stray readings
  double person_width = 0.6;  ///< [m], > 0: wider clusters are several people side by side
  double half_depth = 0.12;   ///< [m]: only the near side is seen, the middle lies behind it
  template <class V>
  void visit(V& v) {
    v("gap", gap);
    v("least_points", least_points);
    v("person_width", person_width);
    v("half_depth", half_depth);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Something person-sized that the map does not hold.
struct PersonSighting {
  Point2 position;  ///< of its middle, in the frame of the points
  int points = 0;
};

/// Groups the endpoints of unexpected beams [Rhino1999] 3.1.7 into people. `sensor`: where they were seen from.
/// Single-linkage clusters; a wide one is cut into equal parts along its width. O(points^2), for some hundred points.
[[nodiscard]] std::vector<PersonSighting> find_people(std::span<const Point2> points, Point2 sensor,
                                                      const ClusterParams& params);

}  // namespace docent
