#pragma once

#include <Eigen/Core>
#include <optional>

#include "docent/base/result.h"
#include "docent/mapping/graph_mapping/submap.h"
#include "docent/mapping/pose_graph/pose_graph.h"
#include "docent/mapping/scan_matching/correlative_matcher.h"
#include "docent/mapping/scan_matching/line_matcher.h"

namespace docent::mapping {

/// When two pieces show one place.
struct LoopCloserParams {
  double least_score = 0.50;         ///< 0..1, of the search
  double least_overlap = 0.40;       ///< 0..1: share of the points that then lie on lines of the other submap
  double most_conflict = 0.06;       ///< 0..1: share of the points that lie where the other submap saw free floor
  double clearly_best = 0.88;        ///< 0..1: the next best place elsewhere reaches at most this share of the score
  double elsewhere = 0.8;            ///< [m], >= 0
  double elsewhere_turn = 0.5;       ///< [rad], >= 0
  double widest_window = 12.0;       ///< [m], > 0: the search goes no farther, however little is known
  double narrow_window = 1.0;        ///< [m], >= 0: so near to the expected place, one direction may stay open
  double expectation_weight = 0.01;  ///< >= 0: see MatchWindow
  double sigmas = 3.0;               ///< > 0: the search goes so far about the expected place
  double least_window = 0.6;         ///< [m], 0..widest_window
  double least_turn = 0.2;           ///< [rad], 0..pi
  template <class V>
  void visit(V& v) {
    v("least_score", least_score);
    v("least_overlap", least_overlap);
    v("most_conflict", most_conflict);
    v("clearly_best", clearly_best);
    v("elsewhere", elsewhere);
    v("elsewhere_turn", elsewhere_turn);
    v("widest_window", widest_window);
    v("narrow_window", narrow_window);
    v("expectation_weight", expectation_weight);
    v("sigmas", sigmas);
    v("least_window", least_window);
    v("least_turn", least_turn);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Two submaps that show one place.
struct LoopClosure {
  std::size_t from = 0;  ///< index of the older submap
  std::size_t to = 0;
  PoseConstraint constraint;  ///< between their middle scans
  double surprise = 0.0;      ///< [m] from where the newer submap was expected
};

/// Whether and where one submap fits onto another: search, check that no other place fits nearly as well, lines, check
/// that nothing stands where the other one saw free floor.
class LoopCloser {
 public:
  LoopCloser(const LoopCloserParams& params, const LineMatcherParams& lines) : params_{params}, lines_{lines} {}

  /// `restless`: share of the points of submaps one after the other that are in conflict: people walk here.
  /// `expected`: the newer submap's middle as the older one's sees it, with its covariance in the older one's frame.
  [[nodiscard]] std::optional<LoopClosure> close(const Submap& older, const Submap& newer, const Pose2& expected,
                                                 const Eigen::Matrix3d& covariance, double restless) const;

 private:
  LoopCloserParams params_;
  LineMatcherParams lines_;
};

}  // namespace docent::mapping
