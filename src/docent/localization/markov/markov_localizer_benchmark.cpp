#include "docent/localization/markov/markov_localizer.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>

#include "docent/localization/markov/testing.h"

/// A museum of 200 x 200 m: 320 million states. Takes minutes and gigabytes, so it is run only where DOCENT_LARGE_MAP
/// is set, as `scripts/evaluate large-map` does; DOCENT_SIMD names the instruction set.
namespace docent::localization {
namespace {

constexpr int kSide = 4000;  // cells of 5 cm
constexpr int kRooms = 16;   // a side
constexpr int kRoom = kSide / kRooms;
constexpr int kScanPeriodMs = 125;

void fill(OccupancyGrid& grid, int left, int bottom, int right, int top, std::int8_t value) {
  for (int row = std::max(bottom, 0); row < std::min(top, kSide); ++row)
    for (int column = std::max(left, 0); column < std::min(right, kSide); ++column)
      grid.cells[grid.frame.index({column, row})] = value;
}

/// Rooms of about 12.5 m with a door to each neighbour, walls that are not where one expects them, and cases.
OccupancyGrid museum(std::uint64_t seed) {
  Rng rng{seed};
  OccupancyGrid grid;
  grid.frame = {kSide, kSide, 0.05, {}};
  grid.cells.assign(grid.frame.size(), OccupancyGrid::kFree);
  const auto jitter = [&rng](int most) { return static_cast<int>(rng.integer(-most, most)); };
  for (int i = 0; i <= kRooms; ++i) {
    for (int j = 0; j < kRooms; ++j) {
      const int wall = i == 0 ? 0 : i == kRooms ? kSide - 3 : i * kRoom + jitter(25);
      const int door = j * kRoom + kRoom / 2 + jitter(60);
      fill(grid, wall, j * kRoom, wall + 3, (j + 1) * kRoom, OccupancyGrid::kOccupied);
      if (i > 0 && i < kRooms) fill(grid, wall, door, wall + 3, door + 40, OccupancyGrid::kFree);
      const int other = i == 0 ? 0 : i == kRooms ? kSide - 3 : i * kRoom + jitter(25);
      const int gap = j * kRoom + kRoom / 2 + jitter(60);
      fill(grid, j * kRoom, other, (j + 1) * kRoom, other + 3, OccupancyGrid::kOccupied);
      if (i > 0 && i < kRooms) fill(grid, gap, other, gap + 40, other + 3, OccupancyGrid::kFree);
    }
  }
  for (int i = 0; i < 4 * kRooms * kRooms; ++i) {
    const int left = static_cast<int>(rng.integer(10, kSide - 60));
    const int bottom = static_cast<int>(rng.integer(10, kSide - 60));
    fill(grid, left, bottom, left + static_cast<int>(rng.integer(8, 40)), bottom + static_cast<int>(rng.integer(8, 40)),
         OccupancyGrid::kOccupied);
  }
  return grid;
}

double seconds(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
double peak_gigabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e9;
}

/// A robot that drives round in circles where there is room for it.
class Drive {
 public:
  Drive(const sensor_models::RayCaster& caster, std::uint64_t seed) : caster_{caster}, rng_{seed} {
    do {
      centre_ = {rng_.uniform(20.0, 180.0), rng_.uniform(20.0, 180.0)};
    } while (caster.clearance(centre_) < 2.2F);
  }
  [[nodiscard]] Pose2 truth(double time) const {
    const double way = 0.5 * time / kRadius;
    return Pose2{centre_.x, centre_.y, Angle::radians(way)} * Pose2{kRadius, 0.0, Angle::degrees(90)};
  }
  /// Odometry drifts by 1 % of the way and 0.01 rad a metre; a fifth of the beams meets somebody.
  [[nodiscard]] Pose2 odometry(double time) const {
    const double way = 0.505 * time / kRadius;
    return Pose2{0.0, 0.0, Angle::radians(way + 0.005 * time)} * Pose2{kRadius, 0.0, Angle::degrees(90)};
  }
  [[nodiscard]] sensor_models::RangeSweep sweep(double time) {
    sensor_models::RangeSweep sweep = testing::sweep_at(caster_, truth(time), 10.0);
    for (sensor_models::SweepBeam& beam : sweep.beams) {
      if (rng_.chance(0.2)) {
        beam.range *= rng_.uniform(0.2, 1.0);
        beam.no_return = false;
      }
      beam.range = std::max(0.05, beam.range + rng_.uniform(-0.03, 0.03));
    }
    return sweep;
  }

 private:
  static constexpr double kRadius = 1.5;  // [m]
  const sensor_models::RayCaster& caster_;
  Rng rng_;
  Point2 centre_;
};

struct Phase {
  std::vector<double> processor, wall;  ///< [s] of each update
  std::vector<double> all;              ///< [s] of the processor for each scan, updated or skipped
  double longest_gap = 0.0;             ///< [s] of the robot's time between updates
  double error = 0.0;                   ///< [m], largest
};
double highest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}
double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// Scans from `first` on, until `done` says so after one.
Phase run(MarkovLocalizer& localizer, Drive& drive, int& scan, int most, const auto& done) {
  Phase phase;
  int last = scan;
  for (const int end = scan + most; scan < end; ++scan) {
    const double time = 1e-3 * kScanPeriodMs * scan;
    const sensor_models::RangeSweep sweep = drive.sweep(time);
    const double wall = seconds(CLOCK_MONOTONIC);
    const double processor = seconds(CLOCK_THREAD_CPUTIME_ID);
    const auto step =
        localizer.observe(sweep, drive.odometry(time), Time{} + std::chrono::milliseconds{kScanPeriodMs * scan});
    phase.all.push_back(seconds(CLOCK_THREAD_CPUTIME_ID) - processor);
    if (!step.updated) continue;
    phase.processor.push_back(phase.all.back());
    phase.wall.push_back(seconds(CLOCK_MONOTONIC) - wall);
    phase.longest_gap = std::max(phase.longest_gap, 1e-3 * kScanPeriodMs * (scan - last));
    last = scan;
    if (const auto pose = localizer.map_from_robot(drive.odometry(time)))
      phase.error = std::max(phase.error, distance(pose->position(), drive.truth(time).position()));
    if (done()) break;
  }
  ++scan;
  return phase;
}

bool print_bound(const char* what, double value, double bound) {
  std::printf("  %-66s %8.3f   <= %6.3f   %s\n", what, value, bound, value <= bound ? "pass" : "FAIL");
  return value <= bound;
}

void large_map(benchmark::State& state) {
  const char* const simd = std::getenv("DOCENT_SIMD");
  LocalizerParams params;
  params.simd = simd != nullptr ? simd : "auto";
  params.work_per_second = 1e10;
  if (auto valid = params.validate(); !valid) return state.SkipWithError(valid.error().message.c_str());
  for (auto _ : state) {
    const OccupancyGrid map = museum(5);
    const double before = seconds(CLOCK_MONOTONIC);
    const char* const folder = std::getenv("DOCENT_CACHE");
    MarkovLocalizer localizer{map, params, {folder != nullptr ? folder : ""}, 1};
    const double states = static_cast<double>(localizer.space().states());
    std::printf("200 x 200 m: %.0f million states, %s; ready after %.1f s, %.2f GB\n", states * 1e-6,
                std::string{name_of(localizer.belief().instruction_set())}.c_str(), seconds(CLOCK_MONOTONIC) - before,
                peak_gigabytes());
    std::fflush(stdout);
    Drive drive{localizer.caster(), 3};
    int scan = 1;
    const Phase unknown = run(localizer, drive, scan, 8 * 120, [&] { return localizer.verdict().localized(); });
    std::printf(
        "  unknown start: %zu updates, sure after %.1f s; %zu scans skipped; a mean update %.2f s of the processor\n",
        unknown.processor.size(), 1e-3 * kScanPeriodMs * scan, unknown.all.size() - unknown.processor.size(),
        mean(unknown.processor));
    const Phase tracking = run(localizer, drive, scan, 8 * 120, [] { return false; });
    std::printf("  tracking: %zu scans, %zu updates of %.2f ms in the mean, %.2f ms at most; %zu states active\n",
                tracking.all.size(), tracking.processor.size(), 1e3 * mean(tracking.processor),
                1e3 * highest(tracking.processor), localizer.belief().active_states());
    bool good = print_bound("not localized at the end (0: it is)", localizer.verdict().localized() ? 0.0 : 1.0, 0.0);
    good = print_bound("tracking: largest error [m]", tracking.error, 0.5) && good;
    good = print_bound("unknown start: longest update [s of the processor]", highest(unknown.processor), 5.0) && good;
    good =
        print_bound("unknown start: longest time between updates [s of the robot]", unknown.longest_gap, 5.0) && good;
    good = print_bound("tracking at 8 Hz: longest update [s of the processor]", highest(tracking.processor), 0.125) &&
           good;
    good = print_bound("peak memory [GB]", peak_gigabytes(), 4.0) && good;
    if (!good) state.SkipWithError("a bound does not hold");
  }
}

const bool kRegistered = [] {
  if (std::getenv("DOCENT_LARGE_MAP") != nullptr)
    benchmark::RegisterBenchmark("large_map", large_map)->Unit(benchmark::kSecond)->Iterations(1);
  return true;
}();

}  // namespace
}  // namespace docent::localization
