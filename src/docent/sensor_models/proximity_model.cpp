#include "docent/sensor_models/proximity_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "docent/base/check.h"

namespace docent::sensor_models {

ProximityModel::ProximityModel(const ProximityModelParams& params, std::span<const double> expected_frequency,
                               const ReadingDistribution* own)
    : params_{params}, bins_{params.max_range} {
  const std::size_t size = static_cast<std::size_t>(kRangeBins) * kExpectedRanges;
  gaussian_.assign(size, 0.0);
  const std::size_t measurements = static_cast<std::size_t>(kMeasurements) * kExpectedRanges;
  mixture_.assign(measurements, 0.0);
  shorter_.assign(measurements, 0.0F);
  log_mixture_.assign(measurements, 0.0F);
  fill_gaussian();
  fill_mixture();
  fill_unknown();
  if (own != nullptr) fill_own(*own);
  fill_nothing_up_to();
  fill_mean(expected_frequency);
  std::transform(mixture_.begin(), mixture_.end(), log_mixture_.begin(),
                 [](double p) { return static_cast<float>(std::log(p)); });
}

void ProximityModel::fill_gaussian() {
  std::array<double, kRangeBins> hit{};
  for (int expected = 0; expected < kRangeBins; ++expected) {
    fill_hit(params_, bins_, expected, hit);
    double longer = 0.0;  // eq. 7: the sum over j > i
    for (int measured = kNoReturn; measured >= 0; --measured) {
      gaussian_[index(measured, expected)] = hit[static_cast<std::size_t>(measured)];
      shorter_[index(measured, expected)] = static_cast<float>(longer);
      longer += hit[static_cast<std::size_t>(measured)];
    }
  }
}

void ProximityModel::fill_mixture() {
  const double total = params_.total_weight();
  std::array<double, kRangeBins> near{};
  std::array<double, kRangeBins> in_front{};
  for (int expected = 0; expected < kRangeBins; ++expected) {
    fill_near(params_, bins_, expected, near);
    fill_short(params_, bins_, expected, in_front);
    for (int measured = 0; measured < kRangeBins; ++measured) {
      const auto i = static_cast<std::size_t>(measured);
      double p = params_.weight_hit * gaussian_[index(measured, expected)] + params_.weight_near * near[i] +
                 params_.weight_short * in_front[i] + params_.weight_random * random_probability(bins_, measured);
      if (measured == kNoReturn) p += params_.weight_no_return;
      mixture_[index(measured, expected)] = p / total;
    }
  }
}

void ProximityModel::fill_unknown() {
  const double total = params_.total_weight();
  for (int measured = 0; measured < kRangeBins; ++measured) {
    // Where the map does not say, something stands anywhere. The mean of all places instead would favour places at the
    // map's border: it knows how readings are distributed in this building, and so is better than most wrong places.
    mixture_[index(measured, kUnknownRange)] =
        ((total - params_.weight_no_return) * random_probability(bins_, measured) +
         (measured == kNoReturn ? params_.weight_no_return : 0.0)) /
        total;
  }
}

void ProximityModel::fill_own(const ReadingDistribution& own) {
  std::array<double, kRangeBins> weights{};
  for (int expected = 0; expected < kExpectedRanges; ++expected) {
    weights.fill(0.0);
    own.fill(bins_, expected, weights);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (int measured = 0; measured < kRangeBins; ++measured) {
      const double p = weights[static_cast<std::size_t>(measured)] / total;
      DOCENT_CHECK(p > 0.0 && std::isfinite(p));
      mixture_[index(measured, expected)] = p;
    }
  }
}

void ProximityModel::fill_nothing_up_to() {
  for (int expected = 0; expected < kExpectedRanges; ++expected) {
    double from_here_on = 0.0;
    for (int measured = kNoReturn; measured >= 0; --measured) {
      from_here_on += mixture_[index(measured, expected)];
      mixture_[index(kRangeBins + measured, expected)] = from_here_on;
    }
  }
}

void ProximityModel::fill_mean(std::span<const double> expected_frequency) {
  DOCENT_CHECK(expected_frequency.empty() || expected_frequency.size() == kExpectedRanges);
  std::array<double, kRangeBins> frequency{};
  if (expected_frequency.empty()) {
    frequency.fill(1.0);
  } else {
    std::copy_n(expected_frequency.begin(), kRangeBins, frequency.begin());
  }
  double sum = std::accumulate(frequency.begin(), frequency.end(), 0.0);
  if (!(sum > 0.0)) {
    frequency.fill(1.0);
    sum = kRangeBins;
  }
  for (int measured = 0; measured < kMeasurements; ++measured) {
    double mean = 0.0;
    for (int expected = 0; expected < kRangeBins; ++expected)
      mean += frequency[static_cast<std::size_t>(expected)] / sum * mixture_[index(measured, expected)];
    log_mean_[static_cast<std::size_t>(measured)] = std::log(mean);
  }
}

}  // namespace docent::sensor_models
