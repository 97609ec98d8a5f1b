#pragma once

#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "docent/simulator/sensing/laser.h"

namespace docent::simulator {

/// What a driver writes for a beam that nothing came back of.
enum class NoReturn { greatest, infinity, zero };

/// A scanner as it is sold, and as its driver writes what it reads.
struct ScannerKind {
  double field = std::numbers::pi;  ///< [rad] of view, 0..2 pi
  int beams = 0;                    ///< evenly over the field; 0: one a degree
  double rate = 10.0;               ///< [Hz] of its sweeps
  double max_range = 10.0;          ///< [m]
  bool is_clockwise = false;        ///< it turns so: its messages have an angle_increment below 0
  bool is_upside_down = false;      ///< it hangs, and its driver does not turn the sweep over
  NoReturn no_return = NoReturn::greatest;
};

/// The true scanner of a kind: noise at a distance is that of LaserParams, and at most 5 cm.
[[nodiscard]] LaserParams laser_of(const ScannerKind& kind);

/// A sweep as the driver of a kind writes it.
struct WrittenSweep {
  double angle_min = 0.0;        ///< [rad] of ranges[0]
  double angle_increment = 0.0;  ///< [rad]
  std::vector<float> ranges;     ///< [m]
};
/// @param ranges  [m] counter-clockwise as the robot stands, `params.max_range`: nothing came back. O(beams)
[[nodiscard]] WrittenSweep as_written(const ScannerKind& kind, const LaserParams& params,
                                      std::span<const float> ranges);

/// Whether a sweep of so many a second is due at a step, counted from 0, of 10 ms.
[[nodiscard]] bool is_due(std::size_t step, double rate);

}  // namespace docent::simulator
