#include "docent/sensor_models/proximity_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::sensor_models {

namespace {
double normal_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

void fill_certain_no_return(std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  out[kNoReturn] = 1.0;
}
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

RangeBins::RangeBins(double max_range)
    : max_range_{max_range}, bins_per_log_{kNoReturn / std::log1p(max_range / kFinest)} {
  for (std::size_t i = 0; i < edges_.size(); ++i)
    edges_[i] = kFinest * std::expm1(static_cast<double>(i) / bins_per_log_);
}

int RangeBins::bin(double range) const {
  if (!(range < max_range_)) return kNoReturn;
  return std::clamp(static_cast<int>(bins_per_log_ * std::log1p(range / kFinest)), 0, kNoReturn - 1);
}

double RangeBins::centre(int bin) const {
  return bin >= kNoReturn ? max_range_ : 0.5 * (lower_edge(bin) + lower_edge(bin + 1));
}

double hit_deviation(const ProximityModelParams& params, const RangeBins& bins, int expected) {
  return std::hypot(params.sigma, params.sigma_per_metre * bins.centre(expected));
}

void fill_hit(const ProximityModelParams& params, const RangeBins& bins, int expected, std::span<double> out) {
  // Nothing within reach: a sensor that works says so.
  if (expected == kNoReturn) return fill_certain_no_return(out);
  const double mean = bins.centre(expected);
  const double deviation = hit_deviation(params, bins, expected);
  const double below_zero = normal_below(-mean / deviation);  // cut off: ranges are not negative
  double before = below_zero;
  for (int measured = 0; measured < kRangeBins; ++measured) {
    const double upper = bins.lower_edge(measured + 1);
    const double below = measured == kNoReturn ? 1.0 : normal_below((upper - mean) / deviation);
    out[static_cast<std::size_t>(measured)] = (below - before) / (1.0 - below_zero);
    before = below;
  }
}

void fill_near(const ProximityModelParams& params, const RangeBins& bins, int expected, std::span<double> out) {
  if (expected == kNoReturn) return fill_certain_no_return(out);
  const double mean = bins.centre(expected);
  const double scale = params.near_factor * hit_deviation(params, bins, expected);
  const auto below = [&](double range) {
    const double z = (range - mean) / scale;
    return z < 0.0 ? 0.5 * std::exp(z) : 1.0 - 0.5 * std::exp(-z);
  };
  const double cut = below(0.0);
  double before = cut;
  for (int measured = 0; measured < kRangeBins; ++measured) {
    const double upper = measured == kNoReturn ? 1.0 : below(bins.lower_edge(measured + 1));
    out[static_cast<std::size_t>(measured)] = (upper - before) / (1.0 - cut);
    before = upper;
  }
}

void fill_short(const ProximityModelParams& params, const RangeBins& bins, int expected, std::span<double> out) {
  const double rate = params.short_per_metre;
  const double end = expected == kNoReturn ? bins.max_range() : bins.lower_edge(expected + 1);
  const double in_front = -std::expm1(-rate * end);
  std::fill(out.begin(), out.end(), 0.0);
  double before = 1.0;
  for (int measured = 0; measured <= expected && measured < kNoReturn; ++measured) {
    const double after = std::exp(-rate * bins.lower_edge(measured + 1));
    out[static_cast<std::size_t>(measured)] = (before - after) / in_front;
    before = after;
  }
}

double random_probability(const RangeBins& bins, int measured) {
  constexpr double kNothing = 1.0 / kRangeBins;  // the share of "no return"
  if (measured == kNoReturn) return kNothing;
  return (1.0 - kNothing) * (bins.lower_edge(measured + 1) - bins.lower_edge(measured)) / bins.max_range();
}

}  // namespace docent::sensor_models
