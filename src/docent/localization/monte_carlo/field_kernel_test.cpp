#include "docent/localization/monte_carlo/field_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/localization/monte_carlo/testing.h"

namespace docent {
namespace {

FieldBeams any_beams(Rng& rng, int sectors, int beams_each, double reach, double resolution) {
  FieldBeams beams;
  for (int sector = 0; sector < sectors; ++sector) {
    for (int i = 0; i < beams_each; ++i) {
      const Point2 end = rng.uniform(0.1, reach) * unit(Angle::degrees(rng.uniform(0.0, 360.0)));
      beams.x.push_back(static_cast<float>(end.x / resolution));
      beams.y.push_back(static_cast<float>(end.y / resolution));
    }
    beams.ends.push_back(static_cast<std::uint32_t>(beams.x.size()));
  }
  return beams;
}

class FieldKernels : public ::testing::TestWithParam<const char*> {};

TEST_P(FieldKernels, IsThePlainOneBitForBit) {
  const auto kernels = field_kernels();
  const auto found = std::find_if(kernels.begin(), kernels.end(), [](const auto& k) { return k.name == GetParam(); });
  if (found == kernels.end()) GTEST_SKIP() << "this processor has no " << GetParam();
  const RayCaster caster{testing::room_map()};
  const LikelihoodField field{caster, {}, 10.0};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    // Some stand outside the map: kernels take them to its border.
    ParticleSet particles = testing::any_particles(rng, static_cast<std::size_t>(rng.integer(1, 200)), 8.0, 6.0);
    FieldBeams beams =
        any_beams(rng, static_cast<int>(rng.integer(1, 12)), static_cast<int>(rng.integer(0, 20)), 10.0, 0.05);
    if (seed % 2 == 0) beams.cap = 200;
    std::vector<std::uint32_t> expected(particles.padded_size(), 7);
    std::vector<std::uint32_t> costs(particles.padded_size(), 9);
    kernels.front().kernel(field.view(), beams, particles, expected.data());
    found->kernel(field.view(), beams, particles, costs.data());
    EXPECT_EQ(costs, expected);
  }
}
INSTANTIATE_TEST_SUITE_P(Sets, FieldKernels, ::testing::Values("plain", "avx2", "avx512"),
                         [](const auto& of) { return std::string{of.param}; });

TEST(FieldKernel, ThePlainOneIsTheObviousSum) {
  const RayCaster caster{testing::room_map()};
  const LikelihoodField field{caster, {}, 10.0};
  Rng rng{11};
  const ParticleSet particles = testing::any_particles(rng, 300, 6.0, 4.0);
  FieldBeams beams = any_beams(rng, 6, 10, 9.9, 0.05);
  beams.cap = 500;
  std::vector<std::uint32_t> costs(particles.padded_size());
  field_kernels().front().kernel(field.view(), beams, particles, costs.data());
  std::size_t different = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    std::uint32_t total = 0;
    std::size_t b = 0;
    for (const std::uint32_t end : beams.ends) {
      std::uint32_t sum = 0;
      for (; b < end; ++b)
        sum += field.cost(particles.pose(i) *
                          Point2{0.05 * static_cast<double>(beams.x[b]), 0.05 * static_cast<double>(beams.y[b])});
      total += std::min<std::uint32_t>(sum, 500);
    }
    // A beam that ends within a rounding of a cell's border may fall into the next cell.
    different += total == costs[i] ? 0 : 1;
    EXPECT_NEAR(static_cast<double>(total), static_cast<double>(costs[i]), 60.0);
  }
  EXPECT_LT(different, particles.size() / 20);
}

TEST(LikelihoodField, IsBestAtWallsAndWorstFarFromThem) {
  const RayCaster caster{testing::room_map()};
  const LikelihoodField field{caster, {}, 10.0};
  EXPECT_EQ(field.cost({0.025, 2.0}), 0);  // in the wall
  const int near = field.cost({0.175, 2.0});
  const int far = field.cost({1.5, 2.0});
  EXPECT_GT(near, 0);
  EXPECT_GT(far, near);
  EXPECT_GE(field.cost({-5.0, 2.0}), far);   // in the margin
  EXPECT_EQ(field.cost({-50.0, 2.0}), 255);  // outside
  // By hand: 15 cm from the wall's middle.
  const LikelihoodFieldParams p;
  const auto density = [&](double d) {
    return p.weight_hit * std::exp(-0.5 * d * d / (p.sigma * p.sigma)) / (p.sigma * 2.5066282746) +
           p.weight_near * std::exp(-d / p.near_scale) / (2.0 * p.near_scale) + p.weight_random / 10.0;
  };
  const double clearance = static_cast<double>(caster.clearance({0.175, 2.0}));
  EXPECT_NEAR(near, kScorePerNat * std::log(density(0.0) / density(clearance)), 0.6);
}

}  // namespace
}  // namespace docent
