#include "docent/localization/markov/position_summary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace docent::localization {

namespace {

struct Entry {
  float mass;
  std::int32_t place;
  std::int32_t heading;
};
bool is_likelier(const Entry& a, const Entry& b) {  // a total order, so that runs repeat
  if (a.mass != b.mass) return a.mass > b.mass;
  return a.place != b.place ? a.place < b.place : a.heading < b.heading;
}

/// Less cannot be listed: a state can be among the first N only with a share of the mass that beats the uniform belief
/// by far, or there is nothing worth listing.
float least_listed(const PositionBelief& belief) {
  return static_cast<float>(
      std::max(4.0 / static_cast<double>(belief.space().states()), 1e-7 * static_cast<double>(belief.peak())));
}

std::vector<Entry> likeliest(const PositionBelief& belief, const SummaryParams& params) {
  const float least = least_listed(belief);
  const std::vector<float> levels(belief.row_stride(), least);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < belief.kept_places().size(); ++i) {
    if (belief.row_peak(i) <= least) continue;
    const auto row = belief.row(i);
    for (std::uint64_t blocks = belief.blocks_above(i, levels); blocks != 0; blocks &= blocks - 1) {
      const std::size_t first = static_cast<std::size_t>(std::countr_zero(blocks)) * kRowBlock;
      for (std::size_t h = first; h < std::min(first + kRowBlock, row.size()); ++h)
        if (row[h] > least) entries.push_back({row[h], belief.kept_places()[i], static_cast<std::int32_t>(h)});
    }
  }
  if (entries.size() > params.most_cells) {
    std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(params.most_cells), entries.end(),
                     &is_likelier);
    entries.resize(params.most_cells);
  }
  std::sort(entries.begin(), entries.end(), &is_likelier);
  double mass = 0.0;
  std::size_t count = 0;
  while (count < entries.size() && mass < params.enough_mass) mass += static_cast<double>(entries[count++].mass);
  entries.resize(count);
  return entries;
}

/// [kept] mass of each row.
std::vector<double> row_masses(const PositionBelief& belief) {
  const float least = least_listed(belief);
  std::vector<double> masses(belief.kept_places().size());
  std::vector<float> row(belief.row_stride(), 0.0F);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    // From what is listed nothing but rounding may be left.
    if (const auto known = belief.row_peak(i) > least ? std::nullopt : belief.row_mass(i)) {
      masses[i] = *known;
      continue;
    }
    belief.read_row(i, row);
    for (const float value : row) masses[i] += static_cast<double>(value);
  }
  return masses;
}

/// Mass in each coarse cell that no listed state has.
void fill_rest(const PositionBelief& belief, const std::vector<Entry>& listed, const CoarseCells& coarse,
               BeliefSummary& summary) {
  summary.rest_origin = coarse.origin;
  summary.rest_cell_size = coarse.size;
  summary.rest_columns = coarse.columns;
  summary.rest_rows = coarse.rows;
  const std::vector<double> masses = row_masses(belief);
  std::vector<double> mass(coarse.places.size(), 0.0);
  std::vector<std::int32_t> under_sea = coarse.places;
  const auto cell_of = [&](std::int32_t place) {
    return static_cast<std::size_t>(coarse.of_place[static_cast<std::size_t>(place)]);
  };
  for (std::size_t i = 0; i < belief.kept_places().size(); ++i) {
    const std::size_t cell = cell_of(belief.kept_places()[i]);
    --under_sea[cell];
    mass[cell] += masses[i];
  }
  const double sea = belief.sea_level() * belief.space().headings();
  for (std::size_t cell = 0; cell < mass.size(); ++cell) mass[cell] += sea * static_cast<double>(under_sea[cell]);
  for (const Entry& entry : listed) mass[cell_of(entry.place)] -= static_cast<double>(entry.mass);
  summary.rest.reserve(mass.size());
  for (const double value : mass) summary.rest.push_back(static_cast<float>(std::max(0.0, value)));
}

}  // namespace

CoarseCells::CoarseCells(const StateSpace& space, double cell_size)
    : origin{space.frame().origin},
      size{cell_size},
      columns{static_cast<int>(std::ceil(space.frame().columns * space.frame().resolution / cell_size))},
      rows{static_cast<int>(std::ceil(space.frame().rows * space.frame().resolution / cell_size))},
      of_place(space.places()),
      places(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {
  for (std::size_t place = 0; place < space.places(); ++place) {
    const Point2 middle = space.centre(place) - origin;
    of_place[place] = static_cast<int>(middle.y / size) * columns + static_cast<int>(middle.x / size);
    ++places[static_cast<std::size_t>(of_place[place])];
  }
}

BeliefSummary summarise(const PositionBelief& belief, const CoarseCells& coarse, const Pose2& frame_from_robot,
                        const SummaryParams& params) {
  BeliefSummary summary;
  const std::vector<Entry> entries = likeliest(belief, params);
  summary.cells.reserve(entries.size());
  for (const Entry& entry : entries) {
    const Point2 middle = belief.space().centre(static_cast<std::size_t>(entry.place));
    const Pose2 map_from_frame{middle.x, middle.y, Angle::radians(entry.heading * belief.space().heading_step())};
    const Pose2 pose = map_from_frame * frame_from_robot;
    summary.cells.push_back(
        {static_cast<float>(pose.x), static_cast<float>(pose.y), static_cast<float>(pose.theta.radians()), entry.mass});
  }
  fill_rest(belief, entries, coarse, summary);
  find_modes(summary, params);
  summary.entropy = belief.entropy();
  summary.active_mass = belief.active_mass();
  summary.active_states = belief.active_states();
  return summary;
}

std::vector<LikelyState> likely_states(const PositionBelief& belief, double fraction, std::size_t limit) {
  std::vector<LikelyState> states;
  const auto least = static_cast<float>(fraction * static_cast<double>(belief.peak()));
  double total = 0.0;
  for (std::size_t i = 0; i < belief.kept_places().size(); ++i) {
    if (belief.row_peak(i) < least) continue;
    const auto row = belief.row(i);
    for (std::size_t h = 0; h < row.size(); ++h) {
      if (row[h] < least) continue;
      if (states.size() == limit) return {};
      states.push_back({belief.kept_places()[i], static_cast<std::int32_t>(h), row[h]});
      total += static_cast<double>(row[h]);
    }
  }
  for (LikelyState& state : states) state.mass = static_cast<float>(static_cast<double>(state.mass) / total);
  return states;
}

}  // namespace docent::localization
