#include "docent/localization/markov/position_summary.h"

#include <algorithm>
#include <cmath>

namespace docent {

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

std::vector<Entry> likeliest(const PositionBelief& belief, const SummaryParams& params) {
  // A state can be among the first N only with a share of the mass that beats the uniform belief by far, or there is
  // nothing worth listing.
  const auto least = static_cast<float>(
      std::max(4.0 / static_cast<double>(belief.space().states()), 1e-7 * static_cast<double>(belief.peak())));
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < belief.kept_places().size(); ++i) {
    const auto row = belief.row(i);
    for (std::size_t h = 0; h < row.size(); ++h)
      if (row[h] > least) entries.push_back({row[h], belief.kept_places()[i], static_cast<std::int32_t>(h)});
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

void fill_rest(const PositionBelief& belief, const std::vector<Entry>& listed, const SummaryParams& params,
               BeliefSummary& summary) {
  const StateSpace& space = belief.space();
  const GridFrame& frame = space.frame();
  summary.rest_origin = frame.origin;
  summary.rest_cell_size = params.rest_cell_size;
  summary.rest_columns = static_cast<int>(std::ceil(frame.columns * frame.resolution / params.rest_cell_size));
  summary.rest_rows = static_cast<int>(std::ceil(frame.rows * frame.resolution / params.rest_cell_size));
  std::vector<double> mass(static_cast<std::size_t>(summary.rest_columns) * static_cast<std::size_t>(summary.rest_rows),
                           0.0);
  const auto coarse = [&](std::size_t place) -> double& {
    const Point2 middle = space.centre(place) - frame.origin;
    const auto column = static_cast<std::size_t>(middle.x / params.rest_cell_size);
    const auto row = static_cast<std::size_t>(middle.y / params.rest_cell_size);
    return mass[row * static_cast<std::size_t>(summary.rest_columns) + column];
  };
  const double sea = belief.sea_level() * space.headings();
  std::size_t next = 0;
  for (std::size_t place = 0; place < space.places(); ++place) {
    if (next < belief.kept_places().size() && belief.kept_places()[next] == static_cast<std::int32_t>(place)) {
      double sum = 0.0;
      for (const float value : belief.row(next)) sum += static_cast<double>(value);
      coarse(place) += sum;
      ++next;
    } else {
      coarse(place) += sea;
    }
  }
  for (const Entry& entry : listed) coarse(static_cast<std::size_t>(entry.place)) -= static_cast<double>(entry.mass);
  summary.rest.reserve(mass.size());
  for (const double value : mass) summary.rest.push_back(static_cast<float>(std::max(0.0, value)));
}

}  // namespace

BeliefSummary summarise(const PositionBelief& belief, const Pose2& frame_from_robot, const SummaryParams& params) {
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
  fill_rest(belief, entries, params, summary);
  find_modes(summary, params);
  summary.entropy = belief.entropy();
  summary.active_mass = belief.active_mass();
  summary.active_states = belief.active_states();
  return summary;
}

}  // namespace docent
