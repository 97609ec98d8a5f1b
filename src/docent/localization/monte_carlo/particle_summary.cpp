#include "docent/localization/monte_carlo/particle_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace docent::localization {

std::vector<ParticleBin> bins_of(const ParticleSet& particles, const StateSpace& space) {
  struct Entry {
    std::uint64_t key;
    std::uint32_t particle;
  };
  const GridFrame& frame = space.frame();
  const auto headings = static_cast<std::uint64_t>(space.headings());
  std::vector<Entry> entries;
  entries.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!(particles.weight[i] > 0.0F)) continue;
    const Pose2 pose = particles.pose(i);
    CellIndex cell = frame.cell_at(pose.position());
    cell = {std::clamp(cell.column, 0, frame.columns - 1), std::clamp(cell.row, 0, frame.rows - 1)};
    const long heading = std::lround(pose.theta.radians() / space.heading_step() + space.headings());
    entries.push_back(
        {frame.index(cell) * headings + static_cast<std::uint64_t>(heading) % headings, static_cast<std::uint32_t>(i)});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.particle < b.particle; });
  std::vector<ParticleBin> bins;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (k == 0 || entries[k].key != entries[k - 1].key) {
      const std::size_t cell = entries[k].key / headings;
      const auto columns = static_cast<std::size_t>(frame.columns);
      bins.push_back({{static_cast<int>(cell % columns), static_cast<int>(cell / columns)},
                      static_cast<int>(entries[k].key % headings)});
    }
    const std::size_t i = entries[k].particle;
    const auto weight = static_cast<double>(particles.weight[i]);
    ParticleBin& bin = bins.back();
    bin.mass += weight;
    bin.x += weight * static_cast<double>(particles.x[i]);
    bin.y += weight * static_cast<double>(particles.y[i]);
    bin.cos += weight * static_cast<double>(particles.heading_x[i]);
    bin.sin += weight * static_cast<double>(particles.heading_y[i]);
  }
  return bins;
}

namespace {

void make_rest(const StateSpace& space, const SummaryParams& params, BeliefSummary& summary) {
  const GridFrame& frame = space.frame();
  summary.rest_origin = frame.origin;
  summary.rest_cell_size = params.rest_cell_size;
  summary.rest_columns = static_cast<int>(std::ceil(frame.columns * frame.resolution / params.rest_cell_size));
  summary.rest_rows = static_cast<int>(std::ceil(frame.rows * frame.resolution / params.rest_cell_size));
  summary.rest.assign(static_cast<std::size_t>(summary.rest_columns) * static_cast<std::size_t>(summary.rest_rows),
                      0.0F);
}

float& rest_at(Point2 in_map, BeliefSummary& summary) {
  const Point2 off = in_map - summary.rest_origin;
  const auto column = static_cast<std::size_t>(off.x / summary.rest_cell_size);
  const auto row = static_cast<std::size_t>(off.y / summary.rest_cell_size);
  return summary.rest[row * static_cast<std::size_t>(summary.rest_columns) + column];
}

}  // namespace

BeliefSummary summarise_unknown(const StateSpace& space, const SummaryParams& params) {
  BeliefSummary summary;
  make_rest(space, params, summary);
  summary.entropy = std::log(static_cast<double>(std::max<std::size_t>(space.states(), 1)));
  const float each = 1.0F / static_cast<float>(std::max<std::size_t>(space.places(), 1));
  for (std::size_t place = 0; place < space.places(); ++place) rest_at(space.centre(place), summary) += each;
  return summary;
}

BeliefSummary summarise(std::vector<ParticleBin> bins, const StateSpace& space, const SummaryParams& params) {
  std::stable_sort(bins.begin(), bins.end(),
                   [](const ParticleBin& a, const ParticleBin& b) { return a.mass > b.mass; });
  BeliefSummary summary;
  make_rest(space, params, summary);
  double listed = 0.0;
  for (const ParticleBin& bin : bins) {
    const auto mass = static_cast<float>(bin.mass);
    summary.entropy -= bin.mass * std::log(bin.mass);
    if (summary.cells.size() < params.most_cells && listed < params.enough_mass) {
      summary.cells.push_back({static_cast<float>(bin.x / bin.mass), static_cast<float>(bin.y / bin.mass),
                               static_cast<float>(std::atan2(bin.sin, bin.cos)), mass});
      listed += bin.mass;
      continue;
    }
    rest_at(space.frame().centre(bin.cell), summary) += mass;
  }
  find_modes(summary, params);
  summary.active_mass = 1.0;
  summary.active_states = bins.size();
  return summary;
}

std::vector<LikelyState> likely_states(const std::vector<ParticleBin>& bins, const StateSpace& space, double fraction,
                                       std::size_t limit) {
  double peak = 0.0;
  for (const ParticleBin& bin : bins) peak = std::max(peak, bin.mass);
  std::vector<LikelyState> states;
  double total = 0.0;
  for (const ParticleBin& bin : bins) {
    const std::int32_t place = space.place_at(bin.cell);
    if (place == StateSpace::kNoPlace || bin.mass < fraction * peak) continue;
    if (states.size() == limit) return {};
    states.push_back({place, bin.heading, static_cast<float>(bin.mass)});
    total += bin.mass;
  }
  for (LikelyState& state : states) state.mass = static_cast<float>(static_cast<double>(state.mass) / total);
  return states;
}

}  // namespace docent::localization
