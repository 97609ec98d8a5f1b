#pragma once

#include <deque>
#include <string>

#include "docent/base/result.h"
#include "docent/mapping/graph_mapping/submap.h"
#include "docent/mapping/pose_graph/pose_graph.h"

namespace docent::mapping {

/// When a map is not to be trusted.
struct MapJudgementParams {
  double near = 6.0;       ///< [m], > 0: pieces of the way so near to each other should agree
  double conflict = 0.15;  ///< 0..1: share of a piece's points on floor that the other one saw free: they do not
  double most_in_conflict = 0.07;  ///< 0..1: share of such pairs up to which people and doors explain it
  double most_error = 0.4;  ///< [m], >= 0: expected to err by more, between any places; at 0.5 m a map is no good
  template <class V>
  void visit(V& v) {
    v("near", near);
    v("conflict", conflict);
    v("most_in_conflict", most_in_conflict);
    v("most_error", most_error);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What a map says of itself, without any truth.
struct MapJudgement {
  std::size_t pairs = 0;        ///< of pieces of the way that lie near each other, and not one after the other
  double in_conflict = 0.0;     ///< share of these where one sees free floor and the other something
  double mean_conflict = 0.0;   ///< share of the points of all pairs that do
  double restless = 0.0;        ///< restlessness of the drive: so much more conflict is no sign of a wrong map
  double expected_error = 0.0;  ///< [m], mean over pairs of places, by all of the graph's covariances together
  double odometry_scale = 1.0;  ///< share of its expected error by which odometry erred where scans tell
  bool is_trusted = false;
  std::string reason;  ///< why not, for a person
};

/// Two pieces that contradict each other, or a loop that nothing closes, show a map that is wrong; one that agrees with
/// itself may still be wrong where nothing was seen twice, which the covariances say. `restless`: share of the points
/// in conflict between pieces one after the other, which the chain has matched: what walks about, and no sign of an
/// error. `odometry_scale`: of odometry's sigmas, by the steps that scans have borne out. O(pairs * points).
[[nodiscard]] MapJudgement judge(const PoseGraph& graph, const std::deque<Submap>& submaps, double restless,
                                 double odometry_scale, const MapJudgementParams& params);

}  // namespace docent::mapping
