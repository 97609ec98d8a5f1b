#include "docent/task_control/tour_scheduler/composition.h"

#include <benchmark/benchmark.h>

#include "docent/base/random.h"

namespace docent::task_control {
namespace {

/// The first choice of a tour of six minutes among so many exhibits with so many sensible successors each.
void plan_six_minutes(benchmark::State& state) {
  Rng rng{7};
  Programme programme;
  const auto count = state.range(0);
  for (std::int64_t i = 0; i < count; ++i) {
    ProgrammeExhibit& exhibit = programme.exhibits.emplace_back();
    exhibit.id = std::to_string(i);
    exhibit.pose = {rng.uniform(0, 30), rng.uniform(0, 30), {}};
    exhibit.speech_s = 18.0;
    exhibit.long_s = 50.0;
    for (std::int64_t k = 1; k <= state.range(1); ++k) exhibit.next.push_back(std::to_string((i + 3 * k) % count));
  }
  const TravelTimes times{TravelTimeParams{}};
  TourSoFar tour;
  tour.robot = {15, 15};
  tour.left_s = 360.0;
  for (auto _ : state) benchmark::DoNotOptimize(plan_tour(programme, tour, straight_distance(), times, {}, {}));
}
BENCHMARK(plan_six_minutes)->Args({13, 3})->Args({23, 3})->Args({23, 5})->Args({13, 0});

}  // namespace
}  // namespace docent::task_control
