#pragma once

#include <array>
#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/localization/belief/observation_model.h"

namespace docent::localization {

/// Where another sensor finds the robot by itself, from anywhere: a camera that looks at the ceiling.
struct PoseFix {
  Pose2 map_from_robot;                ///< when it was seen
  std::array<double, 9> covariance{};  ///< row-major x, y [m], theta [rad]
  Pose2 odom_from_robot;               ///< then
  Time time{};                         ///< of the picture
  double p_wrong = 1.0;                ///< probability that the robot is elsewhere
};

/// A fix as a sensor of the belief: poses far from it cost more, up to what P(wrong) leaves. A fix is used once.
class FixEvidence final : public ObservationModel {
 public:
  static constexpr double kOldest = 1.5;    ///< [s] of a fix
  static constexpr double kFarthest = 1.0;  ///< [m] driven since, at most: odometry carries it no farther

  /// A newer fix, in place of the one before.
  void take(const PoseFix& fix) { fix_ = fix, is_used_ = false; }
  bool observe(const ObservationMoment& moment) override;
  void add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const override;
  [[nodiscard]] double mean_cost() const override { return most_; }

  /// The newest fix carried on by odometry; nothing where it is too old or too far back.
  [[nodiscard]] std::optional<PoseFix> at(Time time, const Pose2& odom_from_robot) const;

 private:
  std::optional<PoseFix> fix_;
  bool is_used_ = false;
  Pose2 expected_;        ///< at the moment of the update
  double place_ = 1.0;    ///< [1/m2] of half a squared distance
  double heading_ = 1.0;  ///< [1/rad2]
  double most_ = 0.0;     ///< [nat]
};

}  // namespace docent::localization
