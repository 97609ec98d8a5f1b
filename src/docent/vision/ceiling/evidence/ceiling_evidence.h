#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/localization/belief/observation_model.h"
#include "docent/vision/ceiling/ceiling_mosaic.h"
#include "docent/vision/ceiling/ceiling_samples.h"

namespace docent::vision {

struct CeilingEvidenceParams {
  int samples = 128;          ///< of a picture, > 0
  int block = 8;              ///< [pixels] side of a block of pixels, 1 .. 64: as coarse as `blur`
  double steepest = 1.2;      ///< slope of the farthest looks, > 0
  double blur = 0.12;         ///< [m] of the mosaic, > 0: as fine as the belief's states
  double independent = 12.0;  ///< samples of a picture that count, > 0: neighbours, and errors of mosaic and mount, err
                              ///< together. Half of what learn_independent finds on drawn halls whose mosaic is perfect
  double best_correlation = 0.95;  ///< that the right pose reaches, 0 .. 1; better ones cost nothing less
  double most_nats = 6.0;          ///< [nat], > 0: that a picture counts at most
  double least_contrast =
      0.02;  ///< of 0 .. 1, standard deviation of a picture's brightness from which it says anything, > 0
  double least_share = 0.3;  ///< of the samples that must lie on the mosaic for a pose to be judged by them, 0 .. 1;
                             ///< vertical faces are no part of it
  double oldest = 0.5;       ///< [s] of a picture, > 0
  double motion = 0.10;  ///< [m] that the robot has to move for a further picture to be news, >= 0: one that is taken
                         ///< at the same place errs like the last one
  double turn = 10.0;    ///< [deg] likewise, >= 0
  [[nodiscard]] Result<void> validate() const;
};

/// A picture of the ceiling as a sensor of the belief.
///
/// Of K samples I_u and what the mosaic has at their places, m_u: with gain >= 0, offset and noise of the picture
/// unknown, the likeliest values give ln p = -(n / 2) ln(1 - r^2), r the correlation of I and m where it is positive,
/// else 0. n is the number of samples that count (`independent`). A picture that looks like no place, for its lamps are
/// off, has a small r everywhere, and says little.
class CeilingEvidence final : public localization::ObservationModel {
 public:
  /// @pre params are valid
  CeilingEvidence(const CeilingMosaic& mosaic, const CeilingCamera& camera, const CeilingEvidenceParams& params = {});

  /// A picture, and where odometry had the robot then.
  void see(const GrayPicture& picture, Time time, const Pose2& odom_from_robot);
  bool observe(const localization::ObservationMoment& moment) override;
  /// O(poses * samples)
  void add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const override;
  [[nodiscard]] double mean_cost() const override { return mean_cost_; }

  /// Between the last picture and the mosaic, had the picture been taken there; nothing where too little of it lies on
  /// the mosaic. 0 where they are plain, or opposite.
  [[nodiscard]] std::optional<double> correlation(const Pose2& map_from_robot) const;
  /// [nat] of a correlation.
  [[nodiscard]] double cost(double correlation) const;

 private:
  /// A sample's place for each part of the ceiling, from the robot [cells of the level].
  struct Place {
    float x = 0.0F, y = 0.0F;
  };

  CeilingEvidenceParams params_;
  MosaicLevel level_;
  CeilingSampler sampler_;
  std::vector<Place> places_;      ///< [samples][parts]
  std::vector<float> brightness_;  ///< [samples]
  std::vector<Pose2> anywhere_;    ///< poses all over the mosaic
  std::optional<Time> seen_;       ///< when the last picture was taken, if it is news
  Pose2 odom_at_picture_;
  std::optional<Pose2> odom_at_last_;  ///< of the last picture that was taken in
  Pose2 robot_then_from_now_;          ///< from the moment of the update to the picture
  double mean_cost_ = 0.0;
};

/// What learn_independent learns from: the correlations of a picture all over the places where it may have been taken.
struct EvidenceTrial {
  std::vector<double> correlations;
  std::size_t truth = 0;  ///< which of them belongs to the place where it was taken
};
/// The number of independent samples under which the true places are likeliest: the greatest sum of ln P(truth), P a
/// picture's posterior over its places. What is learned on pictures of one hall holds for those of the like.
[[nodiscard]] double learn_independent(std::span<const EvidenceTrial> trials);

}  // namespace docent::vision
