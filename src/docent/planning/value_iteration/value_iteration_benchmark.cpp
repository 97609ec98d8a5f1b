#include "docent/planning/value_iteration/value_iteration.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>

#include "docent/base/random.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/value_iteration/benchmark_buildings.h"
#include "docent/planning/value_iteration/benchmark_rivals.h"

/// Value iteration against Dijkstra's algorithm with a std::priority_queue, over random buildings of 5 cm a cell, on
/// one core: the full value function, and after an obstacle of 1 x 1 m has appeared on the way of a robot. Ratios
/// within one run mean something.
namespace docent::planning {
namespace {

using namespace benchmarks;
using Goal = ValueIteration::Goal;
constexpr float kClosed = ValueIteration::kClosed;

/// Of the processor, not of the wall: others may be at work on this machine.
double milliseconds(const auto& work) {
  const auto now = [] {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

double quantile(std::vector<double> values, double at) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(at * static_cast<double>(values.size() - 1))];
}

bool print_bound(const char* what, double value, double bound, bool at_least) {
  const bool good = at_least ? value >= bound : value <= bound;
  std::printf("  %-58s %8.3f   %s %6.3f   %s\n", what, value, at_least ? ">=" : "<=", bound, good ? "pass" : "FAIL");
  return good;
}

struct Building {
  const char* name;
  OccupancyGrid (*build)(int, Rng&);
};
constexpr std::array<Building, 3> kBuildings{{{"hall", &hall}, {"rooms", &rooms}, {"maze", &maze}}};

CellIndex any_open(const GridFrame& frame, const auto& is_open, Rng& rng) {
  while (true) {
    const CellIndex cell{static_cast<int>(rng.integer(0, frame.columns - 1)),
                         static_cast<int>(rng.integer(0, frame.rows - 1))};
    if (is_open(cell)) return cell;
  }
}

constexpr int kEnough = 1 << 30;

/// Cells of an obstacle of 1 x 1 m in the middle of the way, and what they cost where the robot cannot go then.
std::vector<ValueIteration::Change> obstacle_at(const GridFrame& frame, CellIndex centre) {
  constexpr int kHalf = 10;
  std::vector<ValueIteration::Change> changes;
  for (int row = centre.row - kHalf; row < centre.row + kHalf; ++row)
    for (int column = centre.column - kHalf; column < centre.column + kHalf; ++column)
      if (frame.holds({column, row})) changes.push_back({{column, row}, kClosed});
  return changes;
}

struct Replanning {
  std::vector<double> milliseconds;
  std::vector<double> time, work;  ///< as shares of the full solve's
  void add(const Replanning& other) {
    milliseconds.insert(milliseconds.end(), other.milliseconds.begin(), other.milliseconds.end());
    time.insert(time.end(), other.time.begin(), other.time.end());
    work.insert(work.end(), other.work.begin(), other.work.end());
  }
};

void print_replanning(const char* name, const Replanning& of) {
  std::printf("  %-8s %6zu %9.2f %9.0f  %9.4f %9.4f %9.4f  %9.4f %9.4f %9.4f\n", name, of.time.size(),
              quantile(of.milliseconds, 0.5), 1e3 / quantile(of.milliseconds, 0.5), quantile(of.time, 0.5),
              quantile(of.time, 0.99), quantile(of.time, 1.0), quantile(of.work, 0.5), quantile(of.work, 0.99),
              quantile(of.work, 1.0));
}

/// Times [ms] and offers of full value functions, a pair a map: of Dijkstra and of ours.
struct FullSolves {
  std::vector<double> slow, fast, wave;  ///< of Dijkstra's, ours, wave propagation
  std::vector<double> slow_work, fast_work;
  [[nodiscard]] double ratio() const { return quantile(slow, 0.5) / quantile(fast, 0.5); }
  [[nodiscard]] double ratio_to_wave() const { return quantile(wave, 0.5) / quantile(fast, 0.5); }
};

void print_full(const char* name, const FullSolves& of, double cells) {
  const double slow = quantile(of.slow, 0.5);
  const double fast = quantile(of.fast, 0.5);
  std::printf("  %-8s %10.1f %10.2f %8.1f  %12.3g %12.3g  %12.3g %12.3g\n", name, slow, fast, of.ratio(),
              cells / (1e-3 * slow), cells / (1e-3 * fast), quantile(of.slow_work, 0.5), quantile(of.fast_work, 0.5));
}

/// Offers of a start from nothing in the changed map.
double work_from_nothing(const GridFrame& frame, std::vector<float> costs,
                         const std::vector<ValueIteration::Change>& changes, CellIndex goal) {
  for (const auto& change : changes) costs[frame.index(change.cell)] = change.cost;
  ValueIteration planner{frame};
  planner.set_costs(costs);
  planner.set_goals(std::vector<Goal>{{goal, 0.0F}});
  planner.iterate(kEnough);
  return static_cast<double>(planner.relaxations());
}

/// Obstacles one at a time on the robot's way, each taken away again. Time and work until the robot's value is exact,
/// as shares of those of the full solve; where the work comes near to it, of that in the changed map.
void replan(ValueIteration& planner, const std::vector<float>& costs, CellIndex goal, int obstacles, double full_time,
            double full_work, Rng& rng, Replanning& result) {
  const GridFrame& frame = planner.frame();
  for (int i = 0; i < obstacles; ++i) {
    const CellIndex robot = any_open(
        frame, [&](CellIndex c) { return planner.cost(c) < kClosed && planner.value(c) < kClosed; }, rng);
    const auto way = planner.descend(robot);
    if (way.size() < 60) continue;
    const CellIndex centre = way[static_cast<std::size_t>(rng.integer(15, static_cast<std::int64_t>(way.size()) - 15))];
    const auto changes = obstacle_at(frame, centre);
    const std::uint64_t before = planner.relaxations();
    const double time = milliseconds([&] {
      planner.change_costs(changes);
      planner.settle(robot, kEnough);
    });
    result.milliseconds.push_back(time);
    result.time.push_back(time / full_time);
    const auto work = static_cast<double>(planner.relaxations() - before);
    const bool is_near = work > 0.7 * full_work;
    result.work.push_back(work / (is_near ? work_from_nothing(frame, costs, changes, goal) : full_work));
    std::vector<ValueIteration::Change> back = changes;
    for (auto& change : back) change.cost = costs[frame.index(change.cell)];
    planner.change_costs(back);
    planner.iterate(kEnough);
  }
}

/// Both solve the map, several times; the medians count. @returns whether all values are equal
bool solve_fully(const std::vector<float>& costs, CellIndex goal, ValueIteration& planner, FullSolves& result) {
  const GridFrame& frame = planner.frame();
  const bool is_large = frame.size() > 4'000'000;  // Dijkstra takes seconds there, and one more makes no difference
  Dijkstra dijkstra{frame, costs};
  std::vector<double> slow, fast;
  for (int round = 0; round < (is_large ? 1 : 3); ++round) slow.push_back(milliseconds([&] { dijkstra.solve(goal); }));
  result.slow.push_back(quantile(slow, 0.5));
  result.slow_work.push_back(static_cast<double>(dijkstra.relaxations()) / static_cast<double>(slow.size()));
  for (int round = 0; round < 3; ++round) {
    const std::uint64_t before = planner.relaxations();
    fast.push_back(milliseconds([&] {
      planner.set_goals(std::vector<Goal>{{goal, 0.0F}});
      planner.iterate(kEnough);
    }));
    if (round == 0) result.fast_work.push_back(static_cast<double>(planner.relaxations() - before));
  }
  result.fast.push_back(quantile(fast, 0.5));
  WavePropagation propagation{frame, costs};
  std::vector<double> wave;
  for (int round = 0; round < (is_large ? 1 : 3); ++round)
    wave.push_back(milliseconds([&] { propagation.solve(goal); }));
  result.wave.push_back(quantile(wave, 0.5));
  for (int row = 0; row < frame.rows; ++row)  // it goes to the four neighbours only: what it reaches, all reach
    for (int column = 0; column < frame.columns; ++column)
      if (propagation.is_reached({column, row}) && planner.value({column, row}) == kClosed) return false;
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column)
      if (planner.value({column, row}) != dijkstra.value({column, row})) return false;
  return true;
}

/// Median time [ms] of our full solve with one instruction set.
double full_solve_with(InstructionSet set, const GridFrame& frame, const std::vector<float>& costs, CellIndex goal) {
  ValueIteration planner{frame, set};
  planner.set_costs(costs);
  std::vector<double> rounds;
  for (int round = 0; round < 3; ++round) {
    rounds.push_back(milliseconds([&] {
      planner.set_goals(std::vector<Goal>{{goal, 0.0F}});
      planner.iterate(kEnough);
    }));
  }
  return quantile(rounds, 0.5);
}

/// What was measured in buildings of one size.
struct Measurements {
  std::array<FullSolves, kBuildings.size()> full;
  std::array<Replanning, kBuildings.size()> replanning;
  Replanning all;
  std::vector<std::vector<double>> ratios_of_sets =
      std::vector<std::vector<double>>(instruction_sets().size());  ///< [sets][maps] Dijkstra / ours
};

/// One map. @returns whether all values are equal to Dijkstra's
bool measure(std::size_t kind, int side, int number, int obstacles, Measurements& result) {
  Rng rng = Rng{static_cast<std::uint64_t>(number)}.stream(kBuildings[kind].name);
  const OccupancyGrid map = kBuildings[kind].build(side, rng);
  const std::vector<float> costs = costs_of(map);
  const CellIndex goal = any_open(
      map.frame, [&](CellIndex c) { return costs[map.frame.index(c)] < kClosed; }, rng);
  ValueIteration planner{map.frame};
  planner.set_costs(costs);
  FullSolves& full = result.full[kind];
  if (!solve_fully(costs, goal, planner, full)) return false;
  for (std::size_t set = 0; set < result.ratios_of_sets.size(); ++set)
    result.ratios_of_sets[set].push_back(full.slow.back() /
                                         full_solve_with(instruction_sets()[set], map.frame, costs, goal));
  replan(planner, costs, goal, obstacles, full.fast.back(), full.fast_work.back(), rng, result.replanning[kind]);
  return true;
}

void print_full_solves(const Measurements& of, double cells) {
  std::printf(
      " Full value function, all values equal bit for bit: Dijkstra's algorithm with std::priority_queue, ours\n");
  std::printf("  %-8s %10s %10s %8s  %12s %12s  %12s %12s\n", "map", "Dijkstra", "ours", "faster", "Dijkstra", "ours",
              "Dijkstra", "ours");
  std::printf("  %-8s %10s %10s %8s  %12s %12s  %12s %12s\n", "", "ms", "ms", "", "values/s", "values/s", "offers",
              "offers");
  for (std::size_t kind = 0; kind < kBuildings.size(); ++kind) print_full(kBuildings[kind].name, of.full[kind], cells);
  std::printf("  faster than Dijkstra, median over all maps:");
  for (std::size_t set = 0; set < of.ratios_of_sets.size(); ++set)
    std::printf(" %s %.1f", std::string{name_of(instruction_sets()[set])}.c_str(),
                quantile(of.ratios_of_sets[set], 0.5));
  std::printf("\n");
}

void print_replannings(const Measurements& of, int obstacles) {
  std::printf(
      " Replanning until the robot's value is exact, as shares of our own full solve of the same map. Cases: on\n");
  std::printf(" each map %d random places of the robot with a way of 60 cells and more, and for each an obstacle of\n",
              obstacles);
  std::printf(" 1 x 1 m at a random place of its way, at least 15 cells from both ends\n");
  std::printf("  %-8s %6s %9s %9s  %29s  %29s\n", "map", "cases", "ms", "plans/s", "time: median, p99, most",
              "offers: median, p99, most");
  for (std::size_t kind = 0; kind < kBuildings.size(); ++kind)
    print_replanning(kBuildings[kind].name, of.replanning[kind]);
  print_replanning("all", of.all);
}

void print_bounds(const Measurements& of) {
  double least = of.full[0].ratio();
  for (const FullSolves& kind : of.full) least = std::min(least, kind.ratio());
  print_bound("full value function: Dijkstra / ours, worst kind", least, 10.0, true);
  double least_to_wave = of.full[0].ratio_to_wave();
  for (const FullSolves& kind : of.full) least_to_wave = std::min(least_to_wave, kind.ratio_to_wave());
  std::printf("  faster than wave propagation as in NavFn:");
  for (std::size_t kind = 0; kind < kBuildings.size(); ++kind)
    std::printf(" %s %.1f (%.1f ms)", kBuildings[kind].name, of.full[kind].ratio_to_wave(),
                quantile(of.full[kind].wave, 0.5));
  std::printf("\n");
  print_bound("full value function: NavFn's wave propagation / ours", least_to_wave, 4.0, true);
  print_bound("replanning / full solve, median time", quantile(of.all.time, 0.5), 0.125, false);
  print_bound("replanning / full solve, most relaxations", quantile(of.all.work, 1.0), 1.0, false);
}

void full_solve_and_replanning(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const int maps = static_cast<int>(state.range(1));
  const int obstacles = static_cast<int>(state.range(2));
  Measurements measured;
  for (auto _ : state) {
    for (std::size_t kind = 0; kind < kBuildings.size(); ++kind) {
      for (int i = 0; i < maps; ++i) {
        if (!measure(kind, side, i, obstacles, measured)) {
          state.SkipWithError("values differ from Dijkstra's");
          return;
        }
      }
      measured.all.add(measured.replanning[kind]);
    }
  }
  std::printf("%d x %d cells of 5 cm, one core, %s, times of the processor; medians over %d random maps of each kind\n",
              side, side, std::string{name_of(instruction_sets().back())}.c_str(), maps);
  print_full_solves(measured, static_cast<double>(side) * side);
  print_replannings(measured, obstacles);
  print_bounds(measured);
}
BENCHMARK(full_solve_and_replanning)->Args({1000, 4, 40})->Args({4000, 2, 40})->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace docent::planning
