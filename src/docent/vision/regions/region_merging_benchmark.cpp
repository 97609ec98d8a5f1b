#include <benchmark/benchmark.h>

#include <algorithm>

#include "docent/base/random.h"
#include "docent/vision/regions/region_merging.h"

namespace docent::vision {
namespace {

/// A noisy picture of 40 patches. @param side  [sites] its longer one
Sites patches(int side) {
  Sites sites{side, side * 3 / 4, 1, {}};
  Rng rng{7};
  std::vector<float> shades;
  for (int i = 0; i < 40; ++i) shades.push_back(static_cast<float>(rng.uniform(30.0, 220.0)));
  for (int row = 0; row < sites.rows; ++row)
    for (int column = 0; column < sites.columns; ++column)
      sites.cells.push_back({shades[static_cast<std::size_t>(row * 5 / sites.rows * 8 + column * 8 / sites.columns)] +
                                 static_cast<float>(8.0 * rng.normal()),
                             0.0F, 0.0F});
  return sites;
}

void merge(benchmark::State& state) {
  const Sites sites = patches(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(merge_regions(sites));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sites.cells.size()));
}
BENCHMARK(merge)->Arg(80)->Arg(160)->Arg(320);

}  // namespace
}  // namespace docent::vision
