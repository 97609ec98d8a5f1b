#pragma once

#include <span>
#include <vector>

#include "docent/localization/learning/labels.h"

namespace docent::localization {

struct RefinementParams {
  int beams = 60;       ///< of a sweep, evenly
  double scale = 0.08;  ///< [m] of the error of a beam that counts fully, and
  double scale_per_metre = 0.01;
  double independent = 0.3;  ///< of a beam's weight: neighbours err together
  double most_shift = 0.15;  ///< [m] deviation by which belief's labels are off, and
  double most_turn = 1.5;    ///< [deg]
  double stride = 0.1;       ///< [m] between refined labels; those between move with odometry
  double stride_turn = 5.0;  ///< [deg]
};

/// Moves sure labels to where their sweeps fit the map best, each by itself. The mean of a grid's belief is some
/// centimetres off and leans on odometry; what the sensor errs and what odometry errs must be told apart from that. A
/// robust (Cauchy) fit of ranges, held by a Gaussian about the old label where the sweep does not say, as along a bare
/// corridor. The labels' people and unmapped things hardly pull. Deterministic.
/// O(labels * beams * casts), about sixty casts a beam.
void refine(std::span<const RecordedSweep> sweeps, const sensor_models::RayCaster& caster, double max_range,
            const RefinementParams& params, std::vector<PoseLabel>& labels);

}  // namespace docent::localization
