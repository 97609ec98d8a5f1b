#include "docent/localization/particles/particle_weights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/localization/monte_carlo/testing.h"

namespace docent::localization {
namespace {

std::vector<std::uint32_t> any_costs(Rng& rng, const ParticleSet& particles) {
  std::vector<std::uint32_t> costs(particles.padded_size(), 0);
  for (std::uint32_t& cost : costs) cost = static_cast<std::uint32_t>(rng.integer(100, 600));
  return costs;
}

TEST(ParticleWeights, WithoutCapsItIsBayes) {
  Rng rng{1};
  ParticleSet particles = testing::any_particles(rng, 77, 6.0, 4.0);
  const ParticleSet before = particles;
  const auto costs = any_costs(rng, particles);
  ParticleEvidence evidence;
  evidence.nats_per_cost = 0.01;
  const double mean = mean_likelihood(particles, costs, 0.01);
  const double likelihood = reweigh(particles, costs, evidence);
  EXPECT_NEAR(mean, likelihood, 1e-5 * mean);
  double mass = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < 77; ++i) {
    mass += static_cast<double>(before.weight[i]);
    sum += static_cast<double>(before.weight[i]) * std::exp(-0.01 * costs[i]);
  }
  EXPECT_NEAR(likelihood, sum / mass, 1e-5 * sum / mass);
  for (std::size_t i = 0; i < 77; ++i)
    EXPECT_NEAR(static_cast<double>(particles.weight[i]),
                static_cast<double>(before.weight[i]) * std::exp(-0.01 * costs[i]) / sum, 1e-6);
}

TEST(ParticleWeights, AScanCountsAtMostItsCap) {
  Rng rng{2};
  ParticleSet particles = testing::any_particles(rng, 50, 6.0, 4.0);
  const ParticleSet before = particles;
  const auto costs = any_costs(rng, particles);
  ParticleEvidence evidence;
  evidence.nats_per_cost = 1.0;
  evidence.most_nats = 2.0;
  reweigh(particles, costs, evidence);
  double least = 1e9;
  double most = 0.0;
  for (std::size_t i = 0; i < 50; ++i) {
    const double factor = static_cast<double>(particles.weight[i]) / static_cast<double>(before.weight[i]);
    least = std::min(least, factor);
    most = std::max(most, factor);
  }
  EXPECT_NEAR(std::log(most / least), 2.0, 1e-4);
}

TEST(ParticleWeights, InFocusSharpAndAsAWholeSlow) {
  Rng rng{3};
  ParticleSet particles = testing::any_particles(rng, 400, 6.0, 4.0);
  for (std::size_t i = 0; i < 200; ++i)
    particles.set(i, {2.0 + rng.uniform(-0.4, 0.4), 2.0, Angle::degrees(rng.uniform(-15.0, 15.0))}, 1.0F);
  for (std::size_t i = 200; i < 400; ++i) particles.set(i, {4.0, 2.0, Angle{}}, 1.0F);
  std::vector<std::uint32_t> costs(particles.padded_size(), 0);
  for (std::size_t i = 0; i < 400; ++i) costs[i] = i < 200 ? 100 + static_cast<std::uint32_t>(i) : 300;
  ParticleEvidence evidence;
  evidence.nats_per_cost = 0.05;
  evidence.focus = Neighbourhood{{2.0, 2.0, Angle{}}, 0.75, 0.45};
  evidence.far_share = 0.25;
  evidence.far_most_nats = 1.5;
  reweigh(particles, costs, evidence);
  EXPECT_NEAR(std::log(static_cast<double>(particles.weight[0] / particles.weight[60])), 60 * 0.05, 1e-3);
  double slow = 0.0;
  for (int above = 0; above < 200; ++above) slow += std::exp(-std::min(0.25 * 0.05 * above, 1.5));
  const double elsewhere = 200.0 * std::exp(-1.5);
  EXPECT_NEAR(particles.mass(0, 200), slow / (slow + elsewhere), 1e-4);
}

TEST(ParticleWeights, WithoutWeightNothingHappens) {
  Rng rng{4};
  ParticleSet particles = testing::any_particles(rng, 20, 6.0, 4.0);
  for (float& weight : particles.weight) weight = 0.0F;
  EXPECT_EQ(reweigh(particles, any_costs(rng, particles), {}), 0.0);
  EXPECT_EQ(particles.weight[3], 0.0F);
}

TEST(ParticleWeights, GatheringMovesMassInsideTheNeighbourhoodAndNothingElse) {
  ParticleSet particles;
  particles.resize(4);
  particles.set(0, {2.0, 2.0, Angle{}}, 0.4F);              // where the search found the robot
  particles.set(1, {2.7, 2.0, Angle{}}, 0.3F);              // beside it
  particles.set(2, {5.0, 2.0, Angle{}}, 0.2F);              // elsewhere
  particles.set(3, {2.0, 2.0, Angle::degrees(120)}, 0.1F);  // there, but looking elsewhere
  const Pose2 found{2.1, 2.0, Angle{}};
  gather(particles, {{found, 1.5, 0.5}, same_place(found), 0.97, 3.0});
  EXPECT_NEAR(particles.weight[0], 0.97F * 0.7F, 1e-5);
  EXPECT_NEAR(particles.weight[1], 0.03F * 0.7F, 1e-5);
  EXPECT_EQ(particles.weight[2], 0.2F);
  EXPECT_EQ(particles.weight[3], 0.1F);
  // Certain as the search may be, what lies beside loses no more than the most nats.
  gather(particles, {{found, 1.5, 0.5}, same_place(found), 1.0, 1.0});
  EXPECT_NEAR(particles.weight[1], 0.03F * 0.7F * std::exp(-1.0F), 1e-5);
  EXPECT_NEAR(particles.weight[0] + particles.weight[1], 0.7F, 1e-5);
  // A search that is less sure than the belief changes nothing.
  const float before = particles.weight[0];
  gather(particles, {{found, 1.5, 0.5}, same_place(found), 0.5, 3.0});
  EXPECT_EQ(particles.weight[0], before);
}

}  // namespace
}  // namespace docent::localization
