#pragma once

#include <deque>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "docent/mapping/graph_mapping/graph_mapper.h"

namespace docent::mapping {

/// The poses of a drive while it goes on, scan by scan: what `map_by_graph` does with a whole log. Loops are closed as
/// they are seen, so the poses of earlier scans may move with any scan that is added.
class GraphMapping {
 public:
  explicit GraphMapping(const GraphMapperParams& params);  ///< no scan yet

  /// @pre the robot moved since the scan before. O(points), and now and then a search for loops and a least-squares
  /// solution over all scans.
  void add(MappingScan scan);
  /// Of every scan; the first one lies where its odometry says.
  [[nodiscard]] std::span<const Pose2> map_from_base() const { return graph_.poses(); }
  /// Changes whenever earlier scans have moved.
  [[nodiscard]] std::size_t revision() const { return revision_; }
  /// How sure the newest pose is, seen from the first one; as of the last submap.
  struct Spread {
    double position = 0.0;  ///< [m], one standard deviation
    double heading = 0.0;   ///< [rad], likewise
  };
  [[nodiscard]] Spread spread() const { return spread_; }  ///< of the newest pose
  /// [m], one standard deviation: how far from the newest pose's place on the map something may lie that is marked in
  /// the frame of the first pose; as of the last submap. Odometry is rated as it has proved to be.
  [[nodiscard]] double doubt_of_marks() const { return doubt_of_marks_; }
  [[nodiscard]] std::size_t loops() const { return loops_; }  ///< closed so far

  /// Closes what loops are left, matches scans nearby to each other and judges the map. No scan may follow.
  [[nodiscard]] GraphMap finish(const std::function<void(const MappingProgress&)>& progress = {});

 private:
  struct LoopCandidate {
    std::size_t submap = 0;
    double likelihood_order = 0.0;
    Eigen::Matrix3d covariance;
  };
  [[nodiscard]] bool is_submap_full(std::size_t last) const;
  void end_submap(std::size_t last);
  void optimise();
  [[nodiscard]] Pose2 middle_of(std::size_t submap) const { return graph_.poses()[submaps_[submap].middle()]; }
  void note_restlessness();
  [[nodiscard]] double restlessness() const;
  void begin_anew();
  [[nodiscard]] bool contradicts_odometry(const ChainStep& step, const MappingScan& scan) const;
  [[nodiscard]] double odometry_scale() const;
  void rate_marks();
  [[nodiscard]] double binding_scale() const;
  [[nodiscard]] std::vector<LoopCandidate> candidates_for(std::size_t newer);
  bool close_loops(std::size_t newer);
  bool believe(const LoopClosure& closure);
  void accept(const LoopClosure& closure);
  [[nodiscard]] bool agree(const LoopClosure& a, const LoopClosure& b) const;
  [[nodiscard]] std::map<std::size_t, std::vector<std::size_t>> pairs_by_reference() const;
  void refine(int round);
  [[nodiscard]] double missed_by(const PoseConstraint& match) const;

  GraphMapperParams params_;
  std::vector<MappingScan> scans_;
  ScanChain chain_;
  LoopCloser closer_;
  PoseGraph graph_;
  std::deque<Submap> submaps_;
  std::vector<double> restless_;   ///< shares of points in conflict
  std::vector<double> surprises_;  ///< how odometry erred at each matched step
  std::vector<LoopClosure> waiting_;
  std::vector<PoseConstraint> revisits_;  ///< matches of the last fine round between different pieces of the way
  std::map<std::pair<std::size_t, std::size_t>, bool> closed_;
  std::size_t first_ = 0;  ///< scan that the next submap begins with
  bool has_begun_anew_ = false;
  std::size_t points_ = 0;  ///< of all scans
  double way_ = 0.0;        ///< [m] of the next submap
  double turn_ = 0.0;       ///< [rad]
  std::size_t loops_ = 0;
  std::size_t refused_ = 0;
  std::size_t unmatched_ = 0;
  std::size_t revision_ = 0;
  Spread spread_;
  double doubt_of_marks_ = 0.0;
};

}  // namespace docent::mapping
