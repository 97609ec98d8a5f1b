#pragma once

#include <span>
#include <vector>

#include "docent/localization/learning/labels.h"
#include "docent/sensor_models/proximity_fit.h"

namespace docent::localization {

inline constexpr double kUnknownAllowance =
    0.3;  // [m] of unknown space that a beam may cross, as the range table has it

/// Where an expected range is looked up. `cell`: at the middle of the belief's cell and in its nearest heading, as the
/// grid localizer does; what the cells blur then becomes part of the sensor's noise. `pose`: at the label itself, for
/// localizers without cells.
enum class ExpectedAt { cell, pose };

/// Expected ranges of one sensor in one map.
class Expectation {
 public:
  /// All must outlive it. `table` was built for bins of `max_range`; with ExpectedAt::pose it is not asked.
  Expectation(const StateSpace& space, const RangeTable& table, const sensor_models::RayCaster& caster,
              double max_range, ExpectedAt at)
      : space_{space}, table_{table}, caster_{caster}, bins_{max_range}, at_{at} {}

  /// Adds all beams of a sweep taken at `map_from_sensor`. Nothing where that is no free place. O(beams).
  void add(const sensor_models::RangeSweep& sweep, const Pose2& map_from_sensor,
           sensor_models::ReadingCounts& counts) const;
  [[nodiscard]] const sensor_models::RangeBins& bins() const { return bins_; }

 private:
  [[nodiscard]] int expected(const Pose2& map_from_sensor, std::size_t place, double bearing) const;
  const StateSpace& space_;
  const RangeTable& table_;
  const sensor_models::RayCaster& caster_;
  sensor_models::RangeBins bins_;
  ExpectedAt at_;
};

/// A recording cut into pieces of way, of which every fourth is held out. Neighbouring scans see the same things, so
/// that single scans held out would be no test.
struct Pieces {
  std::vector<int> piece;  ///< of every sweep
  int count = 0;
  [[nodiscard]] static bool is_held_out(int piece) { return piece % 4 == 2; }
};
/// A radian turned counts half a metre. At least eight pieces, of 2 to 10 m. O(sweeps).
[[nodiscard]] Pieces pieces_of(std::span<const RecordedSweep> sweeps);

/// Readings of one recording, by piece.
struct CountedReadings {
  sensor_models::ReadingCounts fitted;
  std::vector<sensor_models::ReadingCounts> held_out;  ///< a piece each; empty ones are left out
  std::size_t sweeps = 0;                              ///< that were counted
};

struct ReadingParams {
  double step_way = 0.1;   ///< [m] between two sweeps of a sensor that count: a robot that stands sees the same again
  double step_turn = 5.0;  ///< [deg]
  double longest_carry = 1.0;  ///< [s] from a label to a reading of another sensor
};

/// Counts the readings of `sweeps` [any sensor, in the order of time] against the map, at the labels of `guide`, moved
/// on by odometry. The two may be the same. O(readings).
[[nodiscard]] CountedReadings count_readings(std::span<const RecordedSweep> sweeps,
                                             std::span<const RecordedSweep> guide, std::span<const PoseLabel> labels,
                                             const Pieces& pieces, const Expectation& expectation,
                                             const ReadingParams& params);

}  // namespace docent::localization
