#include "docent/sensor_models/proximity_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "docent/base/check.h"

namespace docent {

namespace {
double normal_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }
}  // namespace

Result<void> ProximityModelParams::validate() const {
  if (!(max_range > 0.0 && max_range <= 1000.0)) return fail("sensor.max_range must be > 0 and <= 1000");
  if (!(sigma > 0.0)) return fail("sensor.sigma must be > 0");
  if (!(sigma_per_metre >= 0.0)) return fail("sensor.sigma_per_metre must be >= 0");
  if (!(short_per_metre > 0.0)) return fail("sensor.short_per_metre must be > 0");
  if (!(near_factor > 0.0)) return fail("sensor.near_factor must be > 0");
  for (const double weight : {weight_hit, weight_near, weight_short, weight_no_return})
    if (!(weight >= 0.0)) return fail("sensor.weight_* must be >= 0");
  if (!(weight_random > 0.0)) return fail("sensor.weight_random must be > 0: no reading is impossible");
  return {};
}

ProximityModel::ProximityModel(const ProximityModelParams& params, std::span<const double> expected_frequency)
    : params_{params}, bins_per_log_{kNoReturn / std::log1p(params.max_range / kFinest)} {
  const std::size_t size = static_cast<std::size_t>(kRangeBins) * kExpectedRanges;
  gaussian_.assign(size, 0.0);
  mixture_.assign(size, 0.0);
  shorter_.assign(size, 0.0F);
  log_mixture_.assign(size, 0.0F);
  fill_gaussian();
  fill_mixture();
  fill_unknown(expected_frequency);
  std::transform(mixture_.begin(), mixture_.end(), log_mixture_.begin(),
                 [](double p) { return static_cast<float>(std::log(p)); });
}

int ProximityModel::bin(double range) const {
  if (!(range < params_.max_range)) return kNoReturn;
  return std::clamp(static_cast<int>(bins_per_log_ * std::log1p(range / kFinest)), 0, kNoReturn - 1);
}

double ProximityModel::lower_edge(int bin) const { return kFinest * std::expm1(bin / bins_per_log_); }

double ProximityModel::centre(int bin) const {
  return bin >= kNoReturn ? params_.max_range : 0.5 * (lower_edge(bin) + lower_edge(bin + 1));
}

double ProximityModel::sigma(int expected) const {
  return std::hypot(params_.sigma, params_.sigma_per_metre * centre(expected));
}

double ProximityModel::near_wall(int measured, int expected) const {
  if (expected == kNoReturn) return measured == kNoReturn ? 1.0 : 0.0;
  // Laplace: heavy tails about the wall, as of doors that stand open and of walls seen at a grazing angle.
  const double mean = centre(expected);
  const double scale = params_.near_factor * sigma(expected);
  const auto below = [&](double range) {
    const double z = (range - mean) / scale;
    return z < 0.0 ? 0.5 * std::exp(z) : 1.0 - 0.5 * std::exp(-z);
  };
  const double cut = below(0.0);
  const double upper = measured == kNoReturn ? 1.0 : below(lower_edge(measured + 1));
  return (upper - below(lower_edge(measured))) / (1.0 - cut);
}

void ProximityModel::fill_gaussian() {
  for (int expected = 0; expected < kRangeBins; ++expected) {
    if (expected == kNoReturn) {  // nothing within reach: a sensor that works says so
      gaussian_[index(kNoReturn, expected)] = 1.0;
    } else {
      const double mean = centre(expected);
      const double deviation = sigma(expected);
      const double below_zero = normal_below(-mean / deviation);  // cut off: ranges are not negative
      double before = below_zero;
      for (int measured = 0; measured < kRangeBins; ++measured) {
        const double upper = lower_edge(measured + 1);
        const double below = measured == kNoReturn ? 1.0 : normal_below((upper - mean) / deviation);
        gaussian_[index(measured, expected)] = (below - before) / (1.0 - below_zero);
        before = below;
      }
    }
    double longer = 0.0;  // eq. 7: the sum over j > i
    for (int measured = kNoReturn; measured >= 0; --measured) {
      shorter_[index(measured, expected)] = static_cast<float>(longer);
      longer += gaussian_[index(measured, expected)];
    }
  }
}

double ProximityModel::uniform(int measured) const {
  constexpr double kNothing = 1.0 / kRangeBins;  // the share of "no return"
  if (measured == kNoReturn) return kNothing;
  return (1.0 - kNothing) * (lower_edge(measured + 1) - lower_edge(measured)) / params_.max_range;
}

void ProximityModel::fill_mixture() {
  const double total = params_.weight_hit + params_.weight_near + params_.weight_short + params_.weight_no_return +
                       params_.weight_random;
  const double rate = params_.short_per_metre;
  for (int expected = 0; expected < kRangeBins; ++expected) {
    // Things in front of the wall: exponential in range, which is geometric over equal bins, cut off at the wall's bin.
    const double end = expected == kNoReturn ? params_.max_range : lower_edge(expected + 1);
    const double in_front = -std::expm1(-rate * end);
    for (int measured = 0; measured < kRangeBins; ++measured) {
      double p = params_.weight_hit * gaussian_[index(measured, expected)];
      p += params_.weight_near * near_wall(measured, expected);
      if (measured <= expected && measured < kNoReturn) {
        const double share = std::exp(-rate * lower_edge(measured)) - std::exp(-rate * lower_edge(measured + 1));
        p += params_.weight_short * share / in_front;
      }
      if (measured == kNoReturn) p += params_.weight_no_return;
      p += params_.weight_random * uniform(measured);
      mixture_[index(measured, expected)] = p / total;
    }
  }
}

void ProximityModel::fill_unknown(std::span<const double> expected_frequency) {
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
  const double total = params_.weight_hit + params_.weight_near + params_.weight_short + params_.weight_no_return +
                       params_.weight_random;
  for (int measured = 0; measured < kRangeBins; ++measured) {
    // Where the map does not say, something stands anywhere. The mean of all places instead would favour places at the
    // map's border: it knows how readings are distributed in this building, and so is better than most wrong places.
    mixture_[index(measured, kUnknownRange)] = ((total - params_.weight_no_return) * uniform(measured) +
                                                (measured == kNoReturn ? params_.weight_no_return : 0.0)) /
                                               total;
    double mean = 0.0;
    for (int expected = 0; expected < kRangeBins; ++expected)
      mean += frequency[static_cast<std::size_t>(expected)] / sum * mixture_[index(measured, expected)];
    log_mean_[static_cast<std::size_t>(measured)] = std::log(mean);
  }
}

}  // namespace docent
