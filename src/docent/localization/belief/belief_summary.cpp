#include "docent/localization/belief/belief_summary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::localization {

namespace {

/// Mass, mean and covariance of the cells near a pose.
BeliefMode gathered(const std::vector<BeliefSummary::Cell>& cells, const Pose2& about, const SummaryParams& params) {
  const double turn = params.mode_turn * std::numbers::pi / 180.0;
  double mass = 0.0, x = 0.0, y = 0.0, t = 0.0;
  double xx = 0.0, yy = 0.0, tt = 0.0, xy = 0.0, xt = 0.0, yt = 0.0;
  for (const BeliefSummary::Cell& cell : cells) {
    const double dx = static_cast<double>(cell.x) - about.x;
    const double dy = static_cast<double>(cell.y) - about.y;
    if (dx * dx + dy * dy > params.mode_radius * params.mode_radius) continue;
    const double dt = (Angle::radians(static_cast<double>(cell.theta)) - about.theta).radians();
    if (std::abs(dt) > turn) continue;
    const double m = static_cast<double>(cell.mass);
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

}  // namespace

void find_modes(BeliefSummary& summary, const SummaryParams& params) {
  constexpr std::size_t kMostModes = 8;
  const double turn = params.mode_turn * std::numbers::pi / 180.0;
  std::vector<BeliefSummary::Cell> left = summary.cells;  // that no mode has taken, the likeliest first
  while (!left.empty() && summary.modes.size() < kMostModes) {
    const auto& top = left.front();
    const Pose2 peak{static_cast<double>(top.x), static_cast<double>(top.y),
                     Angle::radians(static_cast<double>(top.theta))};
    BeliefMode mode = gathered(left, peak, params);
    mode = gathered(left, mode.map_from_robot, params);  // once more, about its own mean
    const auto is_taken = [&](const BeliefSummary::Cell& cell) {
      const Point2 off =
          Point2{static_cast<double>(cell.x), static_cast<double>(cell.y)} - mode.map_from_robot.position();
      if (norm(off) > params.mode_radius) return false;
      const double dt = (Angle::radians(static_cast<double>(cell.theta)) - mode.map_from_robot.theta).radians();
      return std::abs(dt) <= turn;
    };
    left.erase(std::remove_if(left.begin() + 1, left.end(), is_taken), left.end());
    left.erase(left.begin());
    if (mode.mass > 0.0) summary.modes.push_back(mode);
  }
  std::stable_sort(summary.modes.begin(), summary.modes.end(),
                   [](const BeliefMode& a, const BeliefMode& b) { return a.mass > b.mass; });
}

BeliefSummary carried_on(BeliefSummary belief, const Pose2& before_from_now) {
  for (BeliefSummary::Cell& cell : belief.cells) {
    const Pose2 pose = Pose2{static_cast<double>(cell.x), static_cast<double>(cell.y),
                             Angle::radians(static_cast<double>(cell.theta))} *
                       before_from_now;
    cell = {static_cast<float>(pose.x), static_cast<float>(pose.y), static_cast<float>(pose.theta.radians()),
            cell.mass};
  }
  for (BeliefMode& mode : belief.modes) mode.map_from_robot = mode.map_from_robot * before_from_now;
  return belief;
}

}  // namespace docent::localization
