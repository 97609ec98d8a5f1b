#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "docent/mapping/expectation_maximization/pose_box.h"
#include "docent/mapping/graph_mapping/mapping_scan.h"

namespace docent::mapping {

struct PlaceParams {
  double way = 3.0;    ///< [m], > 0: a place ends after this way,
  double turn = 3.0;   ///< [rad], > 0: or this turn
  double reach = 8.0;  ///< [m], > 0: what lies farther moves by more than a cell where the heading is a little wrong
  template <class V>
  void visit(V& v) {
    v("way", way);
    v("turn", turn);
    v("reach", reach);
  }
};

/// What the robot saw about one place of its way, put together by odometry over that short piece: the observation o of
/// [Minerva2000] eq. 7-9, and the way since the place before.
struct SeenPlace {
  std::size_t scan = 0;          ///< in whose base frame it is seen
  Pose2 before_from_here;        ///< raw odometry since the place before; at the first one nothing
  double way = 0.0;              ///< [m] driven since then
  double turn = 0.0;             ///< [rad] turned since then, all turns together
  std::vector<Point2> occupied;  ///< [m], one a cell
  std::vector<Point2> free;      ///< [m], one a cell
};

/// O(points). `cell` [m]: of the thinned points.
[[nodiscard]] std::vector<SeenPlace> places_of(std::span<const MappingScan> scans, const PlaceParams& params,
                                               double cell);

}  // namespace docent::mapping
