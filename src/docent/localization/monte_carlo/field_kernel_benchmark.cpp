#include "docent/localization/monte_carlo/field_kernel.h"

#include <benchmark/benchmark.h>

#include <cmath>

#include "docent/localization/monte_carlo/benchmark_hall.h"

/// The likelihood field, 10,000 particles x 180 beams: every instruction set beside a good scalar loop over the same
/// 8-bit field, which has the same margin and so no check of bounds either. `tracking`: particles within a third of a
/// metre; `anywhere`: all over the hall. Ratios within one run mean something.
namespace docent::localization {
namespace {

struct Bench {
  sensor_models::RayCaster caster{testing::hall_map()};
  LikelihoodField field{caster, {}, 30.0};
  std::vector<double> scan = testing::hall_scan(caster);
  ParticleSet tracking = testing::hall_cloud(0.15);
  ParticleSet anywhere = [] {
    Rng rng{4};
    return testing::any_particles(rng, testing::kHallParticles, 50.0, 50.0);
  }();
};
const Bench& bench() {
  static const Bench instance;
  return instance;
}

void count_pairs(benchmark::State& state) {
  const double pairs = static_cast<double>(testing::kHallParticles) * testing::kHallBeams;
  state.counters["ns/particle-beam"] = benchmark::Counter(static_cast<double>(state.iterations()) * pairs * 1e-9,
                                                          benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Particle by particle, no sectors: what anybody would write.
void scalar_loop(benchmark::State& state, const ParticleSet& particles) {
  const LikelihoodField::View field = bench().field.view();
  std::vector<float> beam_x;
  std::vector<float> beam_y;
  for (const Point2 end : testing::hall_ends(bench().scan)) {
    beam_x.push_back(static_cast<float>(end.x) * field.scale);
    beam_y.push_back(static_cast<float>(end.y) * field.scale);
  }
  std::vector<std::uint32_t> costs(particles.padded_size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const float column = particles.x[i] * field.scale + field.left;
      const float row = particles.y[i] * field.scale + field.bottom;
      const float c = particles.heading_x[i];
      const float s = particles.heading_y[i];
      std::uint32_t sum = 0;
      for (std::size_t b = 0; b < beam_x.size(); ++b) {
        const auto at_column = static_cast<std::int32_t>(column + c * beam_x[b] - s * beam_y[b]);
        const auto at_row = static_cast<std::int32_t>(row + s * beam_x[b] + c * beam_y[b]);
        sum += field.costs[at_row * field.stride + at_column];
      }
      costs[i] = sum;
    }
    benchmark::DoNotOptimize(costs.data());
    benchmark::ClobberMemory();
  }
  count_pairs(state);
}

void with_kernel(benchmark::State& state, FieldKernel kernel, const ParticleSet& particles) {
  const FieldBeams beams = testing::hall_beams(bench().field, bench().scan);
  std::vector<std::uint32_t> costs(particles.padded_size());
  FieldPoses poses;
  for (auto _ : state) {
    poses.fill(bench().field.view(), particles);
    kernel(bench().field.view(), beams, poses, costs.data());
    benchmark::DoNotOptimize(costs.data());
    benchmark::ClobberMemory();
  }
  count_pairs(state);
}

[[maybe_unused]] const int kRegistered = [] {
  for (const auto& [place, particles] : {std::pair{"tracking", &bench().tracking}, {"anywhere", &bench().anywhere}}) {
    benchmark::RegisterBenchmark((std::string{"field/"} + place + "/scalar_loop").c_str(),
                                 [p = particles](benchmark::State& state) { scalar_loop(state, *p); });
    for (const auto& [name, kernel] : field_kernels())
      benchmark::RegisterBenchmark((std::string{"field/"} + place + "/" + name).c_str(),
                                   [k = kernel, p = particles](benchmark::State& state) { with_kernel(state, k, *p); });
  }
  return 0;
}();

}  // namespace
}  // namespace docent::localization
