#include "docent/localization/markov/belief_summary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Mass, mean and covariance of the cells near a pose.
BeliefMode gathered(const std::vector<BeliefSummary::Cell>& cells, const std::vector<bool>& taken, const Pose2& about,
                    const SummaryParams& params) {
  const double turn = params.mode_turn * std::numbers::pi / 180.0;
  double mass = 0.0, x = 0.0, y = 0.0, t = 0.0;
  double xx = 0.0, yy = 0.0, tt = 0.0, xy = 0.0, xt = 0.0, yt = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (taken[i]) continue;
    const double dx = static_cast<double>(cells[i].x) - about.x;
    const double dy = static_cast<double>(cells[i].y) - about.y;
    if (dx * dx + dy * dy > params.mode_radius * params.mode_radius) continue;
    const double dt = (Angle::radians(static_cast<double>(cells[i].theta)) - about.theta).radians();
    if (std::abs(dt) > turn) continue;
    const double m = static_cast<double>(cells[i].mass);
    mass += m, x += m * dx, y += m * dy, t += m * dt;
    xx += m * dx * dx, yy += m * dy * dy, tt += m * dt * dt, xy += m * dx * dy, xt += m * dx * dt, yt += m * dy * dt;
  }
  BeliefMode mode;
  mode.mass = mass;
  if (mass <= 0.0) return mode;
  x /= mass, y /= mass, t /= mass;
  mode.map_from_robot = {about.x + x, about.y + y, about.theta + Angle::radians(t)};
  mode.covariance = {xx / mass - x * x, xy / mass - x * y, xt / mass - x * t, xy / mass - x * y, yy / mass - y * y,
                     yt / mass - y * t, xt / mass - x * t, yt / mass - y * t, tt / mass - t * t};
  return mode;
}

void find_modes(BeliefSummary& summary, const SummaryParams& params) {
  constexpr std::size_t kMostModes = 8;
  const double turn = params.mode_turn * std::numbers::pi / 180.0;
  std::vector<bool> taken(summary.cells.size(), false);
  for (std::size_t i = 0; i < summary.cells.size() && summary.modes.size() < kMostModes; ++i) {
    if (taken[i]) continue;
    const auto& top = summary.cells[i];
    const Pose2 peak{static_cast<double>(top.x), static_cast<double>(top.y),
                     Angle::radians(static_cast<double>(top.theta))};
    BeliefMode mode = gathered(summary.cells, taken, peak, params);
    mode = gathered(summary.cells, taken, mode.map_from_robot, params);  // once more, about its own mean
    for (std::size_t j = i; j < summary.cells.size(); ++j) {
      const auto& cell = summary.cells[j];
      const Point2 off =
          Point2{static_cast<double>(cell.x), static_cast<double>(cell.y)} - mode.map_from_robot.position();
      const double dt = (Angle::radians(static_cast<double>(cell.theta)) - mode.map_from_robot.theta).radians();
      if (norm(off) <= params.mode_radius && std::abs(dt) <= turn) taken[j] = true;
    }
    taken[i] = true;
    if (mode.mass > 0.0) summary.modes.push_back(mode);
  }
  std::stable_sort(summary.modes.begin(), summary.modes.end(),
                   [](const BeliefMode& a, const BeliefMode& b) { return a.mass > b.mass; });
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
  return summary;
}

}  // namespace docent
