#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/result.h"

namespace docent {

/// How a range finder errs, [Markov1998] 3.2 and [Rhino1999] 3.1.2: a mixture of a Gaussian about the expected range, a
/// geometric density of unmapped things in front of it, a Dirac where nothing came back, and a uniform rest.
struct ProximityModelParams {
  double max_range = 10.0;        ///< [m], > 0; beyond it every range is "no return"
  double sigma = 0.13;            ///< [m], > 0: the sensor's noise, widened by the size of a belief cell
  double sigma_per_metre = 0.03;  ///< [m/m], >= 0: the heading's step seen from afar
  double short_per_metre = 0.2;   ///< [1/m], > 0: rate of the geometric density
  double weight_hit = 0.35;       ///< >= 0; the weights are normalised
  double weight_near = 0.30;      ///< of a Laplace density about the expected range: the map's small faults
  double near_factor = 3.0;       ///< > 0: its scale, as a multiple of the Gaussian's deviation
  double weight_short = 0.30;
  double weight_no_return = 0.03;
  double weight_random = 0.05;  ///< > 0
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
  [[nodiscard]] Result<void> validate() const;
};

/// Ranges are cut into bins d_0 … d_126, of which the last means "max_range or more, or no return". Near bins are
/// finer: their width grows with kFinest + range, from 4 to 13 cm over 10 m. An expected range is such a bin too, or
/// kUnknown: the map does not say. All fit in seven bits, so that a look-up is one shuffle.
inline constexpr int kRangeBins = 127;
inline constexpr int kNoReturn = kRangeBins - 1;
inline constexpr int kUnknownRange = 127;
inline constexpr int kExpectedRanges = 128;

/// P(d_i | o): the second of the two look-ups of [Markov1998] 3.2.
class ProximityModel {
 public:
  /// `expected_frequency` [kExpectedRanges], or empty for a uniform one: how often each range is expected at a uniform
  /// position; entries need not be normalised. It gives the mean of eq. 4.
  /// @pre params are valid
  explicit ProximityModel(const ProximityModelParams& params, std::span<const double> expected_frequency = {});

  [[nodiscard]] int bin(double range) const;       ///< of a range [m] >= 0
  [[nodiscard]] double lower_edge(int bin) const;  ///< [m]
  [[nodiscard]] double centre(int bin) const;      ///< [m]; of kNoReturn: max_range
  [[nodiscard]] double sigma(int expected) const;  ///< [m]

  /// P(d_measured | o_expected); sums to 1 over the kRangeBins measured bins.
  [[nodiscard]] double probability(int measured, int expected) const { return mixture_[index(measured, expected)]; }
  /// P_m, eq. 7: the Gaussian alone. Sums to 1 over the measured bins; 0 where the map does not say.
  [[nodiscard]] double map_probability(int measured, int expected) const {
    return gaussian_[index(measured, expected)];
  }
  /// P_short(d_measured | l), eq. 7: that the reading is shorter than what the map lets expect. 0 where it does not
  /// say.
  [[nodiscard]] float shorter_probability(int measured, int expected) const {
    return shorter_[index(measured, expected)];
  }
  [[nodiscard]] std::span<const float> shorter_probabilities(int measured) const {
    return std::span{shorter_}.subspan(index(measured, 0), kExpectedRanges);
  }
  /// ln P(d_measured | o), for all kExpectedRanges.
  [[nodiscard]] std::span<const float> log_probabilities(int measured) const {
    return std::span{log_mixture_}.subspan(index(measured, 0), kExpectedRanges);
  }
  /// ln of the mean of P(d_measured | l) under a uniform position: eq. 4's P~.
  [[nodiscard]] double log_mean_probability(int measured) const {
    return log_mean_[static_cast<std::size_t>(measured)];
  }

 private:
  static constexpr double kFinest = 5.0;  ///< [m]

  [[nodiscard]] static std::size_t index(int measured, int expected) {
    return static_cast<std::size_t>(measured) * kExpectedRanges + static_cast<std::size_t>(expected);
  }
  [[nodiscard]] double uniform(int measured) const;
  [[nodiscard]] double near_wall(int measured, int expected) const;
  void fill_gaussian();
  void fill_mixture();
  void fill_unknown(std::span<const double> expected_frequency);

  ProximityModelParams params_;
  double bins_per_log_;             ///< bins a unit of ln(1 + range / kFinest)
  std::vector<double> gaussian_;    ///< [measured][expected]
  std::vector<double> mixture_;     ///< [measured][expected]
  std::vector<float> shorter_;      ///< [measured][expected]
  std::vector<float> log_mixture_;  ///< [measured][expected]
  std::array<double, kRangeBins> log_mean_{};
};

}  // namespace docent
