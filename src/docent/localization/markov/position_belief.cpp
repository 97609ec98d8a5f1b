#include "docent/localization/markov/position_belief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace docent::localization {

namespace {

constexpr double kMostNats = 87.0;  ///< a float can hold exp of minus that

float factor_of(double nats, double most) {
  return static_cast<float>(std::exp(-std::clamp(nats, 0.0, std::min(most, kMostNats))));
}

}  // namespace

PositionBelief::PositionBelief(const StateSpace& space, double threshold_fraction)
    : space_{&space},
      stride_{(static_cast<std::size_t>(space.headings()) + kRowBlock - 1) / kRowBlock * kRowBlock},
      threshold_{threshold_fraction > 0.0 ? threshold_fraction / static_cast<double>(space.states()) : -1.0},
      bias_(stride_, 0.0F),
      limit_(stride_, std::numeric_limits<float>::infinity()) {
  use(instruction_sets().back());
  std::fill_n(limit_.begin(), space.headings(), static_cast<float>(threshold_));
  slot_.assign(space.places(), -1);
  marks_.assign(space.places(), 0);
  rows_.resize(space.places() * stride_);  // of which the first kept_.size() count: nothing is cleared or copied
  make_uniform();
}

void PositionBelief::use(InstructionSet set) {
  set_ = set;
  kernels_ = &row_kernels(set);
}

void PositionBelief::set_scale(double scale, double bias) {
  scale_ = static_cast<float>(scale);
  std::fill_n(bias_.begin(), space_->headings(), static_cast<float>(bias));
}

void PositionBelief::keep_all(float value) {
  const std::size_t places = space_->places();
  kept_.resize(places);
  std::iota(kept_.begin(), kept_.end(), 0);
  std::iota(slot_.begin(), slot_.end(), 0);
  const auto headings = static_cast<std::size_t>(space_->headings());
  set_scale(1.0, 0.0);
  for (std::size_t i = 0; i < places; ++i) fill_row(i, value);
  contents_.assign(places, {value, value * static_cast<float>(headings), static_cast<std::uint32_t>(headings)});
}

void PositionBelief::fill_row(std::size_t index, float value) {
  float* const row = rows_.data() + index * stride_;
  const auto headings = static_cast<std::size_t>(space_->headings());
  std::fill_n(row, headings, value);
  std::fill(row + headings, row + stride_, 0.0F);
}

void PositionBelief::make_uniform() {
  sea_ = 0.0;
  keep_all(static_cast<float>(1.0 / static_cast<double>(space_->states())));
  normalise(totals(), 0.0);
}

void PositionBelief::make_modes(std::span<const BeliefMode> modes, double uniform_mass) {
  struct Entry {
    std::int32_t place;
    std::size_t heading;
    float mass;
  };
  std::vector<Entry> entries;
  double total = 0.0;
  for (const BeliefMode& mode : modes) {
    const std::size_t first = entries.size();
    double sum = 0.0;
    for_states_near(mode, [&](std::int32_t place, std::size_t heading, double square) {
      entries.push_back({place, heading, static_cast<float>(std::exp(-0.5 * square))});
      sum += static_cast<double>(entries.back().mass);
    });
    if (sum <= 0.0) continue;  // no free place there
    for (std::size_t i = first; i < entries.size(); ++i) entries[i].mass *= static_cast<float>(mode.mass / sum);
    total += mode.mass;
  }
  // Everything else is sea.
  const double rest = std::max({uniform_mass, 1.0 - total, 1e-12});
  sea_ = rest / static_cast<double>(space_->states());
  kept_.clear();
  for (const Entry& entry : entries) kept_.push_back(entry.place);
  std::sort(kept_.begin(), kept_.end());
  kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
  std::fill(slot_.begin(), slot_.end(), -1);
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    slot_[static_cast<std::size_t>(kept_[i])] = static_cast<std::int32_t>(i);
    fill_row(i, static_cast<float>(sea_));
  }
  for (const Entry& entry : entries)
    rows_[static_cast<std::size_t>(slot_[static_cast<std::size_t>(entry.place)]) * stride_ + entry.heading] +=
        entry.mass;
  set_scale(1.0, 0.0);
  contents_.resize(kept_.size());
  if (threshold_ < 0.0) wake();
  normalise(totals(), 0.0);
}

/// visit(place, heading, squared distance in deviations) within five of them.
template <class Visitor>
void PositionBelief::for_states_near(const BeliefMode& mode, const Visitor& visit) const {
  // The grid cannot hold anything narrower than half a cell.
  const double cell = space_->frame().resolution;
  const double floor_xy = 0.25 * cell * cell;
  const double floor_theta = 0.25 * space_->heading_step() * space_->heading_step();
  const double sx = std::sqrt(std::max(mode.covariance[0], floor_xy));
  const double sy = std::sqrt(std::max(mode.covariance[4], floor_xy));
  const double st = std::sqrt(std::max(mode.covariance[8], floor_theta));
  const Point2 middle = mode.map_from_robot.position();
  const Point2 reach{4.0 * sx + cell, 4.0 * sy + cell};
  const GridFrame& frame = space_->frame();
  const CellIndex low = frame.cell_at(middle - reach);
  const CellIndex high = frame.cell_at(middle + reach);
  for (int row = std::max(low.row, 0); row <= std::min(high.row, frame.rows - 1); ++row) {
    for (int column = std::max(low.column, 0); column <= std::min(high.column, frame.columns - 1); ++column) {
      const std::int32_t place = space_->place_at({column, row});
      if (place == StateSpace::kNoPlace) continue;
      const Point2 off = space_->centre(static_cast<std::size_t>(place)) - middle;
      if (std::abs(off.x) > reach.x || std::abs(off.y) > reach.y) continue;
      for (std::size_t h = 0; h < static_cast<std::size_t>(space_->headings()); ++h) {
        const double turn =
            (Angle::radians(static_cast<double>(h) * space_->heading_step()) - mode.map_from_robot.theta).radians();
        const double square = off.x * off.x / (sx * sx) + off.y * off.y / (sy * sy) + turn * turn / (st * st);
        if (square <= 25.0) visit(place, h, square);
      }
    }
  }
}

RowTotals PositionBelief::totals() const {
  RowTotals totals;
  std::array<float, kRowBlock> lanes;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const float* const row = rows_.data() + i * stride_;
    lanes.fill(0.0F);
    for (std::size_t h = 0; h < stride_; ++h) {
      lanes[h % kRowBlock] += row[h];
      totals.peak = std::max(totals.peak, row[h]);
    }
    for (const float lane : lanes) totals.mass += static_cast<double>(lane);
  }
  return totals;
}

void PositionBelief::reweigh(const RangeTable& table, std::span<const BeamCosts> beams, double log_best_over_mean,
                             const EvidenceWeights& weights, double teleport, const PlaceCosts& others) {
  const std::size_t best = score(table, beams, weights, others);
  // Everything relative to the best active state, the states under water too.
  const double best_over_mean = log_best_over_mean - static_cast<double>(best) / kCostPerNat;
  const double most = std::min(weights.far_most_nats, kMostNats);
  RowEvidence slow;
  slow.best = static_cast<std::uint16_t>(best);
  slow.nats_per_cost = static_cast<float>(weights.far_share / kCostPerNat);
  slow.most_nats = static_cast<float>(most);
  slow.sea_factor = static_cast<float>(std::exp(std::clamp(-weights.far_share * best_over_mean, -most, most)));

  const Focus focus = focus_of(weights, slow);
  RowTotals totals;
  std::size_t next_focus = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (next_focus < focus.rows.size() && focus.rows[next_focus] == i) {
      reweigh_in_focus(i, focus, weights, slow, totals);
      ++next_focus;
    } else {
      kernels_->reweigh(rows_.data() + i * stride_, scale(), costs_.data() + i * stride_, slow, totals);
    }
  }
  sea_ *= static_cast<double>(slow.sea_factor);
  normalise(totals, teleport, true);
}

PositionBelief::Focus PositionBelief::focus_of(const EvidenceWeights& weights, const RowEvidence& slow) const {
  Focus focus;
  if (!weights.focus) return focus;
  const auto headings = static_cast<std::size_t>(space_->headings());
  focus.headings.assign(headings, 0);
  for (std::size_t h = 0; h < headings; ++h) {
    const Angle heading = Angle::radians(static_cast<double>(h) * space_->heading_step());
    if (weights.focus->holds(heading)) focus.headings[h] = 1;
  }
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (weights.focus->holds(space_->centre(static_cast<std::size_t>(kept_[i])))) focus.rows.push_back(i);
  }
  const auto for_active = [&](const auto& visit) {
    for (const std::size_t i : focus.rows) {
      const Row probabilities = row(i);
      for (std::size_t h = 0; h < headings; ++h)
        if (focus.headings[h] != 0 && probabilities[h] > limit_[h]) visit(probabilities[h], costs_[i * stride_ + h]);
    }
  };
  focus.best = std::numeric_limits<std::uint16_t>::max();
  for_active([&](float, std::uint16_t cost) { focus.best = std::min<std::size_t>(focus.best, cost); });
  double by_slow = 0.0;
  double by_sharp = 0.0;
  for_active([&](float p, std::uint16_t cost) {
    const double far = static_cast<double>(cost - slow.best) * static_cast<double>(slow.nats_per_cost);
    const double near = static_cast<double>(cost - focus.best) / kCostPerNat;
    by_slow += static_cast<double>(p * factor_of(far, weights.far_most_nats));
    by_sharp += static_cast<double>(p * factor_of(near, weights.most_nats));
  });
  focus.scale = static_cast<float>(by_sharp > 0.0 ? by_slow / by_sharp : 0.0);
  return focus;
}

void PositionBelief::reweigh_in_focus(std::size_t index, const Focus& focus, const EvidenceWeights& weights,
                                      const RowEvidence& slow, RowTotals& totals) {
  float* const row = rows_.data() + index * stride_;
  const std::uint16_t* const costs = costs_.data() + index * stride_;
  std::vector<float> before(stride_);
  kernels_->expand(row, scale(), before.data());
  RowTotals ignored;
  kernels_->reweigh(row, scale(), costs, slow, ignored);
  for (std::size_t h = 0; h < focus.headings.size(); ++h) {
    if (focus.headings[h] != 0 && before[h] > limit_[h]) {
      const double nats = static_cast<double>(costs[h] - focus.best) / kCostPerNat;
      row[h] = before[h] * (focus.scale * factor_of(nats, weights.most_nats));
    }
    totals.mass += static_cast<double>(row[h]);
    totals.peak = std::max(totals.peak, row[h]);
  }
}

std::size_t PositionBelief::score(const RangeTable& table, std::span<const BeamCosts> beams,
                                  const EvidenceWeights& weights, const PlaceCosts& others) {
  const auto headings = static_cast<std::size_t>(space_->headings());
  const auto cap = static_cast<std::uint16_t>(std::min(weights.most_sector_nats * kCostPerNat, 60000.0));
  TileScorer scorer{beams, headings, weights.sectors, cap, set_};
  costs_.resize(std::max(costs_.size(), kept_.size() * stride_));  // never less: nothing is cleared again
  const bool all = threshold_ < 0.0;
  const std::uint64_t all_blocks = (std::uint64_t{1} << (stride_ / kRowBlock)) - 1;
  std::uint16_t best = std::numeric_limits<std::uint16_t>::max();
  std::vector<std::uint8_t> lanes;
  std::vector<std::uint16_t*> rows;
  for (std::size_t i = 0; i < kept_.size();) {
    const std::size_t tile = static_cast<std::size_t>(kept_[i]) / RangeTable::kTile;
    const std::size_t first = i;
    std::uint64_t blocks = all ? all_blocks : 0;
    lanes.clear();
    rows.clear();
    for (; i < kept_.size() && static_cast<std::size_t>(kept_[i]) / RangeTable::kTile == tile; ++i) {
      const std::uint64_t active =
          all || is_all_active(i) ? all_blocks : kernels_->active_blocks(rows_.data() + i * stride_, scale());
      if (active == 0) continue;
      blocks |= active;
      lanes.push_back(static_cast<std::uint8_t>(static_cast<std::size_t>(kept_[i]) % RangeTable::kTile));
      rows.push_back(costs_.data() + i * stride_);
    }
    if (blocks == 0) continue;
    scorer.score(table.tile(tile), blocks, lanes, rows);
    for (std::size_t k = 0; others && k < rows.size(); ++k)
      others(tile * RangeTable::kTile + lanes[k], {rows[k], headings});
    for (std::size_t k = first; k < i; ++k) {
      const std::uint16_t* const costs = costs_.data() + k * stride_;
      best = std::min(best, all || is_all_active(k) ? kernels_->least_of_all(costs, headings)
                                                    : kernels_->least_cost(rows_.data() + k * stride_, scale(), costs));
    }
  }
  return best;
}

void PositionBelief::flood(double mass) {
  const double base = mass / static_cast<double>(space_->states());
  set_scale(static_cast<double>(scale_) * (1.0 - mass), static_cast<double>(bias_[0]) * (1.0 - mass) + base);
  sea_ = sea_ * (1.0 - mass) + base;
  peak_ = static_cast<float>(static_cast<double>(peak_) * (1.0 - mass) + base);
  settle();
}

void PositionBelief::normalise(const RowTotals& totals, double teleport, bool wants_entropy) {
  const std::size_t states = space_->states();
  const std::size_t under_sea = states - kept_.size() * static_cast<std::size_t>(space_->headings());
  const double total = totals.mass + sea_ * static_cast<double>(under_sea);
  if (!(total > 1e-300) || !std::isfinite(total)) {  // no state explains it: evidence 0, we know nothing
    sea_ = 0.0;
    entropy_.reset();
    keep_all(static_cast<float>(1.0 / static_cast<double>(states)));
    active_states_ = states;
    active_mass_ = 1.0;
    peak_ = rows_.empty() ? 0.0F : rows_[0];
    return;
  }
  const double scale = (1.0 - teleport) / total;
  const double bias = teleport / static_cast<double>(states);
  set_scale(scale, bias);
  sea_ = sea_ * scale + bias;
  peak_ = totals.peak * scale_ + bias_[0];
  settle(wants_entropy);
}

void PositionBelief::settle(bool wants_entropy) {
  entropy_.reset();
  const auto headings = static_cast<std::size_t>(space_->headings());
  active_states_ = space_->states();
  active_mass_ = 1.0;
  if (threshold_ < 0.0) {
    contents_.assign(kept_.size(), {std::numeric_limits<float>::infinity(), 0.0F, 0});  // nobody has looked
    return;
  }
  RowCensus census;
  census.inactive = space_->states() - kept_.size() * headings;
  census.inactive_mass = sea_ * static_cast<double>(census.inactive);
  contents_.resize(kept_.size());
  double sum_p_log_p = 0.0;
  std::size_t active = 0;
  std::size_t summed = 0;  // rows; those from the first inactive state on wait until it is known whether all will wake
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const float* const row = rows_.data() + i * stride_;
    contents_[i] = kernels_->take_census(row, scale(), headings, census);
    if (!wants_entropy || census.inactive > 0) continue;
    sum_p_log_p += kernels_->sum_p_log_p(row, scale(), active);
    summed = i + 1;
  }
  if (census.inactive == 0) {
    sea_ = 0.0;
    if (wants_entropy) entropy_ = entropy_of(sum_p_log_p, active);
    return;
  }
  sea_ = census.inactive_mass / static_cast<double>(census.inactive);
  const auto level = static_cast<float>(sea_);
  const bool wakes = level > limit_[0];
  std::size_t out = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    float* const row = rows_.data() + i * stride_;
    const std::int32_t place = kept_[i];
    slot_[static_cast<std::size_t>(place)] = -1;
    if (contents_[i].active == 0 && !wakes) continue;
    if (wants_entropy && !wakes && i >= summed) sum_p_log_p += kernels_->sum_p_log_p(row, scale(), active);
    kernels_->settle(row, scale(), level, headings);
    contents_[i].peak = std::max(contents_[i].peak, level);
    if (out != i) std::copy_n(row, stride_, rows_.data() + out * stride_);
    slot_[static_cast<std::size_t>(place)] = static_cast<std::int32_t>(out);
    contents_[out] = contents_[i];
    kept_[out++] = place;
  }
  kept_.resize(out);
  contents_.resize(out);
  set_scale(1.0, 0.0);
  if (wants_entropy && !wakes) entropy_ = entropy_of(sum_p_log_p, active);
  if (wakes) return wake();  // the sea has risen over the threshold: every state is above it again
  active_states_ = space_->states() - census.inactive;
  active_mass_ = std::clamp(1.0 - census.inactive_mass, 0.0, 1.0);
}

/// In place, from the last row to the first: a row never moves forward in the array.
void PositionBelief::wake() {
  const std::size_t places = space_->places();
  const auto level = static_cast<float>(sea_);
  const auto headings = static_cast<std::uint32_t>(space_->headings());
  const RowContent sea{level, level * static_cast<float>(headings), headings};
  std::size_t from = kept_.size();
  contents_.resize(places);
  for (std::size_t place = places; place-- > 0;) {
    if (from > 0 && kept_[from - 1] == static_cast<std::int32_t>(place)) {
      --from;
      if (from != place) std::copy_n(rows_.data() + from * stride_, stride_, rows_.data() + place * stride_);
      RowContent content = contents_[from];  // what was under water counts again
      content.active_mass += level * static_cast<float>(headings - content.active);
      content.active = headings;
      contents_[place] = content;
    } else {
      fill_row(place, level);
      contents_[place] = sea;
    }
  }
  kept_.resize(places);
  std::iota(kept_.begin(), kept_.end(), 0);
  std::iota(slot_.begin(), slot_.end(), 0);
  sea_ = 0.0;
}

std::optional<double> PositionBelief::row_mass(std::size_t index) const {
  if (threshold_ < 0.0) return std::nullopt;
  const RowContent& content = contents_[index];
  const auto headings = static_cast<std::uint32_t>(space_->headings());
  return static_cast<double>(content.active_mass) + sea_ * static_cast<double>(headings - content.active);
}

float PositionBelief::probability(std::size_t place, int heading) const {
  const std::int32_t slot = slot_[place];
  return slot < 0 ? static_cast<float>(sea_) : row(static_cast<std::size_t>(slot))[static_cast<std::size_t>(heading)];
}

double PositionBelief::entropy() const {
  if (entropy_) return *entropy_;
  double sum = 0.0;
  std::size_t active = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i)
    sum += kernels_->sum_p_log_p(rows_.data() + i * stride_, scale(), active);
  return entropy_of(sum, active);
}

double PositionBelief::entropy_of(double sum_p_log_p, std::size_t active) const {
  if (sea_ <= 0.0) return -sum_p_log_p;
  return -sum_p_log_p - static_cast<double>(space_->states() - active) * sea_ * std::log(sea_);
}

}  // namespace docent::localization
