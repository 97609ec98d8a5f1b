#include "docent/collision_avoidance/virtual_measurements.h"

#include <benchmark/benchmark.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent {
namespace {

VirtualMeasurements museum() {
  std::vector<Polygon> hazards;
  for (int i = 0; i < 12; ++i) {
    const double x = 3.0 + 7.0 * (i % 4);
    const double y = 3.0 + 9.0 * (i / 4);
    hazards.push_back({{x, y}, {x + 1.5, y}, {x + 1.5, y + 1.0}, {x, y + 1.0}});
  }
  return {{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, hazards, {}};
}

void measure(benchmark::State& state) {
  auto measurements = museum();
  Rng rng{1};
  std::vector<WeightedPose> belief;
  const bool broad = state.range(1) != 0;
  for (int i = 0; i < state.range(0); ++i) {
    const double x = broad ? rng.uniform(0, 30) : rng.normal(15, 0.3);
    const double y = broad ? rng.uniform(0, 30) : rng.normal(15, 0.3);
    belief.push_back({{0.15 * std::round(x / 0.15), 0.15 * std::round(y / 0.15)}, rng.uniform(-3, 3), 1.0});
  }
  benchmark::DoNotOptimize(measurements.measure(belief, {}));  // learns the positions
  for (auto _ : state) benchmark::DoNotOptimize(measurements.measure(belief, {}));
}
BENCHMARK(measure)->Args({300, 0})->Args({8192, 0})->Args({8192, 1})->Unit(benchmark::kMillisecond);

void first_sight_of_8192_positions(benchmark::State& state) {
  Rng rng{1};
  std::vector<WeightedPose> belief;
  for (int i = 0; i < 8192; ++i) belief.push_back({{rng.uniform(0, 30), rng.uniform(0, 30)}, 0.0, 1.0});
  for (auto _ : state) {
    auto measurements = museum();
    benchmark::DoNotOptimize(measurements.measure(belief, {}));
  }
}
BENCHMARK(first_sight_of_8192_positions)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace docent
