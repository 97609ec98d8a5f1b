#include "docent/sensor_models/proximity_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"
#include "docent/sensor_models/proximity_model.h"

namespace docent::sensor_models {
namespace {

/// A building with walls at all distances, the near ones more often.
int any_expected(Rng& rng, const RangeBins& bins) {
  if (rng.chance(0.03)) return kNoReturn;
  return bins.bin(std::min(0.3 + rng.exponential(0.35 * bins.max_range()), 0.999 * bins.max_range()));
}

/// A reading by the model itself, through its cumulative distribution.
int any_measured(Rng& rng, const ProximityModel& model, int expected) {
  double left = rng.uniform();
  for (int measured = 0; measured < kNoReturn; ++measured)
    if ((left -= model.probability(measured, expected)) < 0.0) return measured;
  return kNoReturn;
}

ReadingCounts any_counts(Rng& rng, const ProximityModelParams& truth, int readings) {
  const ProximityModel model{truth};
  ReadingCounts counts{truth.max_range};
  for (int i = 0; i < readings; ++i) {
    const int expected = any_expected(rng, counts.bins());
    counts.add(any_measured(rng, model, expected), expected);
  }
  return counts;
}

/// Parameters of a sensor that there could be, in a building with people or without.
ProximityModelParams any_params(Rng& rng) {
  ProximityModelParams params;
  params.max_range = rng.uniform(5.0, 30.0);
  params.sigma = rng.uniform(0.06, 0.25);
  params.sigma_per_metre = rng.uniform(0.0, 0.04);
  params.short_per_metre = rng.uniform(0.15, 1.0);
  params.near_factor = rng.uniform(3.0, 6.0);
  params.weight_hit = rng.uniform(0.3, 0.6);
  params.weight_near = rng.uniform(0.1, 0.3);
  params.weight_short = rng.uniform(0.1, 0.4);
  params.weight_no_return = rng.uniform(0.01, 0.06);
  params.weight_random = rng.uniform(0.02, 0.08);
  return params;
}

/// So low that they bind nothing.
ProximityFitParams low_floors() {
  ProximityFitParams options;
  options.least_random = 0.005;
  options.least_no_return = 0.001;
  return options;
}

TEST(ProximityFit, LikelihoodIsThatOfTheModel) {
  Rng rng{7};
  const ProximityModelParams params = any_params(rng);
  const ReadingCounts counts = any_counts(rng, params, 5000);
  const ProximityModel model{params};
  double sum = 0.0;
  for (int expected = 0; expected < kRangeBins; ++expected)
    for (int measured = 0; measured < kRangeBins; ++measured)
      sum += static_cast<double>(counts.at(measured, expected)) * std::log(model.probability(measured, expected));
  EXPECT_NEAR(mean_log_likelihood(counts, params), sum / 5000.0, 1e-9);
}

TEST(ProximityFit, FindsTheParametersThatMadeTheReadings) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    const ProximityModelParams truth = any_params(rng);
    const ReadingCounts counts = any_counts(rng, truth, 150000);
    ProximityModelParams start;
    start.max_range = truth.max_range;
    const auto fit = fit_proximity_model(counts, start, low_floors());
    ASSERT_TRUE(fit) << fit.error().message;
    const ProximityModelParams& found = fit->params;
    // The width where most walls are; how it splits into a constant and a growing part hardly matters.
    const int wall = counts.bins().bin(0.25 * truth.max_range);
    EXPECT_NEAR(hit_deviation(found, counts.bins(), wall), hit_deviation(truth, counts.bins(), wall),
                0.08 * hit_deviation(truth, counts.bins(), wall));
    EXPECT_NEAR(found.short_per_metre, truth.short_per_metre, 0.1 * truth.short_per_metre + 0.02);
    EXPECT_NEAR(found.near_factor, truth.near_factor, 0.2 * truth.near_factor);
    const double total = truth.total_weight();
    EXPECT_NEAR(found.total_weight(), 1.0, 1e-9);
    EXPECT_NEAR(found.weight_hit, truth.weight_hit / total, 0.04);
    EXPECT_NEAR(found.weight_near, truth.weight_near / total, 0.04);
    EXPECT_NEAR(found.weight_short, truth.weight_short / total, 0.02);
    EXPECT_NEAR(found.weight_no_return, truth.weight_no_return / total, 0.01);
    EXPECT_NEAR(found.weight_random, truth.weight_random / total, 0.015);
    // Nothing explains the readings better than what made them, but for chance.
    EXPECT_GE(fit->after, mean_log_likelihood(counts, truth) - 5e-5);
    const ReadingCounts others = any_counts(rng, truth, 50000);
    EXPECT_NEAR(mean_log_likelihood(others, found), mean_log_likelihood(others, truth), 1e-3);
  }
}

TEST(ProximityFit, LikelihoodNeverFalls) {
  for (std::uint64_t seed = 20; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    const ProximityModelParams truth = any_params(rng);
    ReadingCounts counts = any_counts(rng, truth, 3000);
    for (int i = 0; i < 500; ++i)  // and some that no such sensor makes
      counts.add(static_cast<int>(rng.integer(0, kNoReturn)), static_cast<int>(rng.integer(0, kNoReturn)));
    ProximityModelParams start = any_params(rng);
    start.max_range = truth.max_range;
    const auto fit = fit_proximity_model(counts, start, low_floors());
    ASSERT_TRUE(fit) << fit.error().message;
    for (std::size_t i = 1; i < fit->history.size(); ++i) EXPECT_GE(fit->history[i], fit->history[i - 1] - 1e-12);
    EXPECT_GE(fit->after, fit->before - 0.02);  // the start may stand outside the floors
    EXPECT_EQ(fit->readings, 3500U);
    EXPECT_TRUE(fit->params.validate());
  }
}

TEST(ProximityFit, KeepsTheFloorsWhereReadingsSayNothing) {
  // Perfect readings of walls and nothing else.
  ReadingCounts counts{10.0};
  Rng rng{3};
  for (int i = 0; i < 20000; ++i) {
    const int expected = static_cast<int>(rng.integer(5, 100));
    counts.add(expected, expected);
  }
  const auto fit = fit_proximity_model(counts, {});
  ASSERT_TRUE(fit) << fit.error().message;
  const ProximityFitParams floors;
  EXPECT_NEAR(fit->params.weight_random, floors.least_random, 1e-6);
  EXPECT_NEAR(fit->params.weight_short, floors.least_short, 1e-6);
  EXPECT_NEAR(fit->params.weight_no_return, floors.least_no_return, 1e-6);
  EXPECT_GE(fit->params.sigma, floors.least_sigma);
  EXPECT_LT(fit->params.sigma, 0.04);
  EXPECT_GE(fit->params.short_per_metre, floors.least_short_per_metre);
  EXPECT_TRUE(fit->params.validate());
}

TEST(ProximityFit, RefusesTooFewReadings) {
  ReadingCounts counts{10.0};
  for (int i = 0; i < 1999; ++i) counts.add(3, 3);
  counts.add(3, kUnknownRange);  // the map does not say: no reading of the sensor's errors
  const auto fit = fit_proximity_model(counts, {});
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().message, "too few readings with a known place: 1999, at least 2000 are needed");
}

}  // namespace
}  // namespace docent::sensor_models
