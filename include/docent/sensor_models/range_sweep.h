#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::sensor_models {

/// What one laser read. A range of `max_range` or more is no return; NaN, infinite negative or shorter than `min_range`
/// is invalid.
struct LaserReading {
  std::span<const float> ranges;  ///< [m], sensor frame
  Angle first_bearing{};          ///< of ranges[0], sensor frame
  double bearing_step = 0.0;      ///< [rad], may be negative
  double min_range = 0.02;        ///< [m]
  double max_range = 10.0;        ///< [m]
};

/// One valid beam as if it had been measured from the robot's centre.
struct SweepBeam {
  double bearing = 0.0;    ///< [rad], -pi..pi, base frame
  double range = 0.0;      ///< [m] from the robot's centre
  bool no_return = false;  ///< nothing came back; range: how far it looked
};

/// All valid beams of one or more lasers about the robot's centre.
struct RangeSweep {
  std::vector<SweepBeam> beams;  ///< in any order
};

/// What a beam ended on, as far as a belief and a map can tell.
enum class BeamOrigin : std::uint8_t {
  unknown = 0,    ///< nothing came back, the map says nothing there, or the place of the robot is not known
  map = 1,        ///< what the map holds
  maybe_map = 2,  ///< short of the map, but so near to something in it that it may be this, a little displaced
  not_map = 3,    ///< clear of everything in the map: a person or another unmapped thing
};

/// Adds the valid beams of a reading. `base_from_sensor` is the sensor's place at the time of the sweep; multiply by
/// the robot's motion where the reading is older. Beams without a return keep their direction. O(beams).
void append(RangeSweep& sweep, const LaserReading& reading, const Pose2& base_from_sensor);

/// The sweep as if measured from another place nearby: `there_from_here` takes base coordinates to the other frame.
[[nodiscard]] RangeSweep seen_from(const RangeSweep& sweep, const Pose2& there_from_here);

/// The sweep as one sees it who expects nothing farther off than `reach` [m]: what came from there or beyond, and what
/// looked farther, is "no return" at `reach`. Who looked less far stays as it is: a scanner of 4 m says nothing of 5 m.
/// Every comparison of a reading with what a map lets expect needs this first. O(beams)
[[nodiscard]] RangeSweep within_reach(RangeSweep sweep, double reach);

/// Endpoint in the base frame [m].
[[nodiscard]] Point2 endpoint(const SweepBeam& beam);

/// A beam in the belief's own directions.
struct BinnedBeam {
  std::uint16_t direction = 0;  ///< 0..directions-1: bearing in steps of 360/directions degrees
  std::uint16_t beam = 0;       ///< index in the sweep
};

/// At most one beam a direction, the one nearest to its middle. In the order of directions. O(beams + directions).
[[nodiscard]] std::vector<BinnedBeam> binned(const RangeSweep& sweep, int directions);

/// At most `most` of the beams, evenly spread; each `phase` begins elsewhere, so that all beams have their turn.
[[nodiscard]] std::vector<BinnedBeam> thinned(std::span<const BinnedBeam> beams, std::size_t most, std::size_t phase);

}  // namespace docent::sensor_models
