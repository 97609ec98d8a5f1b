#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "docent/motion_models/odometry_model.h"
#include "docent/motion_models/odometry_windows.h"

namespace docent::motion_models {

/// The motion model together with what the labels themselves err.
struct LabelledMotionNoise {
  OdometryModelParams motion;    ///< how odometry errs
  double label_position = 1e-3;  ///< [m2] along each axis
  double label_heading = 1e-4;   ///< [rad2]
};

/// Mean ln p(error) of a window [nat]: a Gaussian, or, with the probability that wheels slipped on the way, a wider
/// one. 0 without windows. O(windows).
[[nodiscard]] double mean_log_likelihood(std::span<const MotionWindow> windows, const LabelledMotionNoise& noise);

/// Bounds and when to stop.
struct OdometryFitParams {
  std::size_t least_windows = 30;     ///< fewer teach nothing
  double least_way = 10.0;            ///< [m] in all windows together; less teaches nothing
  double least_turn = 6.0;            ///< [rad] likewise; less, and what turns add stays as it was
  double least_translation = 1e-5;    ///< [m2/m]: 3 mm after a metre
  double least_rotation = 3e-6;       ///< [rad2/m]: 0.1 degrees after a metre
  double least_turn_rotation = 1e-5;  ///< [rad2/rad]: 0.2 degrees after a radian
  double least_slip = 0.0005;         ///< probability that wheels slip
  double most_slip = 0.1;             ///< likewise
  /// Slips are rare, and where wheels slip a label is seldom sure: a recording counts against so many steps that
  /// slipped as often as the start says.
  double slip_prior = 2000.0;
  /// The same for each variance: windows overlap and a short recording holds few of its own, so that one that says
  /// little of a variance leaves it about where it was.
  double variance_prior = 20.0;
  bool fixed_motion = false;  ///< fit the labels' noise alone, for a fair comparison of motion models
  int most_rounds = 200;      ///< then it is enough
  double settled = 1e-6;      ///< [nat] a window gained by a round
};

/// What was learned.
struct OdometryFit {
  LabelledMotionNoise noise;  ///< the most likely one
  std::size_t windows = 0;    ///< that taught
  double way = 0.0;           ///< [m] in all windows
  double turn = 0.0;          ///< [rad]
  double before = 0.0;        ///< [nat] a window, by the start's motion and the labels' noise that fits it best
  double after = 0.0;         ///< [nat] a window
  double drift_turn = 0.0;    ///< [rad/m] systematic, to the left: part of the errors, but one could calibrate it away
  double drift_length = 0.0;  ///< [m/m] likewise: odometry reads so much too short
  std::vector<double> history;  ///< [nat] after every round, with the priors; never falls
};

/// Maximum likelihood fit of the motion model, [Rhino1999] 3.1.3 and Fig. 6: translational and rotational error,
/// independent, that grow with way and turn. The variance of every window's error is a sum of nonnegative multiples of
/// known matrices, one of them the labels' own noise, which does not grow with the way and so is told apart from
/// odometry's where windows have several lengths. Multiplicative minorize-maximize steps for such variance components,
/// inside EM for the slips, sped up by extrapolation; the likelihood never falls. Deterministic.
///
/// Error: too few windows or too short a way. O(rounds * windows). @pre start is valid
[[nodiscard]] Result<OdometryFit> fit_odometry_model(std::span<const MotionWindow> windows,
                                                     const LabelledMotionNoise& start,
                                                     const OdometryFitParams& options = {});

}  // namespace docent::motion_models
