#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "docent/localization/learning/readings.h"
#include "docent/localization/learning/refinement.h"
#include "docent/motion_models/odometry_fit.h"

namespace docent::localization {

/// One recording: what localizes the robot, and the readings of another kind of sensor to learn about.
struct LearningRecording {
  std::vector<RecordedSweep> lasers;  ///< in the order of time
  std::vector<RecordedSweep> sonars;  ///< one beam each; empty when lasers are learned
};

struct BootstrapParams {
  int most_iterations = 6;
  double settled = 0.002;  ///< [nat] a reading that a fit to new labels gains over the last one: then it is enough
  std::vector<double> wall_depths{0.0};  ///< [m] to try; the one that explains the recordings best is kept
  int proofs = 3;  ///< labellings, each with other random choices of beams, in which a fit must prove itself
  ExpectedAt expected_at = ExpectedAt::cell;
  /// Of the sonar, as far as it is known before; nullopt: the lasers are learned.
  std::optional<sensor_models::ProximityModelParams> sonar;
  double sonar_cone = 15.0;  ///< [deg], full opening; see SonarEvidence
  LabelParams labels;
  RefinementParams refinement;
  ReadingParams readings;
  sensor_models::ProximityFitParams sensor_fit;
  motion_models::OdometryFitParams motion_fit;
  std::uint64_t seed = 1;
  RangeTableCache cache;
};

/// How two models explain readings that neither was fitted to.
struct HeldOut {
  std::uint64_t readings = 0;
  std::size_t pieces = 0;
  double before = 0.0;       ///< [nat] a reading, by the model at the start
  double after = 0.0;        ///< [nat] a reading, by the learned one
  double uncertainty = 0.0;  ///< [nat] standard error of the difference, from the scatter of the pieces
};
[[nodiscard]] HeldOut compare(const std::vector<sensor_models::ReadingCounts>& pieces,
                              const sensor_models::ProximityModelParams& before,
                              const sensor_models::ProximityModelParams& after);

struct BootstrapIteration {
  std::size_t sweeps = 0, sure = 0;  ///< of the lasers
  double step = 1.0;                 ///< of the way from the last model to the fit that was gone
  std::uint64_t readings = 0;        ///< that were fitted
  double before = 0.0;               ///< [nat] a fitted reading, by the model that labelled
  double after = 0.0;                ///< [nat] by the fit
  HeldOut held_out;                  ///< against the model at the start, on this iteration's labels
};

struct LearnedModels {
  sensor_models::ProximityModelParams sensor;
  std::optional<motion_models::OdometryFit> motion;  ///< none where the way was too short; then motion_fault says so
  std::string motion_fault;
  double motion_held_before = 0.0, motion_held_after = 0.0;  ///< [nat] a window held out
  std::size_t motion_held_windows = 0;
  double wall_depth = 0.0;  ///< [m]
  std::vector<BootstrapIteration> iterations;
  /// On labels made with the model at the start: the fair comparison, which owes the learned model nothing.
  HeldOut on_first_labels;
  HeldOut on_last_labels;
  sensor_models::ReadingCounts readings;  ///< all of the last iteration, for pictures
};

/// The bootstrap of [Rhino1999] 3.1.2: label the recordings by localizing them with an approximate model, fit the model
/// to the readings whose place is sure, label again with the fit, until the likelihood settles.
///
/// The most likely model of single readings is not always good for a belief that multiplies them. So each fit has to
/// prove itself in new labellings: when fewer places are sure or the two runs contradict each other more than
/// before, only half the way to the fit is gone, then a quarter; when that is not enough, the last model stands.
///
/// The motion model is fitted to the last labels and does not take part in making them: labels that lean on odometry
/// would find it better with every turn. A sonar is learned from the lasers' labels in one turn.
///
/// Error: no sure place, or too few readings. @pre start is valid; every recording has lasers
[[nodiscard]] Result<LearnedModels> bootstrap(const std::vector<LearningRecording>& recordings,
                                              const OccupancyGrid& map, const LocalizerParams& start,
                                              const BootstrapParams& params,
                                              const std::function<void(const std::string&)>& progress);

}  // namespace docent::localization
