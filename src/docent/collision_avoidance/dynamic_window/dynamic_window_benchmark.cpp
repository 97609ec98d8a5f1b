#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <string>

#include "docent/base/random.h"
#include "docent/collision_avoidance/dynamic_window/slow_window_for_test.h"

namespace docent::collision_avoidance {
namespace {

constexpr int kVelocities = 64;  // each way
constexpr int kPoints = 1000;

/// Walls, pillars and people as two lasers meet them: 1,000 points on outlines all round, none within reach.
std::vector<Obstacle> hall(std::uint64_t seed) {
  Rng rng{seed};
  std::vector<Obstacle> obstacles;
  while (obstacles.size() < kPoints) {
    const Point2 centre{rng.uniform(-3.4, 3.4), rng.uniform(-3.4, 3.4)};
    const double radius = rng.uniform(0.1, 0.5);
    if (norm(centre) < radius + 0.5 || norm(centre) > 3.3) continue;
    for (int i = 0; i < 25 && obstacles.size() < kPoints; ++i) {
      const Point2 at = centre + radius * unit(Angle::radians(rng.uniform(-3.14, 3.14)));
      obstacles.push_back({at, {}, 0.08, false, false});
    }
  }
  return obstacles;
}

DynamicWindowParams params() {
  DynamicWindowParams params;
  params.linear_steps = params.angular_steps = kVelocities;
  return params;
}

struct Case {
  Velocity velocity;
  Steering steering;
  std::vector<Obstacle> obstacles;
};
std::vector<Case> cases() {
  std::vector<Case> cases;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Rng rng{seed + 100};
    cases.push_back({{rng.uniform(0.2, 0.6), rng.uniform(-0.4, 0.4)},
                     {rng.uniform(-1.0, 1.0), rng.uniform(0.5, 3.0), 0.8, false},
                     hall(seed)});
  }
  return cases;
}

/// [s] that this thread has computed: other work on the machine does not count.
double computed() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The same choices both ways; the ratio is of the same run, and the slow way is the whole of the baseline's time.
void velocity_selection(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  const auto available = instruction_sets();
  if (std::find(available.begin(), available.end(), set) == available.end()) {
    state.SkipWithError("this processor has no such instructions");
    return;
  }
  state.SetLabel(std::string{name_of(set)});
  const BaseLimits limits;
  const auto all = cases();
  const SlowWindow slow{limits, params()};
  DynamicWindow fast{limits, params(), set};
  std::vector<Velocity> wanted;
  const double start = computed();
  for (const auto& one : all) {
    wanted.push_back(slow.choose(one.velocity, one.velocity, one.obstacles, one.steering).command);
  }
  const double slow_time = (computed() - start) / static_cast<double>(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto choice = fast.choose(all[i].velocity, all[i].velocity, all[i].obstacles, all[i].steering);
    if (!(choice.command == wanted[i])) {
      state.SkipWithError("not the same decision");
      return;
    }
  }
  std::size_t at = 0;
  const double begin = computed();
  for (auto _ : state) {
    const Case& one = all[at++ % all.size()];
    benchmark::DoNotOptimize(fast.choose(one.velocity, one.velocity, one.obstacles, one.steering));
  }
  const double fast_time = (computed() - begin) / static_cast<double>(state.iterations());
  constexpr double kEvaluations = double{kVelocities} * kVelocities * kPoints;
  state.counters["times_faster"] = slow_time / fast_time;
  state.counters["closed_form_ms"] = 1e3 * slow_time;
  state.counters["evaluations_per_s"] = kEvaluations / fast_time;
  state.counters["closed_form_evaluations_per_s"] = kEvaluations / slow_time;
}
BENCHMARK(velocity_selection)
    ->Arg(static_cast<int>(InstructionSet::plain))
    ->Arg(static_cast<int>(InstructionSet::avx2))
    ->Arg(static_cast<int>(InstructionSet::avx512))
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace docent::collision_avoidance
