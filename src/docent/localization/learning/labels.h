#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "docent/localization/markov/markov_localizer.h"

namespace docent::localization {

/// One sensor's readings at one moment of a recording.
struct RecordedSweep {
  Time time;
  int sensor = 0;  ///< which of several
  Pose2 odom_from_base;
  Pose2 base_from_sensor;
  sensor_models::RangeSweep sweep;  ///< in the sensor's frame
};

/// Where the robot was at a sweep, as localization says.
struct PoseLabel {
  Pose2 map_from_base;
  bool sure = false;  ///< only such labels count
};

struct Labelling {
  std::vector<PoseLabel> labels;  ///< one a sweep
  std::size_t sure = 0;
  std::size_t contradicted = 0;  ///< sweeps of which both runs claim to know the place, and contradict each other
  double fit = 0.0;              ///< mean ln P(d | o) of a beam at the best mode, over both runs [nat]
};

struct LabelParams {
  double most_apart = 0.3;      ///< [m] that the run forward and the reversed one may differ
  double most_turned = 5.0;     ///< [deg] likewise
  double other_place = 0.5;     ///< [m] from which on they contradict each other
  double other_heading = 10.0;  ///< [deg] likewise
  double most_p_lost = 0.02;    ///< of a run that alone knows a moment
};

/// Labels sweeps by localizing them forward and reversed, each from an unknown start. A label is sure where both runs
/// say where they are and agree; it lies in the middle of them. Before one of them first knows its place the other
/// alone will do; where one lost itself again nothing is sure. `localizer` is started anew. `progress` gets sweeps done
/// and all, now and then. O(sweeps) updates.
[[nodiscard]] Labelling label(std::span<const RecordedSweep> sweeps, MarkovLocalizer& localizer,
                              const LabelParams& params,
                              const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace docent::localization
