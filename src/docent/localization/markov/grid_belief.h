#pragma once

#include <memory>
#include <span>
#include <vector>

#include "docent/localization/localizer/known_map.h"
#include "docent/localization/localizer/localizer_params.h"
#include "docent/localization/localizer/pose_belief.h"
#include "docent/localization/markov/position_belief.h"
#include "docent/localization/markov/position_summary.h"

namespace docent::localization {

/// A probability for every place and heading, [Markov1998] 2, for the cycle of `Localizer`.
///
/// It is over a frame that goes along with the robot in whole cells and never turns, as odometry sees it: what odometry
/// knows well need not be blurred by the grid. Between the frame and the robot lie some centimetres and the robot's
/// heading.
class GridBelief final : public PoseBelief {
 public:
  GridBelief(std::shared_ptr<const KnownMap> map, const LocalizerParams& params);

  void start_unknown() override;
  void set_out(const Pose2& odom_from_robot) override;
  void believe(std::span<const BeliefMode> modes, double elsewhere, Rng& rng) override;
  void predict(const Motion& motion, const Pose2& odom_from_robot, bool keeps_its_place) override;
  /// O(active states * beams).
  Reweighed reweigh(const SensorEvidence& evidence, Rng& rng) override;
  void gather(const Pose2& found, const Neighbourhood& focus, double share) override;
  bool flood() override;
  [[nodiscard]] BeliefSummary summarise() override;
  [[nodiscard]] std::vector<LikelyState> likely() const override;
  [[nodiscard]] PositionDensity density() const override;
  [[nodiscard]] Pose2 odom_from_frame() const override { return odom_from_frame_; }
  [[nodiscard]] sensor_models::RangeSweep in_frame(const sensor_models::RangeSweep& sweep) const override {
    return sensor_models::seen_from(sweep, frame_from_robot());
  }
  [[nodiscard]] Pose2 map_from_frame(const Pose2& map_from_robot) const override {
    return map_from_robot * inverse(frame_from_robot());
  }

  [[nodiscard]] const PositionBelief& belief() const { return belief_; }

 private:
  [[nodiscard]] Pose2 frame_from_robot() const { return inverse(odom_from_frame_) * odom_from_robot_; }
  /// The frame's step after the robot [m], odom: whole cells, as the likeliest heading sees them.
  [[nodiscard]] Point2 follow(bool keeps_its_place);
  /// What the sensors beside the lasers say now; empty: nothing.
  [[nodiscard]] PlaceCosts ask_sensors(const SensorEvidence& evidence) const;

  std::shared_ptr<const KnownMap> map_;
  LocalizerParams params_;
  CoarseCells coarse_;
  PositionBelief belief_;
  Pose2 odom_from_frame_;
  Pose2 odom_from_robot_;    ///< at the last update
  Angle likeliest_heading_;  ///< of the frame in the map
};

/// What readings cost at each expected range, in the steps of the grid's scores.
struct ScanCosts {
  std::vector<BeamCosts> beams;     ///< by rising direction
  double log_best_over_mean = 0.0;  ///< [nat] by which the best place explains them better than a mean one
};
/// `temper`: what each nat of a beam counts. O(beams * kExpectedRanges).
[[nodiscard]] ScanCosts scan_costs(const sensor_models::RangeSweep& seen,
                                   std::span<const sensor_models::BinnedBeam> beams,
                                   const sensor_models::ProximityModel& model, double temper);

}  // namespace docent::localization
