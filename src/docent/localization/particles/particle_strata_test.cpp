#include "docent/localization/particles/particle_strata.h"

#include <gtest/gtest.h>

#include "docent/localization/monte_carlo/testing.h"

namespace docent::localization {
namespace {

constexpr Pose2 kHere{1.0, 1.0, Angle{}};

/// `near` particles about kHere with all but `far_mass` of the weight, `far` ones three metres away with that.
ParticleSet two_hills(std::size_t near, std::size_t far, double far_mass) {
  Rng rng{1};
  ParticleSet particles;
  particles.resize(near + far);
  for (std::size_t i = 0; i < near + far; ++i) {
    const bool is_far = i % (near + far) < far;
    const double x = (is_far ? 4.0 : 1.0) + rng.normal(0.0, 0.05);
    const double weight = is_far ? far_mass / static_cast<double>(far) : (1.0 - far_mass) / static_cast<double>(near);
    particles.set(i, {x, 1.0 + rng.normal(0.0, 0.05), Angle::degrees(rng.normal(0.0, 2.0))},
                  static_cast<float>(weight));
  }
  return particles;
}

std::pair<std::size_t, double> far_part(const ParticleSet& particles) {
  std::size_t count = 0;
  double mass = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.x[i] < 2.5F) continue;
    ++count;
    mass += static_cast<double>(particles.weight[i]);
  }
  return {count, mass};
}

TEST(ParticleStrata, AnUnlikelyRivalKeepsItsParticlesAndItsMass) {
  for (const double far_mass : {1e-2, 1e-4, 1e-8}) {
    SCOPED_TRACE(far_mass);
    ParticleSet particles = two_hills(5000, 1000, far_mass);
    ParticleSet scratch;
    Rng rng{2};
    resample_strata(particles, kHere, {300, 50000, 400, 0.5, {}}, rng, scratch);
    const auto [count, mass] = far_part(particles);
    EXPECT_EQ(count, 400U);
    EXPECT_NEAR(mass, far_mass, 1e-3 * far_mass);
    EXPECT_NEAR(particles.mass(0, particles.size()), 1.0, 1e-4);
    EXPECT_LT(particles.size(), 1200U);  // tracking: KLD asks for a few hundred
  }
}

TEST(ParticleStrata, ManyPlacesTakeManyParticles) {
  Rng rng{3};
  ParticleSet particles = testing::any_particles(rng, 20000, 30.0, 30.0);
  ParticleSet scratch;
  resample_strata(particles, kHere, {300, 5000, 400, 0.5, {}}, rng, scratch);
  EXPECT_GT(particles.size(), 4500U);
  EXPECT_LT(particles.size(), 5500U);
}

TEST(ParticleStrata, WhatIsEvenAndOfTheRightNumberStaysAsItIs) {
  ParticleSet particles = two_hills(320, 0, 0.0);
  const auto before = particles.x;
  ParticleSet scratch;
  Rng rng{4};
  resample_strata(particles, kHere, {300, 50000, 400, 0.5, {}}, rng, scratch);
  EXPECT_EQ(particles.x, before);
}

}  // namespace
}  // namespace docent::localization
