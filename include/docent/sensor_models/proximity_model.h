#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/sensor_models/proximity_parts.h"

namespace docent::sensor_models {

/// P(d | o) of your own, in place of the mixture of ProximityModelParams: give it to LocalizerParams::own_sensor. It is
/// asked when tables are made, never while a belief is updated.
class ReadingDistribution {
 public:
  ReadingDistribution() = default;
  ReadingDistribution(const ReadingDistribution&) = delete;
  ReadingDistribution& operator=(const ReadingDistribution&) = delete;
  virtual ~ReadingDistribution() = default;

  /// Fills `out` [kRangeBins] with the weight of each measured bin, kNoReturn the last: finite, > 0, and normalised
  /// later. `expected` is a bin, too, or kUnknownRange: the map does not say.
  virtual void fill(const RangeBins& bins, int expected, std::span<double> out) const = 0;
};

/// P(d_i | o): the second of the two look-ups of [Markov1998] 3.2.
class ProximityModel {
 public:
  /// `expected_frequency` [kExpectedRanges], or empty for a uniform one: how often each range is expected at a uniform
  /// position; entries need not be normalised. It gives the mean of eq. 4. `own`: replaces the mixture; what the
  /// Gaussian says (eq. 7: sigma, map_probability, shorter_probability) stays that of the params.
  /// @pre params are valid
  explicit ProximityModel(const ProximityModelParams& params, std::span<const double> expected_frequency = {},
                          const ReadingDistribution* own = nullptr);

  [[nodiscard]] int bin(double range) const { return bins_.bin(range); }  ///< of a range [m] >= 0
  /// What is measured when nothing comes back up to `range` [m]: kNoReturn, or kRangeBins + b of a scanner that looks
  /// less far than the model.
  [[nodiscard]] int nothing_up_to(double range) const {
    const int nearest = bin(range);
    return nearest == kNoReturn ? kNoReturn : kRangeBins + nearest;
  }
  [[nodiscard]] double lower_edge(int bin) const { return bins_.lower_edge(bin); }  ///< [m]
  [[nodiscard]] double centre(int bin) const { return bins_.centre(bin); }          ///< [m]; of kNoReturn: max_range
  [[nodiscard]] double sigma(int expected) const { return hit_deviation(params_, bins_, expected); }  ///< [m]

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
  /// Likewise, for all kExpectedRanges. `measured`: one of kMeasurements; where nothing came back, none is shorter.
  [[nodiscard]] std::span<const float> shorter_probabilities(int measured) const {
    return std::span{shorter_}.subspan(index(measured, 0), kExpectedRanges);
  }
  /// ln P(d_measured | o), for all kExpectedRanges. `measured`: one of kMeasurements. That nothing comes back up to bin
  /// b has the probability of all bins from b on.
  [[nodiscard]] std::span<const float> log_probabilities(int measured) const {
    return std::span{log_mixture_}.subspan(index(measured, 0), kExpectedRanges);
  }
  /// ln of the mean of P(d_measured | l) under a uniform position: eq. 4's P~. `measured`: one of kMeasurements.
  [[nodiscard]] double log_mean_probability(int measured) const {
    return log_mean_[static_cast<std::size_t>(measured)];
  }

 private:
  [[nodiscard]] static std::size_t index(int measured, int expected) {
    return static_cast<std::size_t>(measured) * kExpectedRanges + static_cast<std::size_t>(expected);
  }
  void fill_gaussian();
  void fill_mixture();
  void fill_unknown();
  void fill_own(const ReadingDistribution& own);
  void fill_nothing_up_to();
  void fill_mean(std::span<const double> expected_frequency);

  ProximityModelParams params_;
  RangeBins bins_;
  std::vector<double> gaussian_;    ///< [measured][expected]
  std::vector<double> mixture_;     ///< [kMeasurements][expected]
  std::vector<float> shorter_;      ///< [kMeasurements][expected]
  std::vector<float> log_mixture_;  ///< [kMeasurements][expected]
  std::array<double, kMeasurements> log_mean_{};
};

}  // namespace docent::sensor_models
