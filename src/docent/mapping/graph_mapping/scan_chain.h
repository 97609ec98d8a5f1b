#pragma once

#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/mapping/graph_mapping/mapping_scan.h"
#include "docent/mapping/pose_graph/pose_graph.h"
#include "docent/mapping/scan_matching/correlative_matcher.h"
#include "docent/mapping/scan_matching/line_matcher.h"

namespace docent::mapping {

/// How each scan is matched to those before it.
struct ScanChainParams {
  int scans = 12;                    ///< > 0: a scan is matched to so many before it
  double way_sigma = 0.05;           ///< [m], > 0: odometry, of each step, and
  double way_per_metre = 0.15;       ///< [m/m], >= 0, more
  double way_per_radian = 0.05;      ///< [m/rad], >= 0
  double turn_sigma = 0.035;         ///< [rad], > 0: odometry, of each step, and
  double turn_per_metre = 0.1;       ///< [rad/m], >= 0, more
  double turn_per_radian = 0.15;     ///< [rad/rad], >= 0
  double sigmas = 3.0;               ///< > 0: so far from odometry's pose a match is looked for
  double most_reach = 5.0;           ///< [m], > 0: and never farther, whatever odometry says
  double expectation_weight = 0.01;  ///< >= 0: see MatchWindow
  double least_score = 0.35;         ///< 0..1: a match below is none; odometry is believed
  int fewest_points = 30;            ///< > 0: of a scan; fewer are as likely people as walls: odometry is believed
  double query_cell = 0.10;          ///< [m], > 0: one point a cell takes part in the search
  template <class V>
  void visit(V& v) {
    v("scans", scans);
    v("way_sigma", way_sigma);
    v("way_per_metre", way_per_metre);
    v("way_per_radian", way_per_radian);
    v("turn_sigma", turn_sigma);
    v("turn_per_metre", turn_per_metre);
    v("turn_per_radian", turn_per_radian);
    v("sigmas", sigmas);
    v("most_reach", most_reach);
    v("expectation_weight", expectation_weight);
    v("least_score", least_score);
    v("fewest_points", fewest_points);
    v("query_cell", query_cell);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where a scan is, seen from the one before it.
struct ChainStep {
  Pose2 before_from_after;
  Eigen::Matrix3d information;  ///< of its error, seen in the later scan's frame
  bool is_matched = false;      ///< false: odometry's own
  double surprise = 0.0;        ///< matched: by how much odometry erred, in squared sigmas, mean of x, y and heading
};

/// Matches each scan to the map that the few before it make: the search takes the best place about odometry's, the
/// match of points to lines makes it fine. Knows nothing of loops.
class ScanChain {
 public:
  ScanChain(const ScanChainParams& params, const MatchGridParams& grid, const LineMatcherParams& lines)
      : params_{params}, grid_{grid}, lines_{lines} {}

  /// The step to `scans[i]` as odometry has it. @pre 0 < i
  [[nodiscard]] ChainStep odometry_step(std::span<const MappingScan> scans, std::size_t i) const;
  /// The step to `scans[i]`, of whose predecessors the poses stand in `map_from_base`. @pre 0 < i <= poses.
  [[nodiscard]] ChainStep step(std::span<const MappingScan> scans, std::span<const Pose2> map_from_base,
                               std::size_t i) const;

 private:
  struct Sigmas {
    double way = 0.0;   ///< [m]
    double turn = 0.0;  ///< [rad]
  };
  [[nodiscard]] Sigmas sigmas_of(const Pose2& odometry) const;

  ScanChainParams params_;
  MatchGridParams grid_;
  LineMatcherParams lines_;
};

/// The steps from each scan to the next, all along. O(scans).
[[nodiscard]] std::vector<Pose2> chain_of(std::span<const MappingScan> scans, const ScanChain& chain);

}  // namespace docent::mapping
