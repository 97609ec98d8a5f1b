#include "docent/localization/particles/resampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "docent/localization/monte_carlo/testing.h"

namespace docent::localization {
namespace {

/// Particle i stands at x = i, so that its copies can be counted.
ParticleSet numbered(Rng& rng, std::size_t count) {
  ParticleSet particles = testing::any_particles(rng, count, 1.0, 1.0);
  for (std::size_t i = 0; i < count; ++i) particles.x[i] = static_cast<float>(i);
  return particles;
}

TEST(Resampling, EachIsDrawnItsExpectedNumberOfTimesRoundedUpOrDown) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    const auto count = static_cast<std::size_t>(rng.integer(1, 300));
    const auto wanted = static_cast<std::size_t>(rng.integer(1, 1000));
    const ParticleSet from = numbered(rng, count);
    ParticleSet to;
    resample(from, 0, count, wanted, rng.uniform(), to);
    ASSERT_EQ(to.size(), wanted);
    std::vector<int> copies(count, 0);
    for (std::size_t i = 0; i < wanted; ++i) ++copies[static_cast<std::size_t>(to.x[i])];
    const double mass = from.mass(0, count);
    for (std::size_t i = 0; i < count; ++i) {
      const double expected = static_cast<double>(from.weight[i]) / mass * static_cast<double>(wanted);
      EXPECT_GE(copies[i], std::floor(expected - 1e-6)) << i;
      EXPECT_LE(copies[i], std::ceil(expected + 1e-6)) << i;
    }
    EXPECT_NEAR(to.mass(0, wanted), mass, 1e-4 * mass);
  }
}

TEST(Resampling, IsUnbiased) {
  Rng rng{3};
  const ParticleSet from = numbered(rng, 40);
  std::vector<double> copies(40, 0.0);
  constexpr int kTrials = 20000;
  constexpr std::size_t kWanted = 25;  // fewer than there are
  for (int trial = 0; trial < kTrials; ++trial) {
    ParticleSet to;
    resample(from, 0, 40, kWanted, rng.uniform(), to);
    for (std::size_t i = 0; i < kWanted; ++i) copies[static_cast<std::size_t>(to.x[i])] += 1.0;
  }
  const double mass = from.mass(0, 40);
  for (std::size_t i = 0; i < 40; ++i) {
    const double expected = static_cast<double>(from.weight[i]) / mass * kWanted;
    // The variance of a rounded number is at most a quarter; five deviations of the mean.
    EXPECT_NEAR(copies[i] / kTrials, expected, 5.0 * 0.5 / std::sqrt(kTrials)) << i;
  }
}

TEST(Resampling, AStratumKeepsItsMassAndItsPlaceBehindTheOthers) {
  Rng rng{4};
  const ParticleSet from = numbered(rng, 100);
  ParticleSet to;
  resample(from, 0, 60, 10, 0.3, to);
  resample(from, 60, 100, 90, 0.7, to);
  ASSERT_EQ(to.size(), 100U);
  EXPECT_NEAR(to.mass(0, 10), from.mass(0, 60), 1e-4);
  EXPECT_NEAR(to.mass(10, 100), from.mass(60, 100), 1e-4);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_LT(to.x[i], 60.0F);
  for (std::size_t i = 10; i < 100; ++i) EXPECT_GE(to.x[i], 60.0F);
}

TEST(Resampling, FlattenedKeepsTheMassOfEveryPartAndMoreOfTheRare) {
  ParticleSet from;
  from.resize(2000);
  for (std::size_t i = 0; i < 2000; ++i) from.set(i, {static_cast<double>(i), 0.0, {}}, i < 1000 ? 1.0F : 1e-4F);
  Rng rng{8};
  double rare_mass = 0.0;
  std::size_t rare = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    ParticleSet to;
    resample_flattened(from, 0, 2000, 505, rng.uniform(), to);
    EXPECT_NEAR(to.mass(0, 505), 1000.1, 0.01);
    for (std::size_t i = 0; i < 505; ++i) {
      if (to.x[i] < 1000.0F) continue;
      ++rare;
      rare_mass += static_cast<double>(to.weight[i]);
    }
  }
  EXPECT_NEAR(rare_mass / kTrials, 0.1, 0.01);
  EXPECT_NEAR(static_cast<double>(rare) / kTrials, 5.0, 0.2);  // by weight it would be one in twenty trials
}

TEST(Resampling, WeightlessParticlesAreNeverDrawn) {
  Rng rng{5};
  ParticleSet from = numbered(rng, 64);
  for (std::size_t i = 0; i < 64; ++i)
    if (i % 3 != 1) from.weight[i] = 0.0F;
  for (const double offset : {0.0, 0.5, 0.999999999}) {
    ParticleSet to;
    resample(from, 0, 64, 1000, offset, to);
    for (std::size_t i = 0; i < to.size(); ++i) ASSERT_EQ(static_cast<int>(to.x[i]) % 3, 1);
  }
}

TEST(Resampling, EffectiveSizeOfEqualAndOfSingleWeights) {
  Rng rng{6};
  ParticleSet particles = numbered(rng, 50);
  for (std::size_t i = 0; i < 50; ++i) particles.weight[i] = 0.25F;
  EXPECT_NEAR(effective_size(particles, 0, 50), 50.0, 1e-3);
  for (std::size_t i = 1; i < 50; ++i) particles.weight[i] = 0.0F;
  EXPECT_NEAR(effective_size(particles, 0, 50), 1.0, 1e-9);
}

TEST(Kld, TheBoundHoldsInNinetyNineOfAHundredDraws) {
  // The distribution of the draws lies within `error` of the truth with the probability of the quantile.
  for (const std::size_t bins : {5U, 30U, 200U}) {
    SCOPED_TRACE(bins);
    KldParams params;
    const std::size_t samples = kld_sample_size(bins, params);
    Rng rng{bins};
    std::vector<double> truth(bins);
    double sum = 0.0;
    for (double& p : truth) sum += p = rng.uniform(0.2, 1.0);
    for (double& p : truth) p /= sum;
    constexpr int kTrials = 2000;
    int within = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<double> drawn(bins, 0.0);
      for (std::size_t i = 0; i < samples; ++i) {
        double u = rng.uniform();
        std::size_t bin = 0;
        while (bin + 1 < bins && u >= truth[bin]) u -= truth[bin++];
        drawn[bin] += 1.0 / static_cast<double>(samples);
      }
      double divergence = 0.0;
      for (std::size_t bin = 0; bin < bins; ++bin)
        if (drawn[bin] > 0.0) divergence += drawn[bin] * std::log(drawn[bin] / truth[bin]);
      within += divergence <= params.error ? 1 : 0;
    }
    EXPECT_GE(within, 0.975 * kTrials);   // 0.99 but for the approximation, which is one of many samples
    EXPECT_LE(within, 0.9999 * kTrials);  // not wildly more than needed
  }
}

TEST(Kld, MoreBinsOrLessErrorNeedMoreSamples) {
  KldParams params;
  EXPECT_EQ(kld_sample_size(0, params), 1U);
  EXPECT_EQ(kld_sample_size(1, params), 1U);
  EXPECT_LT(kld_sample_size(10, params), kld_sample_size(11, params));
  const std::size_t coarse = kld_sample_size(50, params);
  params.error = 0.01;
  EXPECT_GT(kld_sample_size(50, params), 4 * coarse);
}

TEST(Kld, CountsTheBinsThatHoldMass) {
  ParticleSet particles;
  particles.resize(100);
  for (std::size_t i = 0; i < 100; ++i)
    particles.set(i, {0.1 + 1.0 * static_cast<double>(i % 4), 0.1, Angle::degrees(5.0 + 20.0 * (i % 2 ? 0.0 : 1.0))},
                  0.01F);
  EXPECT_EQ(occupied_bins(particles, 0, 100, {}), 4U);
  for (std::size_t i = 3; i < 100; i += 4) particles.weight[i] = 1e-6F;
  EXPECT_EQ(occupied_bins(particles, 0, 100, {}), 3U);
  EXPECT_EQ(occupied_bins(particles, 0, 0, {}), 0U);
}

}  // namespace
}  // namespace docent::localization
