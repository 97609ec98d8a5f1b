#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/mapping/graph_mapping/loop_closer.h"
#include "docent/mapping/graph_mapping/map_judgement.h"
#include "docent/mapping/graph_mapping/scan_chain.h"

namespace docent::mapping {

/// How a map is made of scans and odometry.
struct GraphMapperParams {
  PointSweepParams points;                    ///< which ends of beams count
  ScanChainParams chain;                      ///< matching to what was seen just before
  SubmapParams submaps;                       ///< short pieces of the way
  LoopCloserParams loops;                     ///< matching pieces to older ones
  PoseGraphParams graph;                      ///< least squares
  MapJudgementParams judgement;               ///< whether to trust the map
  MatchGridParams chain_grid{0.05, 0.07, 4};  ///< of the chain's matches
  MatchGridParams loop_grid{0.10, 0.10, 6};   ///< of the loops' matches
  LineMatcherParams lines;                    ///< matching to the centimetre
  int candidates = 8;                         ///< > 0: older submaps that a new one is matched to, the likeliest first
  double loop_reach = 6.0;  ///< [m], > 0: submaps whose middles lie farther apart show too little in common
  int fine_rounds = 3;      ///< >= 0: rounds in which scans are matched to scans nearby, and all poses improved
  int fine_pairs = 10;      ///< > 0: of a scan in a round
  double fine_reach = 8.0;  ///< [m], > 0, between two such scans
  // Where no scan says, odometry binds as well as it has proved to be where scans do.
  int first_steps = 100;              ///< >= 0: that were matched, then the map begins anew with what they told
  double contradiction = 5.0;         ///< > 0: by so many sigmas of it a scan with few points may not contradict it
  double few_points = 0.6;            ///< >= 0: as a share of what is usual on this drive
  double odometry_margin = 2.0;       ///< > 0: times its error there, for an error that lasts adds up
  double least_odometry_scale = 0.1;  ///< in (0, 1], as a share of the chain's expectation
  template <class V>
  void visit(V& v) {
    v("points", points);
    v("chain", chain);
    v("submaps", submaps);
    v("loops", loops);
    v("graph", graph);
    v("judgement", judgement);
    v("lines", lines);
    v("candidates", candidates);
    v("loop_reach", loop_reach);
    v("fine_rounds", fine_rounds);
    v("fine_pairs", fine_pairs);
    v("fine_reach", fine_reach);
    v("first_steps", first_steps);
    v("contradiction", contradiction);
    v("few_points", few_points);
    v("odometry_margin", odometry_margin);
    v("least_odometry_scale", least_odometry_scale);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What a person who waits is told, and may draw.
struct MappingProgress {
  std::string stage;                     ///< "chain", "loops", "fine"
  std::size_t done = 0;                  ///< scans or rounds so far
  std::size_t of = 0;                    ///< of so many
  std::size_t loops = 0;                 ///< closed so far
  std::span<const Pose2> map_from_base;  ///< as far as known now
};

/// Poses of a drive, and what they are worth.
struct GraphMap {
  std::vector<Pose2> map_from_base;  ///< of every scan
  std::size_t loops = 0;             ///< closed
  std::size_t loops_refused = 0;     ///< seen and not believed
  std::size_t unmatched = 0;         ///< scans that only odometry places
  std::size_t revisits = 0;  ///< pairs of scans of one place, taken at different times, that were matched to each other
  double revisit_error = 0.0;  ///< [m], mean: by how much the map misses these matches
  MapJudgement judgement;      ///< whether to trust the map
};

/// Poses of all scans of a drive: a chain of matches to what was seen just before, loops closed between short submaps
/// in the order of the drive, each time all poses by least squares; then scans nearby are matched to each other.
/// Beyond [Minerva2000] 4.1, which has no loops but those that its grid of poses finds: see expectation_maximization.
[[nodiscard]] GraphMap map_by_graph(std::span<const MappingScan> scans, const GraphMapperParams& params,
                                    const std::function<void(const MappingProgress&)>& progress = {});

}  // namespace docent::mapping
