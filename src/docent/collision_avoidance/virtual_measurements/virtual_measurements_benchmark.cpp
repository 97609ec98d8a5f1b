#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <unordered_map>

#include "docent/base/random.h"

namespace docent::collision_avoidance {
namespace {

/// @param jointly  false: the same measurements as the plain histogram's
VirtualMeasurements museum(bool jointly = false) {
  std::vector<Polygon> hazards;
  for (int i = 0; i < 12; ++i) {
    const double x = 3.0 + 7.0 * (i % 4);
    const double y = 3.0 + 9.0 * (i / 4);
    hazards.push_back({{x, y}, {x + 1.5, y}, {x + 1.5, y + 1.0}, {x, y + 1.0}});
  }
  VirtualMeasurementParams params;
  params.jointly = jointly;
  return {{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, hazards, params};
}

/// A belief of cells with some headings each, row after row as a localizer lists it. broad: all over the museum.
std::vector<WeightedPose> belief_of(int cells, bool broad) {
  Rng rng{1};
  std::vector<WeightedPose> belief;
  const double half = broad ? 14.9 : 0.075 * std::sqrt(cells / 4.0);
  const double step = 2.0 * half / std::sqrt(cells / 4.0);
  const auto on_lattice = [](double place) { return 0.025 * std::round(place / 0.025); };
  for (double y = 15.0 - half; y < 15.0 + half; y += step) {
    for (double x = 15.0 - half; x < 15.0 + half; x += step) {
      for (int heading = 0; heading < 4; ++heading) {
        belief.push_back({{on_lattice(x), on_lattice(y)}, 0.07 * heading, std::exp(rng.normal(0.0, 1.0))});
      }
    }
  }
  belief.resize(std::min(belief.size(), static_cast<std::size_t>(cells)));
  return belief;
}

/// [s] that this thread has computed: other work on the machine does not count.
double computed() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The same by a plain histogram: one look-up a pose, then its mass into one bin of each direction.
class PlainHistogram {
 public:
  PlainHistogram(VirtualMeasurements& measurements, std::span<const WeightedPose> belief) {
    for (const auto& pose : belief) {
      if (!measurements.is_possible(pose.position)) continue;
      auto& row = rows_[key_of(pose.position)];
      const WeightedPose single{pose.position, 0.0, 1.0};
      const auto ranges = measurements.measure({&single, 1}, {}).ranges;
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = static_cast<std::uint8_t>(std::lround(ranges[i] / VirtualMeasurements::kBin));
      }
    }
  }
  VirtualMeasurements::Ranges measure(std::span<const WeightedPose> belief) {
    constexpr int kDirections = VirtualMeasurements::kDirections;
    std::fill(histogram_.begin(), histogram_.end(), 0.0);
    double total = 0.0;
    for (const auto& pose : belief) {
      const auto row = rows_.find(key_of(pose.position));
      if (row == rows_.end()) continue;
      total += pose.mass;
      int direction = static_cast<int>(std::lround(pose.heading / (2.0 * 3.14159265358979 / kDirections)));
      double* bins = histogram_.data();
      for (int i = 0; i < kDirections; ++i, bins += VirtualMeasurements::kBins) {
        bins[row->second[static_cast<std::size_t>(direction)]] += pose.mass;
        if (++direction == kDirections) direction = 0;
      }
    }
    VirtualMeasurements::Ranges ranges{};
    for (std::size_t i = 0; i < kDirections; ++i) {
      const double* bins = histogram_.data() + i * VirtualMeasurements::kBins;
      double below = 0.0;
      int bin = 0;
      while (bin + 1 < VirtualMeasurements::kBins && (below += bins[bin]) < 0.01 * total) ++bin;
      ranges[i] = VirtualMeasurements::kBin * bin;
    }
    return ranges;
  }

 private:
  static std::uint64_t key_of(Point2 position) {
    const auto column = static_cast<std::uint64_t>(std::llround(position.x / 0.025));
    return (column << 32U) ^ (static_cast<std::uint64_t>(std::llround(position.y / 0.025)) & 0xffffffffU);
  }
  std::unordered_map<std::uint64_t, std::array<std::uint8_t, VirtualMeasurements::kDirections>> rows_;
  std::vector<double> histogram_ =
      std::vector<double>(std::size_t{VirtualMeasurements::kDirections} * VirtualMeasurements::kBins);
};

void virtual_measurements(benchmark::State& state) {
  auto measurements = museum();
  const auto belief = belief_of(static_cast<int>(state.range(0)), state.range(1) != 0);
  state.SetLabel(state.range(1) != 0 ? "all over the museum" : "one cloud");
  PlainHistogram plain{measurements, belief};
  if (measurements.measure(belief, {}).ranges != plain.measure(belief)) {
    state.SkipWithError("not the same measurements");
    return;
  }
  constexpr int kRounds = 50;
  const double start = computed();
  for (int i = 0; i < kRounds; ++i) benchmark::DoNotOptimize(plain.measure(belief));
  const double plain_time = (computed() - start) / kRounds;
  const double begin = computed();
  for (auto _ : state) benchmark::DoNotOptimize(measurements.measure(belief, {}));
  const double time = (computed() - begin) / static_cast<double>(state.iterations());
  state.counters["times_faster"] = plain_time / time;
  auto joint = museum(true);
  benchmark::DoNotOptimize(joint.measure(belief, {}));
  const double begin_jointly = computed();
  for (int i = 0; i < kRounds; ++i) benchmark::DoNotOptimize(joint.measure(belief, {}));
  state.counters["jointly_times_faster"] = plain_time * kRounds / (computed() - begin_jointly);
  state.counters["plain_histogram_us"] = 1e6 * plain_time;
  state.counters["evaluations_per_s"] = static_cast<double>(belief.size()) * VirtualMeasurements::kDirections / time;
}
BENCHMARK(virtual_measurements)
    ->Args({300, 0})
    ->Args({5000, 0})
    ->Args({5000, 1})
    ->Args({8192, 0})
    ->Args({8192, 1})
    ->Unit(benchmark::kMicrosecond);

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
}  // namespace docent::collision_avoidance
