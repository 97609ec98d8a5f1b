#include "docent/localization/particles/resampling.h"

#include <benchmark/benchmark.h>

#include "docent/localization/particles/testing.h"

/// Linear: the time a particle stays the same from a thousand to a million, but for the caches.
namespace docent::localization {
namespace {

void resampling(benchmark::State& state) {
  Rng rng{1};
  const auto count = static_cast<std::size_t>(state.range(0));
  const ParticleSet from = testing::any_particles(rng, count, 30.0, 30.0);
  ParticleSet to;
  for (auto _ : state) {
    to.clear();
    resample(from, 0, count, count, rng.uniform(), to);
    benchmark::DoNotOptimize(to.x.data());
  }
  state.counters["ns/particle"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(count) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(resampling)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace docent::localization
