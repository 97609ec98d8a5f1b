#include "docent/localization/markov/position_belief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace docent {

// The same source for several instruction sets, chosen when the program starts. Only element-wise arithmetic without
// contraction inside, so the results are the same. Sanitizers start too late for that choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define DOCENT_FOR_EVERY_CPU __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define DOCENT_FOR_EVERY_CPU
#endif

namespace {

DOCENT_FOR_EVERY_CPU void add_weighted(float* __restrict out, const float* __restrict weights,
                                       const float* __restrict values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += weights[i] * values[i];
}
DOCENT_FOR_EVERY_CPU void add_capped(std::uint16_t* __restrict sums, const std::uint16_t* __restrict values,
                                     std::uint16_t cap, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    sums[i] = static_cast<std::uint16_t>(sums[i] + (values[i] < cap ? values[i] : cap));
}
DOCENT_FOR_EVERY_CPU void add_scaled(float* __restrict out, float scale, const float* __restrict values,
                                     std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += scale * values[i];
}

/// Sum in a fixed order, whatever the vectors' length. @pre count is a multiple of 8
DOCENT_FOR_EVERY_CPU double sum_of(const float* values, std::size_t count) {
  double lanes[8] = {};
  for (std::size_t i = 0; i < count; i += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) lanes[lane] += static_cast<double>(values[i + lane]);
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

constexpr std::size_t kBlock = 64;  ///< headings that are scored together

}  // namespace

PositionBelief::PositionBelief(const StateSpace& space, double threshold_fraction)
    : space_{&space},
      stride_{(static_cast<std::size_t>(space.headings()) + kBlock - 1) / kBlock * kBlock},
      threshold_{threshold_fraction > 0.0 ? threshold_fraction / static_cast<double>(space.states()) : -1.0},
      score_{score_kernels().back().kernel} {
  for (int cost = 0; cost / kCostPerNat < 87.0; ++cost)
    decay_.push_back(static_cast<float>(std::exp(-cost / kCostPerNat)));
  decay_.push_back(0.0F);
  slot_.assign(space.places(), -1);
  marks_.assign(space.places(), 0);
  make_uniform();
}

void PositionBelief::keep_all(float value) {
  const std::size_t places = space_->places();
  const auto headings = static_cast<std::size_t>(space_->headings());
  kept_.resize(places);
  std::iota(kept_.begin(), kept_.end(), 0);
  std::iota(slot_.begin(), slot_.end(), 0);
  rows_.assign(places * stride_, 0.0F);
  for (std::size_t i = 0; i < places; ++i)
    std::fill_n(rows_.begin() + static_cast<std::ptrdiff_t>(i * stride_), headings, value);
}

void PositionBelief::make_uniform() {
  sea_ = 0.0;
  keep_all(static_cast<float>(1.0 / static_cast<double>(space_->states())));
  normalise(0.0);
}

void PositionBelief::make_modes(std::span<const BeliefMode> modes, double uniform_mass) {
  sea_ = 0.0;
  keep_all(0.0F);
  const auto headings = static_cast<std::size_t>(space_->headings());
  double total = 0.0;
  for (const BeliefMode& mode : modes) {
    // The grid cannot hold anything narrower than half a cell.
    const double floor_xy = 0.25 * space_->frame().resolution * space_->frame().resolution;
    const double floor_theta = 0.25 * space_->heading_step() * space_->heading_step();
    const double sx = std::sqrt(std::max(mode.covariance[0], floor_xy));
    const double sy = std::sqrt(std::max(mode.covariance[4], floor_xy));
    const double st = std::sqrt(std::max(mode.covariance[8], floor_theta));
    std::vector<std::pair<std::size_t, float>> entries;
    double sum = 0.0;
    for (std::size_t place = 0; place < space_->places(); ++place) {
      const Point2 off = space_->centre(place) - mode.map_from_robot.position();
      if (std::abs(off.x) > 4.0 * sx + space_->frame().resolution ||
          std::abs(off.y) > 4.0 * sy + space_->frame().resolution)
        continue;
      for (std::size_t h = 0; h < headings; ++h) {
        const double turn =
            (Angle::radians(static_cast<double>(h) * space_->heading_step()) - mode.map_from_robot.theta).radians();
        const double square = off.x * off.x / (sx * sx) + off.y * off.y / (sy * sy) + turn * turn / (st * st);
        if (square > 25.0) continue;
        entries.emplace_back(place * stride_ + h, static_cast<float>(std::exp(-0.5 * square)));
        sum += static_cast<double>(entries.back().second);
      }
    }
    if (sum <= 0.0) continue;  // no free place there
    for (const auto& [index, weight] : entries) rows_[index] += static_cast<float>(mode.mass / sum) * weight;
    total += mode.mass;
  }
  const double rest = std::max({uniform_mass, 1.0 - total, 1e-12});
  const auto base = static_cast<float>(rest / static_cast<double>(space_->states()));
  for (std::size_t i = 0; i < space_->places(); ++i)
    for (std::size_t h = 0; h < headings; ++h) rows_[i * stride_ + h] += base;
  normalise(0.0);
}

void PositionBelief::find_targets(int reach, std::vector<std::int32_t>& targets) {
  targets.clear();
  if (kept_.size() == space_->places()) {
    targets = kept_;
    return;
  }
  for (const std::int32_t place : kept_) {
    const CellIndex cell = space_->cell(static_cast<std::size_t>(place));
    for (int row = cell.row - reach; row <= cell.row + reach; ++row) {
      for (int column = cell.column - reach; column <= cell.column + reach; ++column) {
        const std::int32_t near = space_->place_at({column, row});
        if (near == StateSpace::kNoPlace || marks_[static_cast<std::size_t>(near)] != 0) continue;
        marks_[static_cast<std::size_t>(near)] = 1;
        targets.push_back(near);
      }
    }
  }
  std::sort(targets.begin(), targets.end());
  for (const std::int32_t place : targets) marks_[static_cast<std::size_t>(place)] = 0;
}

void PositionBelief::move_row(std::int32_t target, const MotionKernel& kernel, float* out) {
  const auto headings = static_cast<std::size_t>(space_->headings());
  const CellIndex cell = space_->cell(static_cast<std::size_t>(target));
  std::fill(shifted_.begin(), shifted_.end(), 0.0F);
  for (const MotionKernel::Offset& offset : kernel.offsets) {
    const std::int32_t source = space_->place_at({cell.column - offset.columns, cell.row - offset.rows});
    if (source == StateSpace::kNoPlace) continue;
    const std::int32_t slot = slot_[static_cast<std::size_t>(source)];
    float* const into = shifted_.data() + offset.first;
    const std::size_t count = offset.last - offset.first;
    if (slot >= 0) {
      add_weighted(into, offset.weights.data() + offset.first,
                   rows_.data() + static_cast<std::size_t>(slot) * stride_ + offset.first, count);
    } else {
      add_scaled(into, static_cast<float>(sea_), offset.weights.data() + offset.first, count);
    }
  }
  // extended_[i] is the heading i - reach, so that the blur needs no modulo.
  const int reach = static_cast<int>(kernel.heading_weights.size() / 2);
  const int turns = static_cast<int>(headings);
  int from = -reach % turns;
  if (from < 0) from += turns;
  extended_.resize(headings + 2 * static_cast<std::size_t>(reach));
  for (float& value : extended_) {
    value = shifted_[static_cast<std::size_t>(from)];
    if (++from == turns) from = 0;
  }
  std::fill_n(out, stride_, 0.0F);
  for (std::size_t k = 0; k < kernel.heading_weights.size(); ++k)
    add_scaled(out, kernel.heading_weights[k], extended_.data() + k, headings);
}

void PositionBelief::move(const MotionKernel& kernel) {
  find_targets(kernel.reach, targets_);
  next_rows_.resize(targets_.size() * stride_);
  shifted_.resize(static_cast<std::size_t>(space_->headings()));
  for (std::size_t i = 0; i < targets_.size(); ++i) move_row(targets_[i], kernel, next_rows_.data() + i * stride_);
  for (const std::int32_t place : kept_) slot_[static_cast<std::size_t>(place)] = -1;
  kept_.swap(targets_);
  rows_.swap(next_rows_);
  for (std::size_t i = 0; i < kept_.size(); ++i)
    slot_[static_cast<std::size_t>(kept_[i])] = static_cast<std::int32_t>(i);
  normalise(0.0);
}

void PositionBelief::reweigh(const RangeTable& table, std::span<const BeamCosts> beams, double log_best_over_mean,
                             const EvidenceWeights& weights, double teleport) {
  const std::size_t best = score(table, beams, weights);
  const double best_over_mean = log_best_over_mean - static_cast<double>(best) / kCostPerNat;
  const auto threshold = static_cast<float>(this->threshold());
  const auto headings = static_cast<std::size_t>(space_->headings());
  const std::size_t last = decay_.size() - 1;
  const auto most = [last](double nats) { return std::min(static_cast<std::size_t>(nats * kCostPerNat), last); };

  // The neighbourhood in focus first: its new shape, and what it would be worth by the slow evidence.
  const Focus focus = focus_of(weights);
  const std::size_t most_near = most(weights.most_nats);
  const std::size_t most_far = most(weights.far_most_nats);
  const auto near_factor = [&](std::uint16_t cost) { return decay_[std::min(cost - focus.best, most_near)]; };
  far_decay_.clear();  // of the cost above the best
  for (std::size_t above = 0; above <= std::numeric_limits<std::uint16_t>::max(); ++above) {
    const auto step = static_cast<std::size_t>(weights.far_share * static_cast<double>(above));
    far_decay_.push_back(decay_[std::min(step, most_far)]);
    if (step >= most_far) break;
  }
  const std::size_t last_far = far_decay_.size() - 1;
  const auto far_factor = [&](std::uint16_t cost) { return far_decay_[std::min(cost - best, last_far)]; };
  double slow = 0.0;
  double sharp = 0.0;
  for (const std::uint32_t i : focus.rows) {
    for (std::size_t h = 0; h < headings; ++h) {
      const std::size_t at = i * stride_ + h;
      if (focus.headings[h] == 0 || !(rows_[at] > threshold)) continue;
      slow += static_cast<double>(rows_[at] * far_factor(costs_[at]));
      sharp += static_cast<double>(rows_[at] * near_factor(costs_[at]));
    }
  }
  const auto focus_scale = static_cast<float>(sharp > 0.0 ? slow / sharp : 0.0);

  // Everything relative to the best active state, the states under water too.
  const double sea_nats =
      std::clamp(-weights.far_share * best_over_mean, -weights.far_most_nats, weights.far_most_nats);
  const auto sea_factor = static_cast<float>(std::exp(sea_nats));
  std::size_t next_focus = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const bool has_focus = next_focus < focus.rows.size() && focus.rows[next_focus] == i;
    next_focus += has_focus ? 1 : 0;
    float* const row = rows_.data() + i * stride_;
    const std::uint16_t* const costs = costs_.data() + i * stride_;
    for (std::size_t h = 0; h < headings; ++h) {
      if (!(row[h] > threshold)) {
        row[h] *= sea_factor;
      } else if (has_focus && focus.headings[h] != 0) {
        row[h] *= focus_scale * near_factor(costs[h]);
      } else {
        row[h] *= far_factor(costs[h]);
      }
    }
  }
  sea_ *= static_cast<double>(sea_factor);
  normalise(teleport);
}

PositionBelief::Focus PositionBelief::focus_of(const EvidenceWeights& weights) const {
  Focus focus;
  if (!weights.focus) return focus;
  const auto headings = static_cast<std::size_t>(space_->headings());
  focus.headings.assign(headings, 0);
  for (std::size_t h = 0; h < headings; ++h) {
    const Angle heading = Angle::radians(static_cast<double>(h) * space_->heading_step());
    if (std::abs((heading - weights.focus->theta).radians()) <= weights.focus_turn) focus.headings[h] = 1;
  }
  focus.best = std::numeric_limits<std::uint16_t>::max();
  const auto threshold = static_cast<float>(this->threshold());
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const Point2 centre = space_->centre(static_cast<std::size_t>(kept_[i]));
    if (distance(centre, weights.focus->position()) > weights.focus_radius) continue;
    focus.rows.push_back(static_cast<std::uint32_t>(i));
    for (std::size_t h = 0; h < headings; ++h)
      if (focus.headings[h] != 0 && rows_[i * stride_ + h] > threshold)
        focus.best = std::min<std::size_t>(focus.best, costs_[i * stride_ + h]);
  }
  return focus;
}

std::size_t PositionBelief::score(const RangeTable& table, std::span<const BeamCosts> beams,
                                  const EvidenceWeights& weights) {
  const auto all_headings = static_cast<std::size_t>(space_->headings());
  const auto cap = static_cast<std::uint16_t>(std::min(weights.most_sector_nats * kCostPerNat, 60000.0));
  std::vector<std::span<const BeamCosts>> sectors;
  for (std::size_t first = 0; first < beams.size();) {
    const auto sector = [&](std::size_t i) { return beams[i].direction * weights.sectors / all_headings; };
    std::size_t last = first + 1;
    while (last < beams.size() && sector(last) == sector(first)) ++last;
    sectors.push_back(beams.subspan(first, last - first));
    first = last;
  }
  const auto headings = static_cast<std::size_t>(space_->headings());
  const auto threshold = static_cast<float>(this->threshold());
  costs_.resize(kept_.size() * stride_);
  std::size_t best = std::numeric_limits<std::uint16_t>::max();
  std::array<std::uint16_t, kBlock> part{};
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const std::uint8_t* const ranges = table.row(static_cast<std::size_t>(kept_[i]));
    const float* const row = rows_.data() + i * stride_;
    std::uint16_t* const costs = costs_.data() + i * stride_;
    for (std::size_t first = 0; first < headings; first += kBlock) {
      const std::size_t count = std::min(kBlock, headings - first);
      bool active = false;
      for (std::size_t h = first; h < first + count; ++h) active = active || row[h] > threshold;
      if (!active) continue;
      std::fill_n(costs + first, kBlock, std::uint16_t{0});
      for (const auto& sector : sectors) {
        score_(ranges, first, count, sector, part.data());
        add_capped(costs + first, part.data(), cap, kBlock);
      }
      for (std::size_t h = first; h < first + count; ++h)
        if (row[h] > threshold) best = std::min<std::size_t>(best, costs[h]);
    }
  }
  return best;
}

void PositionBelief::flood(double mass) {
  const auto headings = static_cast<std::size_t>(space_->headings());
  const auto base = static_cast<float>(mass / static_cast<double>(space_->states()));
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    float* const row = rows_.data() + i * stride_;
    for (std::size_t h = 0; h < headings; ++h) row[h] = row[h] * static_cast<float>(1.0 - mass) + base;
  }
  sea_ = sea_ * (1.0 - mass) + static_cast<double>(base);
  normalise(0.0);
}

void PositionBelief::normalise(double teleport) {
  const auto headings = static_cast<std::size_t>(space_->headings());
  const std::size_t states = space_->states();
  const std::size_t under_sea = states - kept_.size() * headings;
  double total = sea_ * static_cast<double>(under_sea);
  for (std::size_t i = 0; i < kept_.size(); ++i) total += sum_of(rows_.data() + i * stride_, stride_);
  if (!(total > 1e-300) || !std::isfinite(total)) {  // no state explains it: evidence 0, we know nothing
    sea_ = 0.0;
    keep_all(static_cast<float>(1.0 / static_cast<double>(states)));
    active_states_ = states;
    active_mass_ = 1.0;
    peak_ = rows_.empty() ? 0.0F : rows_[0];
    return;
  }
  const auto scale = static_cast<float>((1.0 - teleport) / total);
  const auto base = static_cast<float>(teleport / static_cast<double>(states));
  const auto threshold = static_cast<float>(this->threshold());
  double inactive_mass =
      (sea_ * static_cast<double>(scale) + static_cast<double>(base)) * static_cast<double>(under_sea);
  std::size_t inactive_states = under_sea;
  peak_ = 0.0F;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    float* const row = rows_.data() + i * stride_;
    double low = 0.0;
    std::size_t count = 0;
    for (std::size_t h = 0; h < headings; ++h) {
      row[h] = row[h] * scale + base;
      peak_ = std::max(peak_, row[h]);
      if (row[h] <= threshold) {
        low += static_cast<double>(row[h]);
        ++count;
      }
    }
    inactive_mass += low;
    inactive_states += count;
  }
  settle(inactive_mass, inactive_states);
}

void PositionBelief::settle(double inactive_mass, std::size_t inactive_states) {
  const auto headings = static_cast<std::size_t>(space_->headings());
  const auto threshold = static_cast<float>(this->threshold());
  active_states_ = space_->states() - inactive_states;
  active_mass_ = std::clamp(1.0 - inactive_mass, 0.0, 1.0);
  sea_ = inactive_states > 0 ? inactive_mass / static_cast<double>(inactive_states) : 0.0;
  if (inactive_states == 0) return;
  const auto level = static_cast<float>(sea_);
  const bool wakes = level > threshold;
  std::size_t out = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    float* const row = rows_.data() + i * stride_;
    bool any = false;
    for (std::size_t h = 0; h < headings; ++h) {
      any = any || row[h] > threshold;
      if (row[h] <= threshold) row[h] = level;
    }
    const std::int32_t place = kept_[i];
    slot_[static_cast<std::size_t>(place)] = -1;
    if (!any && !wakes) continue;
    if (out != i) std::copy_n(row, stride_, rows_.data() + out * stride_);
    slot_[static_cast<std::size_t>(place)] = static_cast<std::int32_t>(out);
    kept_[out++] = place;
  }
  kept_.resize(out);
  rows_.resize(out * stride_);
  if (!wakes) return;
  wake();  // the sea has risen over the threshold: every state is above it again
  sea_ = 0.0;
  active_states_ = space_->states();
  active_mass_ = 1.0;
}

void PositionBelief::wake() {
  if (kept_.size() == space_->places()) return;
  std::vector<float> old_rows;
  old_rows.swap(rows_);
  const std::vector<std::int32_t> old_places = kept_;
  keep_all(static_cast<float>(sea_));
  for (std::size_t i = 0; i < old_places.size(); ++i)
    std::copy_n(old_rows.data() + i * stride_, stride_,
                rows_.data() + static_cast<std::size_t>(old_places[i]) * stride_);
}

float PositionBelief::probability(std::size_t place, int heading) const {
  const std::int32_t slot = slot_[place];
  return slot < 0 ? static_cast<float>(sea_)
                  : rows_[static_cast<std::size_t>(slot) * stride_ + static_cast<std::size_t>(heading)];
}

double PositionBelief::entropy() const {
  double sum = 0.0;
  std::size_t wet = space_->states();
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    for (const float value : row(i)) {
      if (!(value > static_cast<float>(threshold())) || value <= 0.0F) continue;
      sum -= static_cast<double>(value) * std::log(static_cast<double>(value));
      --wet;
    }
  }
  if (sea_ > 0.0) sum -= static_cast<double>(wet) * sea_ * std::log(sea_);
  return sum;
}

}  // namespace docent
