#include "docent/sensor_models/proximity_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "docent/base/check.h"

namespace docent::sensor_models {

namespace {

constexpr std::size_t kParts = 5;
enum Part : std::size_t { hit, near, in_front, no_return, random_rest };
using Weights = std::array<double, kParts>;

constexpr int kWeightSteps = 12;  // EM steps of the weights a round: cheap beside the rest
constexpr int kSearchSteps = 10;  // of a golden section: the bracket shrinks to a hundredth

Weights weights_of(const ProximityModelParams& params) {
  Weights weights{params.weight_hit, params.weight_near, params.weight_short, params.weight_no_return,
                  params.weight_random};
  for (double& weight : weights) weight /= params.total_weight();
  return weights;
}

void set_weights(ProximityModelParams& params, const Weights& weights) {
  params.weight_hit = weights[hit];
  params.weight_near = weights[near];
  params.weight_short = weights[in_front];
  params.weight_no_return = weights[no_return];
  params.weight_random = weights[random_rest];
}

/// The weights nearest to `weights` in the sense of their likelihood that keep the floors: those below stand on theirs,
/// the others share the rest in proportion.
Weights floored(const Weights& weights, const Weights& floors) {
  std::array<bool, kParts> stands{};
  Weights result = weights;
  for (std::size_t round = 0; round < kParts; ++round) {
    double free = 1.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < kParts; ++i) (stands[i] ? free -= floors[i] : sum += weights[i]);
    bool changed = false;
    for (std::size_t i = 0; i < kParts; ++i) {
      result[i] = stands[i] ? floors[i] : (sum > 0.0 ? free * weights[i] / sum : free);
      if (!stands[i] && result[i] < floors[i]) stands[i] = changed = true;
    }
    if (!changed) break;
  }
  return result;
}

/// The readings and what each part says of them.
class Climb {
 public:
  Climb(const ReadingCounts& counts, const ProximityModelParams& start, const ProximityFitParams& options)
      : bins_{counts.bins()}, total_{static_cast<double>(counts.total())}, options_{options}, params_{start} {
    for (int expected = 0; expected < kRangeBins; ++expected) {
      if (counts.expected(expected) == 0) continue;
      const std::size_t first = cells_.size();
      for (int measured = 0; measured < kRangeBins; ++measured)
        if (const std::uint64_t n = counts.at(measured, expected); n > 0)
          cells_.push_back({static_cast<std::size_t>(measured), static_cast<double>(n), {}});
      columns_.push_back({expected, first, cells_.size()});
      for (std::size_t i = first; i < cells_.size(); ++i) {
        const int measured = static_cast<int>(cells_[i].measured);
        cells_[i].parts[no_return] = measured == kNoReturn ? 1.0 : 0.0;
        cells_[i].parts[random_rest] = random_probability(bins_, measured);
      }
    }
    weights_ = weights_of(params_);
    fill_peaks();
    fill_in_front();
  }

  [[nodiscard]] double log_likelihood() const {
    double sum = 0.0;
    for (const Cell& cell : cells_) sum += cell.count * std::log(probability(cell));
    return sum / total_;
  }

  /// One round of the fit; the mean log-likelihood after it.
  double round() {
    for (int i = 0; i < kWeightSteps; ++i) step_weights();
    search(&ProximityModelParams::sigma, options_.least_sigma, options_.most_sigma, &Climb::fill_peaks);
    search(&ProximityModelParams::sigma_per_metre, 0.0, options_.most_sigma_per_metre, &Climb::fill_peaks);
    search(&ProximityModelParams::near_factor, 1.0, options_.most_near_factor, &Climb::fill_peaks);
    search(&ProximityModelParams::short_per_metre, options_.least_short_per_metre, options_.most_short_per_metre,
           &Climb::fill_in_front);
    return log_likelihood();
  }

  [[nodiscard]] ProximityModelParams params() const {
    ProximityModelParams params = params_;
    set_weights(params, weights_);
    return params;
  }

 private:
  struct Cell {
    std::size_t measured;
    double count;
    std::array<double, kParts> parts;
  };
  struct Column {
    int expected;
    std::size_t first, last;  ///< of cells_
  };

  [[nodiscard]] double probability(const Cell& cell) const {
    double p = 0.0;
    for (std::size_t i = 0; i < kParts; ++i) p += weights_[i] * cell.parts[i];
    return p;
  }

  void fill_peaks() {
    std::array<double, kRangeBins> about{};
    std::array<double, kRangeBins> beside{};
    for (const Column& column : columns_) {
      fill_hit(params_, bins_, column.expected, about);
      fill_near(params_, bins_, column.expected, beside);
      for (std::size_t i = column.first; i < column.last; ++i) {
        cells_[i].parts[hit] = about[cells_[i].measured];
        cells_[i].parts[near] = beside[cells_[i].measured];
      }
    }
  }

  void fill_in_front() {
    std::array<double, kRangeBins> shorter{};
    for (const Column& column : columns_) {
      fill_short(params_, bins_, column.expected, shorter);
      for (std::size_t i = column.first; i < column.last; ++i) cells_[i].parts[in_front] = shorter[cells_[i].measured];
    }
  }

  /// E: what share of each reading every part has; M: the mean of the shares.
  void step_weights() {
    Weights shares{};
    for (const Cell& cell : cells_) {
      const double per_probability = cell.count / probability(cell);
      for (std::size_t i = 0; i < kParts; ++i) shares[i] += weights_[i] * cell.parts[i] * per_probability;
    }
    for (double& share : shares) share /= total_;
    weights_ = floored(shares, {0.0, 0.0, options_.least_short, options_.least_no_return, options_.least_random});
  }

  /// Golden section over one parameter, between half and twice its value; keeps it only when the likelihood rises.
  void search(double ProximityModelParams::*field, double least, double most, void (Climb::*fill)()) {
    constexpr double kGolden = 0.6180339887498949;
    const double before = params_.*field;
    const double best_before = log_likelihood();
    const auto value_at = [&](double value) {
      params_.*field = value;
      (this->*fill)();
      return log_likelihood();
    };
    double low = std::clamp(0.5 * before, least, most);
    double high = std::clamp(std::max(2.0 * before, 0.005), least, most);
    double inner = high - kGolden * (high - low);
    double outer = low + kGolden * (high - low);
    double at_inner = value_at(inner);
    double at_outer = value_at(outer);
    double best = before;
    double best_value = best_before;
    for (int i = 0; i < kSearchSteps; ++i) {
      for (const auto& [x, value] : {std::pair{inner, at_inner}, std::pair{outer, at_outer}})
        if (value > best_value) best = x, best_value = value;
      if (at_inner > at_outer) {
        high = outer, outer = inner, at_outer = at_inner;
        inner = high - kGolden * (high - low);
        at_inner = value_at(inner);
      } else {
        low = inner, inner = outer, at_inner = at_outer;
        outer = low + kGolden * (high - low);
        at_outer = value_at(outer);
      }
    }
    params_.*field = best;
    (this->*fill)();
  }

  RangeBins bins_;
  double total_;
  ProximityFitParams options_;
  ProximityModelParams params_;  ///< its weights are not kept up
  Weights weights_{};
  std::vector<Cell> cells_;
  std::vector<Column> columns_;
};

/// Within the bounds of the options.
ProximityModelParams bounded(ProximityModelParams params, const ProximityFitParams& options) {
  params.sigma = std::clamp(params.sigma, options.least_sigma, options.most_sigma);
  params.sigma_per_metre = std::clamp(params.sigma_per_metre, 0.0, options.most_sigma_per_metre);
  params.near_factor = std::clamp(params.near_factor, 1.0, options.most_near_factor);
  params.short_per_metre =
      std::clamp(params.short_per_metre, options.least_short_per_metre, options.most_short_per_metre);
  // A part without weight would never get any.
  Weights weights = weights_of(params);
  for (double& weight : weights) weight = 0.98 * weight + 0.02 / kParts;
  set_weights(params, floored(weights, {0.0, 0.0, options.least_short, options.least_no_return, options.least_random}));
  return params;
}

}  // namespace

void ReadingCounts::add(int measured, int expected) {
  if (expected == kUnknownRange) return;
  ++counts_[index(measured, expected)];
  ++total_;
}

void ReadingCounts::add(const ReadingCounts& other) {
  DOCENT_CHECK(other.bins_.max_range() == bins_.max_range());
  std::transform(counts_.begin(), counts_.end(), other.counts_.begin(), counts_.begin(), std::plus{});
  total_ += other.total_;
}

std::uint64_t ReadingCounts::expected(int expected) const {
  const auto first = counts_.begin() + static_cast<std::ptrdiff_t>(index(0, expected));
  return std::accumulate(first, first + kRangeBins, std::uint64_t{0});
}

double mean_log_likelihood(const ReadingCounts& counts, const ProximityModelParams& params) {
  return counts.total() == 0 ? 0.0 : Climb{counts, params, {}}.log_likelihood();
}

Result<ProximityFit> fit_proximity_model(const ReadingCounts& counts, const ProximityModelParams& start,
                                         const ProximityFitParams& options) {
  if (static_cast<double>(counts.total()) < options.least_readings)
    return fail("too few readings with a known place: " + std::to_string(counts.total()) + ", at least " +
                std::to_string(std::lround(options.least_readings)) + " are needed");
  std::optional<ProximityFit> best;
  for (const double sharpness : {1.0, 0.3, 2.0}) {
    ProximityModelParams from = start;
    from.sigma *= sharpness;
    from.sigma_per_metre *= sharpness;
    Climb climb{counts, bounded(from, options), options};
    ProximityFit fit;
    fit.history.push_back(climb.log_likelihood());
    for (int round = 0; round < options.most_rounds; ++round) {
      fit.history.push_back(climb.round());
      if (fit.history.back() - fit.history[fit.history.size() - 2] < options.settled) break;
    }
    fit.params = climb.params();
    fit.after = fit.history.back();
    if (!best || fit.after > best->after) best = std::move(fit);
  }
  best->readings = counts.total();
  best->before = mean_log_likelihood(counts, start);
  return *best;
}

}  // namespace docent::sensor_models
