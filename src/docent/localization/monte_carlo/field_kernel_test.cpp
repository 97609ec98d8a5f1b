#include "docent/localization/monte_carlo/field_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/localization/monte_carlo/testing.h"

namespace docent::localization {
namespace {

std::vector<Point2> any_ends(Rng& rng, std::int64_t count, double reach) {
  std::vector<Point2> ends;
  for (std::int64_t i = 0; i < count; ++i)
    ends.push_back(rng.uniform(0.1, reach) * unit(Angle::degrees(rng.uniform(0.0, 360.0))));
  return ends;
}

/// Of `each` beams a sector, and an empty one.
FieldBeams beams_of(const LikelihoodField& field, const std::vector<Point2>& ends, std::size_t each) {
  FieldBeams beams;
  beams.close_sector();
  for (const Point2 end : ends) {
    beams.add(field.view(), end);
    if (beams.ends.size() % each == 0) beams.close_sector();
  }
  if (beams.sector_ends.back() != beams.ends.size()) beams.close_sector();
  return beams;
}

class FieldKernels : public ::testing::TestWithParam<const char*> {};

TEST_P(FieldKernels, IsThePlainOneBitForBit) {
  const auto kernels = field_kernels();
  const auto found = std::find_if(kernels.begin(), kernels.end(), [](const auto& k) { return k.name == GetParam(); });
  if (found == kernels.end()) GTEST_SKIP() << "not run: this processor has no " << GetParam();
  const sensor_models::RayCaster caster{testing::room_map()};
  const LikelihoodField field{caster, {}, 10.0};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    // Some stand outside the map: kernels take them to its border.
    ParticleSet particles = testing::any_particles(rng, static_cast<std::size_t>(rng.integer(1, 200)), 8.0, 6.0);
    const auto ends = any_ends(rng, rng.integer(0, 200), 10.0);
    FieldBeams beams = beams_of(field, ends, static_cast<std::size_t>(rng.integer(1, 70)));
    FieldPoses poses;
    poses.fill(field.view(), particles);
    if (seed % 2 == 0) beams.cap = 200;
    std::vector<std::uint32_t> expected(particles.padded_size(), 7);
    std::vector<std::uint32_t> costs(particles.padded_size(), 9);
    kernels.front().kernel(field.view(), beams, poses, expected.data());
    found->kernel(field.view(), beams, poses, costs.data());
    EXPECT_EQ(costs, expected);
  }
}
INSTANTIATE_TEST_SUITE_P(Sets, FieldKernels, ::testing::Values("plain", "avx2", "avx512"),
                         [](const auto& of) { return std::string{of.param}; });

TEST(FieldKernel, ThePlainOneIsTheObviousSum) {
  const sensor_models::RayCaster caster{testing::room_map()};
  const LikelihoodField field{caster, {}, 10.0};
  Rng rng{11};
  const ParticleSet particles = testing::any_particles(rng, 300, 6.0, 4.0);
  const auto ends = any_ends(rng, 60, 9.9);
  FieldBeams beams = beams_of(field, ends, 10);
  FieldPoses poses;
  poses.fill(field.view(), particles);
  beams.cap = 500;
  std::vector<std::uint32_t> costs(particles.padded_size());
  field_kernels().front().kernel(field.view(), beams, poses, costs.data());
  double off = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    std::uint32_t total = 0;
    std::size_t b = 0;
    for (const std::uint32_t end : beams.sector_ends) {
      std::uint32_t sum = 0;
      for (; b < end; ++b) sum += field.cost(particles.pose(i) * ends[b]);
      total += std::min<std::uint32_t>(sum, 500);
    }
    off += std::abs(static_cast<double>(total) - static_cast<double>(costs[i]));
    all += total;
  }
  // Fixed point: a beam that ends within a few hundredths of a cell of a border may fall into the next cell.
  EXPECT_LT(off, 0.01 * all);
}

TEST(LikelihoodField, AMapWithTooManyCellsGetsCoarserOnes) {
  OccupancyGrid map;
  map.frame = {33000, 4, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  map.cells[map.frame.index({32900, 1})] = OccupancyGrid::kOccupied;
  const sensor_models::RayCaster caster{map};
  const LikelihoodField field{caster, {}, 5.0};
  EXPECT_FLOAT_EQ(field.view().scale, 10.0F);
  EXPECT_LT(field.cost(map.frame.centre({32900, 1})), field.cost(map.frame.centre({32000, 1})));
}

TEST(LikelihoodField, IsBestAtWallsAndWorstFarFromThem) {
  const sensor_models::RayCaster caster{testing::room_map()};
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
}  // namespace docent::localization
