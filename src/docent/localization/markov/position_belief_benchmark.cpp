#include "docent/localization/markov/position_belief.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>

#include "docent/localization/markov/testing.h"

/// The full cycle of grid Markov localization, motion and a scan of 180 beams, over 7.1 million states (30 x 30 m, 15
/// cm, 2 degrees), by every instruction set that this processor has, and by the scalar code that the papers describe.
/// Ratios within one run mean something.
///
/// What is compared is meant to be fair. The scalar code is not made slow: it has a table of its own, in the order that
/// suits it (headings innermost, each direction twice, no modulo), adds floats of ln P so that two look-ups and one
/// addition are all it does for a state and a beam, knows no sectors, takes one exponential a state, and moves by the
/// same two passes and the same taps. It takes all headings
/// of a place abreast, the order that a processor likes best, and is what the others are measured against; the same
/// from state to state, as the papers describe it, waits for its own additions and stands beside it. It is compiled
/// with the flags of the other files of this folder (-O3), so the compiler makes SSE2 of its motion and its
/// normalisation; of a gather it cannot. The bare loop beside it is what its innermost loop is, without anything around
/// it.
namespace docent::localization {
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
  sensor_models::RayCaster caster{map};
  StateSpace space{map, caster, {}};
  RangeTable table = RangeTable::build(space, caster, sensor_models::ProximityModel{{}}, {2, {}});
  sensor_models::ProximityModel model{{}, table.frequency()};
  MotionKernel moved = motion_kernel(space, {}, {0.15, 0.0}, {{0.002, 0.001}, 0.15, 0.02});
  /// What a laser sees in the middle, one beam a heading.
  std::vector<int> bins = [this] {
    std::vector<int> result;
    const sensor_models::RangeSweep sweep = testing::sweep_at(caster, {14.2, 15.3, Angle{}}, 10.0);
    for (const sensor_models::BinnedBeam& beam : sensor_models::binned(sweep, space.headings()))
      result.push_back(sweep.beams[beam.beam].no_return ? sensor_models::kNoReturn
                                                        : model.bin(sweep.beams[beam.beam].range));
    return result;
  }();
  std::vector<BeamCosts> beams = [this] {
    const double temper = 12.0 / kBeams;
    std::vector<BeamCosts> result(bins.size());
    for (std::size_t b = 0; b < bins.size(); ++b) {
      const auto log_p = model.log_probabilities(bins[b]);
      const float best = *std::max_element(log_p.begin(), log_p.end());
      result[b].direction = b;
      for (std::size_t o = 0; o < sensor_models::kExpectedRanges; ++o)
        result[b].costs[o] = static_cast<std::uint8_t>(
            std::min<long>(kMaxCost, std::lround(temper * static_cast<double>(best - log_p[o]) * kCostPerNat)));
    }
    return result;
  }();
};

const Hall& hall() {
  static const Hall instance;
  return instance;
}

EvidenceWeights evidence() {  // as MarkovLocalizer gives it
  EvidenceWeights weights;
  weights.sectors = 12;
  weights.most_sector_nats = 5.0 * 12.0 / 60.0;
  weights.most_nats = weights.far_most_nats = 8.0;
  return weights;
}

/// The scalar code: [Markov1998] eq. 1 and 2 over all states, one after the other.
class ScalarCycle {
 public:
  ScalarCycle() {
    ranges_.resize(places_ * 2 * headings_);
    for (std::size_t place = 0; place < places_; ++place)
      for (std::size_t d = 0; d < 2 * headings_; ++d) ranges_[place * 2 * headings_ + d] = hall().table.row(place)[d];
    for (const int bin : hall().bins) {
      const auto log_p = hall().model.log_probabilities(bin);
      for (const float value : log_p) log_probabilities_.push_back(value * 12.0F / kBeams);
    }
    belief_.assign(places_ * headings_, 1.0F / static_cast<float>(places_ * headings_));
    sums_.resize(belief_.size());
  }

  /// ln P(s | l) of every state, one after the other; the largest.
  float score_state_by_state() {
    float best = -1e9F;
    const float* const log_p = log_probabilities_.data();
    float* const out = sums_.data();
    for (std::size_t place = 0; place < places_; ++place) {
      const std::uint8_t* const ranges = ranges_.data() + place * 2 * headings_;
      for (std::size_t h = 0; h < headings_; ++h) {
        float sum = 0.0F;
        for (std::size_t beam = 0; beam < kBeams; ++beam)
          sum += log_p[beam * sensor_models::kExpectedRanges + ranges[h + beam]];
        out[place * headings_ + h] = sum;
        best = std::max(best, sum);
      }
    }
    return best;
  }
  /// The same, all headings of a place abreast.
  float score_abreast() {
    float best = -1e9F;
    std::array<float, 180> sums;
    for (std::size_t place = 0; place < places_; ++place) {
      const std::uint8_t* const ranges = ranges_.data() + place * 2 * headings_;
      sums.fill(0.0F);
      for (std::size_t beam = 0; beam < kBeams; ++beam) {
        const float* const log_p = log_probabilities_.data() + beam * sensor_models::kExpectedRanges;
        for (std::size_t h = 0; h < sums.size(); ++h) sums[h] += log_p[ranges[h + beam]];
      }
      for (const float sum : sums) best = std::max(best, sum);
      std::copy(sums.begin(), sums.end(), sums_.begin() + static_cast<std::ptrdiff_t>(place * headings_));
    }
    return best;
  }
  void reweigh(float best) {
    double total = 0.0;
    for (std::size_t i = 0; i < belief_.size(); ++i) {
      belief_[i] *= std::exp(std::max(sums_[i] - best, -8.0F));
      total += static_cast<double>(belief_[i]);
    }
    normalise(total);
  }
  void move() {
    const MotionKernel& kernel = hall().moved;
    const StateSpace& space = hall().space;
    const int columns = space.frame().columns;
    const int rows = space.frame().rows;
    const auto at = [&](int column, int row) {
      return (static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)) *
             headings_;
    };
    along_x_.assign(space.frame().size() * headings_, 0.0F);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        for (int offset = -kernel.columns.reach; offset <= kernel.columns.reach; ++offset) {
          const std::int32_t from = space.place_at({column - offset, row});
          if (from != StateSpace::kNoPlace)
            add(along_x_.data() + at(column, row), kernel.columns, offset,
                belief_.data() + static_cast<std::size_t>(from) * headings_);
        }
    double total = 0.0;
    std::vector<float> shifted(headings_);
    for (std::size_t place = 0; place < places_; ++place) {
      const CellIndex cell = space.cell(place);
      std::fill(shifted.begin(), shifted.end(), 0.0F);
      for (int offset = -kernel.rows.reach; offset <= kernel.rows.reach; ++offset)
        if (cell.row - offset >= 0 && cell.row - offset < rows)
          add(shifted.data(), kernel.rows, offset, along_x_.data() + at(cell.column, cell.row - offset));
      total += turn(shifted, belief_.data() + place * headings_);
    }
    normalise(total);
  }
  [[nodiscard]] const std::vector<std::uint8_t>& ranges() const { return ranges_; }

 private:
  void add(float* __restrict out, const AxisTaps& taps, int offset, const float* __restrict in) const {
    for (std::size_t block = 0; block + 1 < taps.begin.size(); ++block) {
      for (std::size_t tap = taps.begin[block]; tap < taps.begin[block + 1]; ++tap) {
        if (taps.offsets[tap] != offset) continue;
        const float* const weights = taps.weights.data() + tap * kRowBlock;
        const std::size_t first = block * kRowBlock;
        const std::size_t count = std::min(kRowBlock, headings_ - first);
        for (std::size_t i = 0; i < count; ++i) out[first + i] += weights[i] * in[first + i];
      }
    }
  }
  double turn(const std::vector<float>& shifted, float* __restrict out) {
    const std::vector<float>& weights = heading_weights_;
    const std::size_t reach = weights.size() / 2;
    extended_.resize(headings_ + 2 * reach);
    for (std::size_t i = 0; i < extended_.size(); ++i) extended_[i] = shifted[(i + 2 * headings_ - reach) % headings_];
    std::fill_n(out, headings_, 0.0F);
    for (std::size_t k = 0; k < weights.size(); ++k)
      for (std::size_t h = 0; h < headings_; ++h) out[h] += weights[k] * extended_[h + k];
    double total = 0.0;
    for (std::size_t h = 0; h < headings_; ++h) total += static_cast<double>(out[h]);
    return total;
  }
  void normalise(double total) {
    const auto scale = static_cast<float>(1.0 / total);
    for (float& value : belief_) value *= scale;
  }

  std::size_t places_ = hall().space.places();
  std::size_t headings_ = static_cast<std::size_t>(hall().space.headings());
  std::vector<std::uint8_t> ranges_;      ///< [places][2 * headings]
  std::vector<float> log_probabilities_;  ///< [beams][kExpectedRanges]
  std::vector<float> belief_, sums_;      ///< [places][headings]
  std::vector<float> along_x_;            ///< [cells][headings]
  std::vector<float> extended_;
  std::vector<float> heading_weights_ = hall().moved.heading_weights();
};

/// One gather from a small table and one addition a state-beam, headings innermost; nothing else.
template <class Sum>
void bare_gather_and_add(const std::vector<std::uint8_t>& ranges, const std::vector<Sum>& tables) {
  std::array<Sum, 180> sums{};
  for (std::size_t place = 0; place < hall().space.places(); ++place) {
    const std::uint8_t* const row = ranges.data() + place * 2 * sums.size();
    for (std::size_t beam = 0; beam < kBeams; ++beam) {
      const Sum* const values = tables.data() + beam * sensor_models::kExpectedRanges;
      for (std::size_t h = 0; h < sums.size(); ++h) sums[h] += values[row[h + beam]];
    }
    benchmark::DoNotOptimize(sums.data());
  }
}

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

/// The scores alone, of all tiles.
void score_all(InstructionSet set) {
  const auto headings = static_cast<std::size_t>(hall().space.headings());
  TileScorer scorer{hall().beams, headings, 12, 32, set};
  const std::size_t stride = (headings + kRowBlock - 1) / kRowBlock * kRowBlock;
  AlignedVector<std::uint16_t> costs(RangeTable::kTile * stride);
  std::vector<std::uint8_t> lanes;
  std::vector<std::uint16_t*> rows;
  for (std::size_t i = 0; i < RangeTable::kTile; ++i) {
    lanes.push_back(static_cast<std::uint8_t>(i));
    rows.push_back(costs.data() + i * stride);
  }
  for (std::size_t tile = 0; tile * RangeTable::kTile < hall().space.places(); ++tile) {
    scorer.score(hall().table.tile(tile), ~std::uint64_t{0}, lanes, rows);
    benchmark::DoNotOptimize(costs.data());
  }
}

struct Times {
  std::vector<double> motion, scoring, reweighing, cycle;  ///< [ms]
};
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void print_row(const std::string& name, const Times& times, double scalar_cycle) {
  const double states = static_cast<double>(hall().space.states());
  std::printf("  %-22s %9.1f %9.1f %12.1f %9.1f %12.4f %9.1f\n", name.c_str(), median(times.motion),
              median(times.scoring), median(times.reweighing), median(times.cycle),
              median(times.cycle) * 1e6 / states / kBeams, scalar_cycle / median(times.cycle));
}

bool print_bound(const char* what, double value, double bound, bool at_least) {
  const bool good = at_least ? value >= bound : value <= bound;
  std::printf("  %-66s %6.2f   %s %5.1f   %s\n", what, value, at_least ? ">=" : "<=", bound, good ? "pass" : "FAIL");
  return good;
}

/// The cycle by plain loops and by the belief with each instruction set.
class CycleTimes {
 public:
  CycleTimes() {
    for (const BeamCosts& beam : hall().beams) {
      float_tables_.insert(float_tables_.end(), beam.costs.begin(), beam.costs.end());
      cost_tables_.insert(cost_tables_.end(), beam.costs.begin(), beam.costs.end());
    }
    for (const InstructionSet set : instruction_sets()) {
      beliefs_.emplace(set, PositionBelief{hall().space, 0.0});
      beliefs_.at(set).use(set);
    }
  }

  void measure_round() {
    for (Times* const times_of : {&by_state_, &abreast_}) {
      float best = 0.0F;
      times_of->motion.push_back(milliseconds([&] { scalar_.move(); }));
      times_of->scoring.push_back(milliseconds(
          [&] { best = times_of == &by_state_ ? scalar_.score_state_by_state() : scalar_.score_abreast(); }));
      times_of->reweighing.push_back(times_of->scoring.back() + milliseconds([&] { scalar_.reweigh(best); }));
      times_of->cycle.push_back(times_of->motion.back() + times_of->reweighing.back());
    }
    bare_floats_.push_back(milliseconds([&] { bare_gather_and_add(scalar_.ranges(), float_tables_); }));
    bare_costs_.push_back(milliseconds([&] { bare_gather_and_add(scalar_.ranges(), cost_tables_); }));
    for (const InstructionSet set : instruction_sets()) {
      Times& of_set = times_[set];
      PositionBelief& belief = beliefs_.at(set);
      of_set.scoring.push_back(milliseconds([&] { score_all(set); }));
      of_set.motion.push_back(milliseconds([&] { belief.move(hall().moved); }));
      of_set.reweighing.push_back(
          milliseconds([&] { belief.reweigh(hall().table, hall().beams, 1.0, evidence(), 1e-7); }));
      of_set.cycle.push_back(of_set.motion.back() + of_set.reweighing.back());
    }
  }

  void print() const {
    const double cycle = median(abreast_.cycle);
    const double state_beams = static_cast<double>(hall().space.states()) * kBeams;
    const auto per_state_beam = [state_beams](const std::vector<double>& ms) { return median(ms) * 1e6 / state_beams; };
    std::printf("full cycle: %.2f million states, %d beams; medians [ms of the processor]\n",
                state_beams / kBeams * 1e-6, kBeams);
    std::printf("  %-22s %9s %9s %12s %9s %12s %9s\n", "", "motion", "scoring", "with scoring", "cycle", "ns/st-beam",
                "faster");
    print_row("scalar, state by state", by_state_, cycle);
    print_row("scalar, abreast", abreast_, cycle);
    for (const auto& [set, of_set] : times_) print_row(std::string{name_of(set)}, of_set, cycle);
    std::printf(
        "  ns a state-beam: bare gather and add %.3f (floats), %.3f (whole numbers); scalar scoring %.3f, %.3f\n",
        per_state_beam(bare_floats_), per_state_beam(bare_costs_), per_state_beam(by_state_.scoring),
        per_state_beam(abreast_.scoring));
  }

  void print_bounds() const {
    const double bare = std::min(median(bare_floats_), median(bare_costs_));
    print_bound("scalar scoring, abreast / bare gather and add", median(abreast_.scoring) / bare, 2.0, false);
    std::printf("  %-66s %6.2f\n", "  the same, state by state", median(by_state_.scoring) / bare);
    for (const auto& [set, bound] : {std::pair{InstructionSet::avx2, 8.0}, std::pair{InstructionSet::avx512, 30.0}}) {
      const std::string name{name_of(set)};
      if (!times_.contains(set)) {
        std::printf("  %-66s not run: this processor has none\n", name.c_str());
        continue;
      }
      const double ours = median(times_.at(set).cycle);
      print_bound(("scalar cycle, abreast / " + name + " cycle").c_str(), median(abreast_.cycle) / ours, bound, true);
      std::printf("  %-66s %6.2f\n", ("  scalar cycle, state by state / " + name + " cycle").c_str(),
                  median(by_state_.cycle) / ours);
    }
  }

 private:
  ScalarCycle scalar_;
  Times by_state_;
  Times abreast_;
  std::vector<double> bare_floats_, bare_costs_;
  std::map<InstructionSet, Times> times_;
  std::vector<float> float_tables_;
  std::vector<std::uint32_t> cost_tables_;
  std::map<InstructionSet, PositionBelief> beliefs_;
};

/// Rounds in turn, so that what else the machine does meets all of them alike; medians.
void full_cycle(benchmark::State& state) {
  constexpr int kRounds = 7;
  CycleTimes times;
  for (auto _ : state)
    for (int round = 0; round < kRounds; ++round) times.measure_round();
  times.print();
  times.print_bounds();
  state.counters["states"] = static_cast<double>(hall().space.states());
}
void motion(benchmark::State& state) {
  PositionBelief belief{hall().space, 0.0};
  for (auto _ : state) belief.move(hall().moved);
}
BENCHMARK(motion)->Unit(benchmark::kMillisecond);
void reweighing(benchmark::State& state) {
  PositionBelief belief{hall().space, 0.0};
  for (auto _ : state) belief.reweigh(hall().table, hall().beams, 1.0, evidence(), 1e-7);
}
BENCHMARK(reweighing)->Unit(benchmark::kMillisecond);
BENCHMARK(full_cycle)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace docent::localization
