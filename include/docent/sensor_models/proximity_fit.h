#pragma once

#include <cstdint>
#include <vector>

#include "docent/sensor_models/proximity_parts.h"

namespace docent::sensor_models {

/// How often each range was measured where each was expected: all that the likelihood of a proximity model needs of any
/// number of readings.
class ReadingCounts {
 public:
  /// @pre max_range > 0 [m]
  explicit ReadingCounts(double max_range)
      : bins_{max_range}, counts_(static_cast<std::size_t>(kRangeBins) * kRangeBins, 0) {}

  /// Bins; expected kUnknownRange counts for nothing: there the map says nothing about the sensor.
  void add(int measured, int expected);
  /// @pre both have the same max_range
  void add(const ReadingCounts& other);
  /// How often `measured` was read there.
  [[nodiscard]] std::uint64_t at(int measured, int expected) const { return counts_[index(measured, expected)]; }
  [[nodiscard]] std::uint64_t expected(int expected) const;      ///< readings where this range was expected
  [[nodiscard]] std::uint64_t total() const { return total_; }   ///< readings that counted
  [[nodiscard]] const RangeBins& bins() const { return bins_; }  ///< of both ranges

 private:
  [[nodiscard]] static std::size_t index(int measured, int expected) {
    return static_cast<std::size_t>(expected) * kRangeBins + static_cast<std::size_t>(measured);
  }
  RangeBins bins_;
  std::vector<std::uint64_t> counts_;  ///< [expected][measured]
  std::uint64_t total_ = 0;
};

/// Mean ln P(measured | expected) of a reading [nat]; 0 without readings. O(kRangeBins^2).
/// @pre params are valid and have the counts' max_range
[[nodiscard]] double mean_log_likelihood(const ReadingCounts& counts, const ProximityModelParams& params);

/// Bounds that keep a model usable where the readings do not say enough, and when to stop.
struct ProximityFitParams {
  double least_readings = 2000;  ///< fewer teach nothing
  /// Of the normalised weights. What this part stands for, faults of the map above all, comes in scenes of hundreds of
  /// readings, of which a recording holds few: as a share of the readings it comes out too small, and a belief that
  /// multiplies readings is then sure of wrong places (decision 0006).
  double least_random = 0.05;
  double least_short = 0.02;            ///< a building that was empty while it was recorded does not stay so
  double least_no_return = 0.01;        ///< black or slanted surfaces are everywhere
  double least_sigma = 0.01;            ///< [m]
  double most_sigma = 1.0;              ///< [m]
  double most_sigma_per_metre = 0.2;    ///< [m/m]
  double most_near_factor = 20.0;       ///< the least is 1: the tails are wider than the peak
  double least_short_per_metre = 0.01;  ///< [1/m]
  double most_short_per_metre = 10.0;   ///< [1/m]
  int most_rounds = 100;                ///< then it is enough
  double settled = 1e-6;                ///< [nat] a reading gained by a round: then it is enough
};

/// What was learned.
struct ProximityFit {
  ProximityModelParams params;  ///< weights sum to 1
  std::uint64_t readings = 0;   ///< that taught
  double before = 0.0;          ///< [nat] mean ln P of a reading by the start's parameters
  double after = 0.0;           ///< [nat] by the learned ones
  std::vector<double> history;  ///< [nat] after every round of the winning climb; never falls
};

/// Maximum likelihood fit of the mixture, [Rhino1999] 3.1.2. A round estimates the weights by EM (each reading is
/// shared out over the parts that could have made it), then sigma, sigma_per_metre, near_factor and short_per_metre one
/// after another by a search over the likelihood itself (conditional maximization). It climbs from `start` and, since
/// that may be far off, from a sharper and a blunter sensor; the best end counts. Deterministic.
///
/// Error: fewer readings than `least_readings`. O(rounds * kRangeBins^2). @pre start is valid, with the counts'
/// max_range
[[nodiscard]] Result<ProximityFit> fit_proximity_model(const ReadingCounts& counts, const ProximityModelParams& start,
                                                       const ProximityFitParams& options = {});

}  // namespace docent::sensor_models
