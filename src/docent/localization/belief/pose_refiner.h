#pragma once

#include <array>
#include <optional>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// Where inside the best mode the robot is, finer than cells.
struct PoseRefinerParams {
  bool enabled = true;            ///< false: the mean of the mode is taken
  double gate = 0.25;             ///< [m], > 0: readings farther from the wall they should meet are of something else;
                                  ///< at first as far as the pose may be off
  double beam_sigma = 0.05;       ///< [m], > 0: sensor and map together
  double independent_beams = 12;  ///< > 0: what all beams of a sweep are worth; their errors hang together
  double farthest = 0.35;         ///< [m], > 0, from the belief's own mean, and
  double farthest_turn = 8.0;     ///< [deg]; beyond it the refined pose starts again, unless the readings bear it out
  template <class V>
  void visit(V& v) {
    v("enabled", enabled);
    v("gate", gate);
    v("beam_sigma", beam_sigma);
    v("independent_beams", independent_beams);
    v("farthest", farthest);
    v("farthest_turn", farthest_turn);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where inside the best mode the robot is: finer than cells or bins. Follows the pose by odometry and corrects it by
/// the distances of the readings to the walls that they should meet (an extended Kalman filter, Gauss-Newton over
/// point-to-line distances). Where no walls do, it and the mode meet by covariance intersection. Which mode is right
/// remains the belief's business: the refined pose never goes far from it.
class PoseRefiner {
 public:
  explicit PoseRefiner(const PoseRefinerParams& params) : params_{params} {}

  void reset() {
    estimate_.reset();
    found_share_.reset();
  }

  /// `mode`: the belief's best one now. `before_from_after`: odometry since the last call, with the given error.
  /// @returns map_from_robot; of the mode itself where it is too wide to be refined. O(beams).
  [[nodiscard]] Pose2 refine(const BeliefMode& mode, const sensor_models::RangeSweep& sweep,
                             const Pose2& before_from_after, double position_variance, double heading_variance,
                             const sensor_models::RayCaster& caster, double max_range);
  /// The last call searched for the pose, because odometry had foretold too little: how surely it is the one that was
  /// found, FoundPose::share.
  [[nodiscard]] std::optional<double> found_share() const { return found_share_; }

 private:
  struct Estimate {
    Pose2 map_from_robot;
    std::array<double, 9> covariance{};
  };
  /// The estimate as odometry moves it.
  void carry_on(const Pose2& before_from_after, double position_variance, double heading_variance);
  /// The pose in the mode, or where odometry expected it, that the readings fit best.
  [[nodiscard]] Pose2 searched(const BeliefMode& mode, const sensor_models::RangeSweep& sweep, double position_variance,
                               double heading_variance, const sensor_models::RayCaster& caster, double max_range);
  /// Within `times` the farthest that the refined pose may be from the mode's mean, or `spread` [m] if that is more.
  [[nodiscard]] bool is_in(const BeliefMode& mode, const Pose2& pose, double times, double spread) const;
  [[nodiscard]] static Estimate intersection(const Estimate& a, const Estimate& b);
  /// Gauss-Newton from `predicted`; that itself where too few readings meet walls.
  [[nodiscard]] Estimate corrected(const Estimate& predicted, const sensor_models::RangeSweep& sweep,
                                   const sensor_models::RayCaster& caster, double max_range, bool is_vague) const;

  PoseRefinerParams params_;
  std::optional<Estimate> estimate_;
  std::optional<double> found_share_;
};

}  // namespace docent::localization
