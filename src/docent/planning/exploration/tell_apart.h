#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::planning {

/// Where to drive while lost, to tell hypotheses apart.
struct TellApartParams {
  double least_mass = 0.6;   ///< of the hypotheses together: with less nobody knows what there is to tell apart
  double least_gain = 0.1;   ///< [nat] that makes a drive worthwhile
  double way_cost = 0.02;    ///< [nat/m] that a place must tell more for every metre of way
  double longest_way = 4.0;  ///< [m] at a time
  double keep_off = 0.7;     ///< [m] left free at the end of the way
  template <class V>
  void visit(V& v) {
    v("least_mass", least_mass);
    v("least_gain", least_gain);
    v("way_cost", way_cost);
    v("longest_way", longest_way);
    v("keep_off", keep_off);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// One place where the robot may be.
struct PossiblePose {
  Pose2 map_from_robot;
  double mass = 0.0;
};

/// Active localization: where to drive so that the next readings tell the hypotheses apart.
///
/// For every place within reach, or beyond it where the map has room: what a laser
/// would read there under each hypothesis (ray casting in the map), how well that separates each pair of them
/// (log-likelihood ratio of the readings, which are noisy, correlated and partly hidden by people), and the entropy
/// that would be left on average, sum_i m_i H(p | i is true). The place with the largest expected fall of the entropy,
/// less the cost of the way, wins: the utility of [FoxBurgardThrun1998].
class TellApart {
 public:
  static constexpr int kBearings = 24;  ///< directions that are driven to
  static constexpr int kBeams = 60;     ///< of an imagined reading, all round
  static constexpr std::size_t kMostHypotheses = 8;

  TellApart(const OccupancyGrid& map, double robot_radius, const TellApartParams& params);

  struct Place {
    Point2 in_base;     ///< [m] where to drive now; the first leg, where the place itself lies farther away
    Point2 goal;        ///< [m] base frame, the place itself
    double gain = 0.0;  ///< [nat] by which the entropy of the hypotheses is expected to fall
  };
  /// nullopt when there are not two hypotheses, they hold too little of the belief, or no place in reach tells them
  /// apart.
  /// @param hypotheses  by falling mass
  /// @param clearances  [n] free distance [m] all round, from -180 degrees, base frame; the smaller of real and virtual
  /// @param max_range  [m] of the laser
  /// @param last_goal  [m] base frame, chosen before: kept unless another is clearly better
  /// O(bearings * ways * hypotheses * (beams casts + hypotheses * beams)).
  [[nodiscard]] std::optional<Place> best_place(std::span<const PossiblePose> hypotheses,
                                                std::span<const double> clearances, double max_range,
                                                std::optional<Point2> last_goal = std::nullopt) const;

  /// Entropy [nat] of the hypotheses that is expected to be left after a reading at `in_base`.
  [[nodiscard]] double expected_entropy(std::span<const PossiblePose> hypotheses, Point2 in_base,
                                        double max_range) const;

 private:
  /// The map has room for the robot there under every hypothesis.
  [[nodiscard]] bool may_stand(std::span<const PossiblePose> hypotheses, Point2 in_base) const;
  /// What would be read there if the hypothesis were right; empty where the robot could not stand.
  [[nodiscard]] std::vector<double> imagined(const PossiblePose& hypothesis, Point2 in_base, double max_range) const;

  sensor_models::RayCaster caster_;
  double radius_;
  TellApartParams params_;
};

/// The least clearance within 20 degrees of direction `index`: the robot is wider than a beam.
[[nodiscard]] double clearance_of_cone(std::span<const double> clearances, int index);

}  // namespace docent::planning
