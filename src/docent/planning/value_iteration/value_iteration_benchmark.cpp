#include "docent/planning/value_iteration/value_iteration.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numeric>
#include <queue>
#include <string>

#include "docent/base/random.h"
#include "docent/grid/occupancy_grid.h"

/// Value iteration against Dijkstra's algorithm with a std::priority_queue, over random buildings of 5 cm a cell, on
/// one core: the full value function, and after an obstacle of 1 x 1 m has appeared on the way of a robot. Ratios
/// within one run mean something.
///
/// Dijkstra is meant to be fair: flat arrays with a closed border, so that nothing tests bounds, entries of eight
/// bytes, nothing allocated while it runs.
namespace docent {
namespace {

using Goal = ValueIteration::Goal;
constexpr float kClosed = ValueIteration::kClosed;
constexpr double kResolution = 0.05;

void fill(OccupancyGrid& map, int left, int bottom, int right, int top, std::int8_t as) {
  for (int row = std::max(0, bottom); row < std::min(top, map.frame.rows); ++row)
    for (int column = std::max(0, left); column < std::min(right, map.frame.columns); ++column)
      map.cells[map.frame.index({column, row})] = as;
}

OccupancyGrid floor_of(int side) {
  OccupancyGrid map;
  map.frame = {side, side, kResolution, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  return map;
}

/// One hall with cases of 0.3 to 3 m.
OccupancyGrid hall(int side, Rng& rng) {
  OccupancyGrid map = floor_of(side);
  for (int i = 0; i < side * side / 8000; ++i) {
    const int left = static_cast<int>(rng.integer(0, side));
    const int bottom = static_cast<int>(rng.integer(0, side));
    fill(map, left, bottom, left + static_cast<int>(rng.integer(6, 60)), bottom + static_cast<int>(rng.integer(6, 60)),
         OccupancyGrid::kOccupied);
  }
  return map;
}

/// Rooms of 5 to 12 m, most with a door of 1.2 m or two to their neighbours, and some furniture.
OccupancyGrid rooms(int side, Rng& rng) {
  OccupancyGrid map = floor_of(side);
  std::vector<int> walls{0};
  while (walls.back() < side) walls.push_back(walls.back() + static_cast<int>(rng.integer(100, 240)));
  const auto door = [&](int from, int to) {
    return static_cast<int>(rng.integer(from + 10, std::max(from + 11, to - 34)));
  };
  for (const int wall : walls) {
    fill(map, wall, 0, wall + 4, side, OccupancyGrid::kOccupied);
    fill(map, 0, wall, side, wall + 4, OccupancyGrid::kOccupied);
  }
  for (std::size_t i = 0; i + 1 < walls.size(); ++i) {
    for (const int wall : walls) {
      for (int doors = rng.chance(0.25) ? 2 : rng.chance(0.85) ? 1 : 0; doors > 0; --doors) {
        const int at = door(walls[i], walls[i + 1]);
        fill(map, wall, at, wall + 4, at + 24, OccupancyGrid::kFree);
        const int across = door(walls[i], walls[i + 1]);
        fill(map, across, wall, across + 24, wall + 4, OccupancyGrid::kFree);
      }
    }
  }
  for (int i = 0; i < side * side / 20000; ++i) {
    const int left = static_cast<int>(rng.integer(0, side));
    const int bottom = static_cast<int>(rng.integer(0, side));
    fill(map, left, bottom, left + static_cast<int>(rng.integer(6, 30)), bottom + static_cast<int>(rng.integer(6, 30)),
         OccupancyGrid::kOccupied);
  }
  return map;
}

/// Corridors of 2.6 m between walls of 0.2 m: a tree, with a tenth of the other walls taken out.
OccupancyGrid maze(int side, Rng& rng) {
  constexpr int kPitch = 56;
  OccupancyGrid map = floor_of(side);
  const int count = (side - 4) / kPitch;
  fill(map, 0, 0, side, side, OccupancyGrid::kOccupied);
  std::vector<int> group(static_cast<std::size_t>(count * count));
  std::iota(group.begin(), group.end(), 0);
  const std::function<int(int)> root = [&](int i) {
    while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
    return i;
  };
  std::vector<std::pair<int, bool>> doors;  // of a place, to the right or up
  for (int i = 0; i < count * count; ++i) {
    const int left = 4 + i % count * kPitch;
    const int bottom = 4 + i / count * kPitch;
    fill(map, left, bottom, left + kPitch - 4, bottom + kPitch - 4, OccupancyGrid::kFree);
    if (i % count + 1 < count) doors.emplace_back(i, true);
    if (i / count + 1 < count) doors.emplace_back(i, false);
  }
  for (std::size_t i = doors.size(); i > 1; --i)
    std::swap(doors[i - 1], doors[static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(i) - 1))]);
  for (const auto& [place, right] : doors) {
    const int here = root(place);
    const int there = root(place + (right ? 1 : count));
    if (here == there && !rng.chance(0.1)) continue;
    group[static_cast<std::size_t>(here)] = there;
    const int left = 4 + place % count * kPitch;
    const int bottom = 4 + place / count * kPitch;
    if (right) {
      fill(map, left + kPitch - 4, bottom, left + kPitch, bottom + kPitch - 4, OccupancyGrid::kFree);
    } else {
      fill(map, left, bottom + kPitch - 4, left + kPitch - 4, bottom + kPitch, OccupancyGrid::kFree);
    }
  }
  return map;
}

/// As RoutePlanner gives them: closed within the robot's radius and a margin, dearer near to walls.
std::vector<float> costs_of(const OccupancyGrid& map) {
  std::vector<bool> solid(map.frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = map.cells[i] != OccupancyGrid::kFree;
  const auto clearances = distance_transform(map.frame, solid);
  std::vector<float> costs(map.frame.size(), kClosed);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const double spare = static_cast<double>(clearances[i]) - 0.365;
    if (spare < 0.0) continue;
    const double discomfort = std::max(0.0, 1.0 - spare / 0.8);
    costs[i] = static_cast<float>(kResolution * (1.0 + 2.0 * discomfort * discomfort));
  }
  return costs;
}

/// Backwards from the goal, over a grid with a closed border.
class Dijkstra {
 public:
  Dijkstra(const GridFrame& frame, const std::vector<float>& costs)
      : frame_{frame}, stride_{static_cast<std::size_t>(frame.columns) + 2} {
    costs_.assign(stride_ * (static_cast<std::size_t>(frame.rows) + 2), kClosed);
    for (int row = 0; row < frame.rows; ++row)
      for (int column = 0; column < frame.columns; ++column)
        costs_[index({column, row})] = costs[frame.index({column, row})];
    values_.resize(costs_.size());
    std::vector<Entry> room;
    room.reserve(costs_.size());
    queue_ = Queue{std::greater<>{}, std::move(room)};
  }
  void solve(CellIndex goal) {
    std::fill(values_.begin(), values_.end(), kClosed);
    const auto s = static_cast<std::ptrdiff_t>(stride_);
    const std::array<std::ptrdiff_t, 8> steps{1, -1, s, -s, s + 1, s - 1, 1 - s, -s - 1};
    values_[index(goal)] = 0.0F;
    queue_.push({0.0F, static_cast<std::uint32_t>(index(goal))});
    while (!queue_.empty()) {
      const auto [value, at] = queue_.top();
      queue_.pop();
      if (value > values_[at]) continue;
      const float cost = costs_[at];
      if (cost == kClosed) continue;  // nobody goes through here
      const float straight = value + cost;
      const float aslant = value + cost * std::numbers::sqrt2_v<float>;
      relaxations_ += 8;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        const std::size_t beside = at + static_cast<std::size_t>(steps[i]);
        const float through = i < 4 ? straight : aslant;
        if (through < values_[beside]) {
          values_[beside] = through;
          queue_.push({through, static_cast<std::uint32_t>(beside)});
        }
      }
    }
  }
  [[nodiscard]] float value(CellIndex cell) const { return values_[index(cell)]; }
  [[nodiscard]] std::uint64_t relaxations() const { return relaxations_; }

 private:
  using Entry = std::pair<float, std::uint32_t>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;
  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row + 1) * stride_ + static_cast<std::size_t>(cell.column + 1);
  }
  GridFrame frame_;
  std::size_t stride_;
  std::vector<float> costs_, values_;
  Queue queue_;
  std::uint64_t relaxations_ = 0;
};

/// What ROS has planned with since 2009, potentials spread in waves: each cell's is interpolated from its lower
/// neighbours in both directions, and cells wait in three blocks, for this wave, the next one, and beyond the present
/// threshold. Costs are whole numbers. Its potentials are not the shortest ways over eight neighbours that the others
/// find, and nearly Euclidean; so only its time is compared.
class WavePropagation {
 public:
  WavePropagation(const GridFrame& frame, const std::vector<float>& costs)
      : stride_{static_cast<std::size_t>(frame.columns) + 2} {
    const std::size_t size = stride_ * (static_cast<std::size_t>(frame.rows) + 2);
    costs_.assign(size, kObstacle);
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        const float cost = costs[frame.index({column, row})];
        if (cost < kClosed) costs_[index({column, row})] = kNeutral * cost / static_cast<float>(kResolution);
      }
    }
    potentials_.resize(size);
    is_waiting_.resize(size);
    for (auto* const block : {&now_, &next_, &beyond_}) block->reserve(size);
  }
  void solve(CellIndex goal) {
    std::fill(potentials_.begin(), potentials_.end(), kFar);
    std::fill(is_waiting_.begin(), is_waiting_.end(), std::uint8_t{0});
    for (auto* const block : {&now_, &next_, &beyond_}) block->clear();
    threshold_ = kObstacle;
    const std::size_t at = index(goal);
    potentials_[at] = 0.0F;
    for (const std::size_t beside : {at + 1, at - 1, at + stride_, at - stride_}) wait(beside, now_);
    while (!now_.empty()) {
      for (const std::uint32_t cell : now_) is_waiting_[cell] = 0;
      for (const std::uint32_t cell : now_) update(cell);
      now_.swap(next_);
      next_.clear();
      if (!now_.empty()) continue;
      threshold_ += 2.0F * kNeutral;
      now_.swap(beyond_);
      beyond_.clear();
    }
  }
  [[nodiscard]] bool is_reached(CellIndex cell) const { return potentials_[index(cell)] < kFar; }

 private:
  static constexpr float kNeutral = 50.0F;
  static constexpr float kObstacle = 254.0F;
  static constexpr float kFar = 1e10F;

  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row + 1) * stride_ + static_cast<std::size_t>(cell.column + 1);
  }
  void wait(std::size_t cell, std::vector<std::uint32_t>& block) {
    if (is_waiting_[cell] != 0 || costs_[cell] >= kObstacle) return;
    is_waiting_[cell] = 1;
    block.push_back(static_cast<std::uint32_t>(cell));
  }
  void update(std::size_t cell) {
    const float left = potentials_[cell - 1];
    const float right = potentials_[cell + 1];
    const float below = potentials_[cell - stride_];
    const float above = potentials_[cell + stride_];
    const float across = std::min(left, right);
    const float along = std::min(below, above);
    const float cost = costs_[cell];
    const float apart = std::abs(across - along);
    float potential = std::min(across, along) + cost;
    if (apart < cost) {  // a plane wave through both neighbours, by a parabola
      const float share = apart / cost;
      potential = std::min(across, along) + cost * (-0.2301F * share * share + 0.5307F * share + 0.7040F);
    }
    if (potential >= potentials_[cell]) return;
    potentials_[cell] = potential;
    auto& block = potential < threshold_ ? next_ : beyond_;
    const float step = std::numbers::sqrt2_v<float> / 2.0F;
    if (left > potential + step * costs_[cell - 1]) wait(cell - 1, block);
    if (right > potential + step * costs_[cell + 1]) wait(cell + 1, block);
    if (below > potential + step * costs_[cell - stride_]) wait(cell - stride_, block);
    if (above > potential + step * costs_[cell + stride_]) wait(cell + stride_, block);
  }

  std::size_t stride_;
  std::vector<float> costs_, potentials_;
  std::vector<std::uint8_t> is_waiting_;
  std::vector<std::uint32_t> now_, next_, beyond_;
  float threshold_ = 0.0F;
};

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

void full_solve_and_replanning(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const int maps = static_cast<int>(state.range(1));
  const int obstacles = static_cast<int>(state.range(2));
  std::array<FullSolves, kBuildings.size()> full;
  std::array<Replanning, kBuildings.size()> replanning;
  Replanning all;
  std::vector<std::vector<double>> ratios_of_sets(instruction_sets().size());
  for (auto _ : state) {
    for (std::size_t kind = 0; kind < kBuildings.size(); ++kind) {
      for (int i = 0; i < maps; ++i) {
        Rng rng = Rng{static_cast<std::uint64_t>(i)}.stream(kBuildings[kind].name);
        const OccupancyGrid map = kBuildings[kind].build(side, rng);
        const std::vector<float> costs = costs_of(map);
        const CellIndex goal = any_open(
            map.frame, [&](CellIndex c) { return costs[map.frame.index(c)] < kClosed; }, rng);
        ValueIteration planner{map.frame};
        planner.set_costs(costs);
        if (!solve_fully(costs, goal, planner, full[kind])) {
          state.SkipWithError("values differ from Dijkstra's");
          return;
        }
        for (std::size_t set = 0; set < ratios_of_sets.size(); ++set)
          ratios_of_sets[set].push_back(full[kind].slow.back() /
                                        full_solve_with(instruction_sets()[set], map.frame, costs, goal));
        replan(planner, costs, goal, obstacles, full[kind].fast.back(), full[kind].fast_work.back(), rng,
               replanning[kind]);
      }
      all.add(replanning[kind]);
    }
  }
  const auto cells = static_cast<double>(side) * side;
  std::printf("%d x %d cells of 5 cm, one core, %s, times of the processor; medians over %d random maps of each kind\n",
              side, side, std::string{name_of(instruction_sets().back())}.c_str(), maps);
  std::printf(
      " Full value function, all values equal bit for bit: Dijkstra's algorithm with std::priority_queue, ours\n");
  std::printf("  %-8s %10s %10s %8s  %12s %12s  %12s %12s\n", "map", "Dijkstra", "ours", "faster", "Dijkstra", "ours",
              "Dijkstra", "ours");
  std::printf("  %-8s %10s %10s %8s  %12s %12s  %12s %12s\n", "", "ms", "ms", "", "values/s", "values/s", "offers",
              "offers");
  for (std::size_t kind = 0; kind < kBuildings.size(); ++kind) print_full(kBuildings[kind].name, full[kind], cells);
  std::printf("  faster than Dijkstra, median over all maps:");
  for (std::size_t set = 0; set < ratios_of_sets.size(); ++set)
    std::printf(" %s %.1f", std::string{name_of(instruction_sets()[set])}.c_str(), quantile(ratios_of_sets[set], 0.5));
  std::printf("\n");
  std::printf(
      " Replanning until the robot's value is exact, as shares of our own full solve of the same map. Cases: on\n");
  std::printf(" each map %d random places of the robot with a way of 60 cells and more, and for each an obstacle of\n",
              obstacles);
  std::printf(" 1 x 1 m at a random place of its way, at least 15 cells from both ends\n");
  std::printf("  %-8s %6s %9s %9s  %29s  %29s\n", "map", "cases", "ms", "plans/s", "time: median, p99, most",
              "offers: median, p99, most");
  for (std::size_t kind = 0; kind < kBuildings.size(); ++kind)
    print_replanning(kBuildings[kind].name, replanning[kind]);
  print_replanning("all", all);
  double least = full[0].ratio();
  for (const FullSolves& of : full) least = std::min(least, of.ratio());
  print_bound("full value function: Dijkstra / ours, worst kind", least, 10.0, true);
  double least_to_wave = full[0].ratio_to_wave();
  for (const FullSolves& of : full) least_to_wave = std::min(least_to_wave, of.ratio_to_wave());
  std::printf("  faster than wave propagation as in NavFn:");
  for (std::size_t kind = 0; kind < kBuildings.size(); ++kind)
    std::printf(" %s %.1f (%.1f ms)", kBuildings[kind].name, full[kind].ratio_to_wave(),
                quantile(full[kind].wave, 0.5));
  std::printf("\n");
  print_bound("full value function: NavFn's wave propagation / ours", least_to_wave, 4.0, true);
  print_bound("replanning / full solve, median time", quantile(all.time, 0.5), 0.125, false);
  print_bound("replanning / full solve, most relaxations", quantile(all.work, 1.0), 1.0, false);
}
BENCHMARK(full_solve_and_replanning)->Args({1000, 4, 40})->Args({4000, 2, 40})->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace docent
