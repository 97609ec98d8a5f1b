#pragma once

#include "docent/localization/expected_ranges/expected_ranges.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// How readings compare with what the belief expects: how many (each counted by the mass of the states for which it is
/// so) are what the map says, surely shorter, or surely longer. All 0 where the map does not say or nothing came back:
/// some surfaces give no return.
struct Agreement {
  double agrees = 0.0, shorter = 0.0, longer = 0.0;
  Agreement& operator+=(const Agreement& other);
};

/// How a reading compares with what the belief expects; surely: with `sureness`, e.g. 0.99. That nothing came back
/// agrees where the map has a wall beyond what the scanner looks and within what the model does; else it says nothing.
[[nodiscard]] Agreement agreement(const ExpectedRanges& expected, const sensor_models::ProximityModel& model,
                                  int direction, int measured, double sureness);
/// Summed over all beams of a sweep: agrees + shorter + longer = beams whose range the map says.
[[nodiscard]] Agreement agreement_of_all(const ExpectedRanges& expected, const sensor_models::ProximityModel& model,
                                         const sensor_models::RangeSweep& sweep, double sureness, int directions);

}  // namespace docent::localization
