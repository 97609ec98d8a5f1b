#pragma once

#include <array>
#include <span>

#include "docent/base/result.h"

namespace docent::sensor_models {

/// How a range finder errs, [Markov1998] 3.2 and [Rhino1999] 3.1.2: a mixture of a Gaussian about the expected range, a
/// geometric density of unmapped things in front of it, a Dirac where nothing came back, and a uniform rest.
struct ProximityModelParams {
  double max_range = 10.0;         ///< [m], > 0; beyond it every range is "no return"
  double sigma = 0.13;             ///< [m], > 0: the sensor's noise, widened by the size of a belief cell
  double sigma_per_metre = 0.03;   ///< [m/m], >= 0: the heading's step seen from afar
  double short_per_metre = 0.2;    ///< [1/m], > 0: rate of the geometric density
  double weight_hit = 0.35;        ///< >= 0; the weights are normalised
  double weight_near = 0.30;       ///< of a Laplace density about the expected range: the map's small faults
  double near_factor = 3.0;        ///< > 0: its scale, as a multiple of the Gaussian's deviation
  double weight_short = 0.30;      ///< >= 0, of the geometric density
  double weight_no_return = 0.03;  ///< >= 0, of no return
  double weight_random = 0.05;     ///< > 0
  template <class V>
  void visit(V& v) {
    v("max_range", max_range);
    v("sigma", sigma);
    v("sigma_per_metre", sigma_per_metre);
    v("short_per_metre", short_per_metre);
    v("weight_hit", weight_hit);
    v("weight_near", weight_near);
    v("near_factor", near_factor);
    v("weight_short", weight_short);
    v("weight_no_return", weight_no_return);
    v("weight_random", weight_random);
  }
  /// What the weights are normalised by.
  [[nodiscard]] double total_weight() const {
    return weight_hit + weight_near + weight_short + weight_no_return + weight_random;
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Ranges are cut into bins d_0 … d_126, of which the last means "max_range or more, or no return". Near bins are
/// finer: their width grows with kFinest + range, from 4 to 13 cm over 10 m. An expected range is such a bin too, or
/// kUnknown: the map does not say. All fit in seven bits, so that a look-up is one shuffle.
inline constexpr int kRangeBins = 127;
inline constexpr int kNoReturn = kRangeBins - 1;  ///< max_range or more, or nothing came back
inline constexpr int kUnknownRange = 127;         ///< expected where the map does not say
inline constexpr int kExpectedRanges = 128;       ///< bins and kUnknownRange
/// What may be measured: a bin, or that nothing came back up to the lower edge of bin b, kRangeBins + b: so say
/// scanners that do not look as far as the model does.
inline constexpr int kMeasurements = 2 * kRangeBins;

/// The bins of a sensor's ranges.
class RangeBins {
 public:
  /// @pre max_range > 0 [m]
  explicit RangeBins(double max_range);

  [[nodiscard]] int bin(double range) const;  ///< of a range [m] >= 0
  /// [m]; 0..kRangeBins.
  [[nodiscard]] double lower_edge(int bin) const { return edges_[static_cast<std::size_t>(bin)]; }
  [[nodiscard]] double centre(int bin) const;                    ///< [m]; of kNoReturn: max_range
  [[nodiscard]] double max_range() const { return max_range_; }  ///< [m] where kNoReturn begins

 private:
  static constexpr double kFinest = 5.0;  ///< [m]
  double max_range_;
  double bins_per_log_;  ///< bins a unit of ln(1 + range / kFinest)
  std::array<double, kRangeBins + 1> edges_{};
};

// The parts of the mixture. Each fills `out` [kRangeBins] with the probabilities of the measured bins, sum 1, for one
// expected bin (not kUnknownRange). O(kRangeBins).

/// [m] of the Gaussian at an expected bin.
[[nodiscard]] double hit_deviation(const ProximityModelParams& params, const RangeBins& bins, int expected);
/// The map's range and the sensor's noise: a Gaussian, cut off at 0.
void fill_hit(const ProximityModelParams& params, const RangeBins& bins, int expected, std::span<double> out);
/// Laplace: heavy tails about the wall, as of doors that stand open and of walls seen at a grazing angle.
void fill_near(const ProximityModelParams& params, const RangeBins& bins, int expected, std::span<double> out);
/// Things in front of the wall: exponential in range, which is geometric over equal bins, cut off at the wall's bin.
void fill_short(const ProximityModelParams& params, const RangeBins& bins, int expected, std::span<double> out);
/// The uniform rest, the same for every expected range.
[[nodiscard]] double random_probability(const RangeBins& bins, int measured);

}  // namespace docent::sensor_models
