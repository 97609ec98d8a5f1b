#include "docent/localization/markov/position_belief.h"

#include <benchmark/benchmark.h>

#include <algorithm>

#include "docent/localization/markov/testing.h"

/// The full cycle of grid Markov localization over 7.2 million states (30 x 30 m, 15 cm, 2 degrees) with 180 beams, by
/// every instruction set that this processor has; beside it, the scoring alone and a bare gather-and-add loop.
/// Ratios within one run mean something.
namespace docent {
namespace {

constexpr int kBeams = 180;

struct Hall {
  OccupancyGrid map = [] {
    OccupancyGrid grid;
    grid.frame = {600, 600, 0.05, {}};
    grid.cells.assign(grid.frame.size(), OccupancyGrid::kFree);
    Rng rng{1};
    for (int i = 0; i < 25; ++i) {  // cases of half a metre
      const int left = static_cast<int>(rng.integer(20, 570));
      const int bottom = static_cast<int>(rng.integer(20, 570));
      for (int row = bottom; row < bottom + 10; ++row)
        for (int column = left; column < left + 10; ++column)
          grid.cells[grid.frame.index({column, row})] = OccupancyGrid::kOccupied;
    }
    return grid;
  }();
  RayCaster caster{map};
  StateSpace space{map, caster, {}};
  RangeTable table = RangeTable::build(space, caster, ProximityModel{{}});
};

const Hall& hall() {
  static const Hall instance;
  return instance;
}

std::vector<BeamCosts> beams() {
  Rng rng{2};
  auto result = testing::any_beams(rng, kBeams, hall().space.headings());
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.direction < b.direction; });
  return result;
}

void count_state_beams(benchmark::State& state) {
  const double done = static_cast<double>(hall().space.states()) * kBeams * static_cast<double>(state.iterations());
  state.counters["ns_per_state_beam"] =
      benchmark::Counter(done * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["states"] = static_cast<double>(hall().space.states());
}

void full_cycle(benchmark::State& state, ScoreKernel kernel) {
  PositionBelief belief{hall().space, 0.0};
  belief.use_kernel(kernel);
  const auto readings = beams();
  EvidenceWeights weights;
  weights.sectors = 12;
  weights.most_sector_nats = 1.0;
  const MotionKernel moved = motion_kernel(hall().space, {}, {0.15, 0.0}, {{0.002, 0.001}, 0.15, 0.02});
  for (auto _ : state) {
    belief.move(moved);
    belief.reweigh(hall().table, readings, 1.0, weights, 1e-7);
  }
  count_state_beams(state);
}

void motion(benchmark::State& state) {
  PositionBelief belief{hall().space, 0.0};
  const MotionKernel moved = motion_kernel(hall().space, {}, {0.15, 0.0}, {{0.002, 0.001}, 0.15, 0.02});
  for (auto _ : state) belief.move(moved);
  state.counters["offsets"] = static_cast<double>(moved.offsets.size());
}
BENCHMARK(motion)->Unit(benchmark::kMillisecond);

void scoring(benchmark::State& state, ScoreKernel kernel) {
  const auto readings = beams();
  std::array<std::uint16_t, 192> sums{};
  for (auto _ : state) {
    for (std::size_t place = 0; place < hall().space.places(); ++place) {
      kernel(hall().table.row(place), 0, 180, readings, sums.data());
      benchmark::DoNotOptimize(sums.data());
    }
  }
  count_state_beams(state);
}

/// One gather from a small table and one addition a state-beam, headings innermost; nothing else.
void bare_gather_and_add(benchmark::State& state) {
  const auto readings = beams();
  std::array<std::uint32_t, 180> sums{};
  for (auto _ : state) {
    for (std::size_t place = 0; place < hall().space.places(); ++place) {
      const std::uint8_t* const row = hall().table.row(place);
      sums.fill(0);
      for (const BeamCosts& beam : readings) {
        const std::uint8_t* const costs = beam.costs.data();
        for (std::size_t h = 0; h < 180; ++h) sums[h] += costs[row[h + beam.direction]];
      }
      benchmark::DoNotOptimize(sums.data());
    }
  }
  count_state_beams(state);
}

const bool kRegistered = [] {
  for (const NamedScoreKernel& named : score_kernels()) {
    benchmark::RegisterBenchmark(("full_cycle/" + named.name).c_str(), full_cycle, named.kernel)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("scoring/" + named.name).c_str(), scoring, named.kernel)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::RegisterBenchmark("bare_gather_and_add", bare_gather_and_add)->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace docent
