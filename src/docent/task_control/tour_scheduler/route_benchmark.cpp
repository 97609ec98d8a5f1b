#include "docent/task_control/tour_scheduler/route.h"

#include <benchmark/benchmark.h>

#include "docent/base/random.h"

namespace docent::task_control {
namespace {

/// The shortest route through so many stops with so many places each.
void shortest_route_of(benchmark::State& state) {
  Rng rng{7};
  std::vector<StopPlaces> stops(static_cast<std::size_t>(state.range(0)));
  for (StopPlaces& places : stops) {
    for (auto n = state.range(1); n > 0; --n) places.push_back({rng.uniform(0, 30), rng.uniform(0, 30)});
  }
  for (auto _ : state) benchmark::DoNotOptimize(shortest_route({15, 15}, stops, straight_distance()));
}
BENCHMARK(shortest_route_of)->Args({6, 1})->Args({12, 1})->Args({15, 1})->Args({15, 4})->Args({49, 1});

}  // namespace
}  // namespace docent::task_control
