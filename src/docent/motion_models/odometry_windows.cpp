#include "docent/motion_models/odometry_windows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::motion_models {

namespace {

constexpr Symmetric3 kPosition{1.0, 0.0, 0.0, 1.0, 0.0, 0.0};
constexpr Symmetric3 kHeading{0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
constexpr double kSlipShift = 0.15;                           // [m] deviation
constexpr double kSlipTurn = 7.0 * std::numbers::pi / 180.0;  // [rad] deviation

/// What a unit of heading variance at a place becomes at the end; `end_from_place`.
Symmetric3 lever(const Pose2& end_from_place) {
  const double x = end_from_place.y;
  const double y = -end_from_place.x;
  return {x * x, x * y, x, y * y, y, 1.0};
}

/// [m]: what a motion counts where way and turns count together.
double effort(const Pose2& before_from_after) {
  return norm(before_from_after.position()) + 0.5 * std::abs(before_from_after.theta.radians());
}

}  // namespace

void Symmetric3::add(double scale, const Symmetric3& other) {
  xx += scale * other.xx;
  xy += scale * other.xy;
  xt += scale * other.xt;
  yy += scale * other.yy;
  yt += scale * other.yt;
  tt += scale * other.tt;
}

MotionWindow motion_window(std::span<const Pose2> odom_from_robot, const Pose2& start_from_end) {
  MotionWindow window;
  const Pose2 end_from_odom = inverse(odom_from_robot.back());
  for (std::size_t i = 1; i < odom_from_robot.size(); ++i) {
    const Pose2 step = inverse(odom_from_robot[i - 1]) * odom_from_robot[i];
    const double way = norm(step.position());
    const double turn = std::abs(step.theta.radians());
    const Symmetric3 heading = lever(end_from_odom * odom_from_robot[i]);
    const double exposure = std::min(1.0, way / 0.25 + turn / 0.5);
    window.way += way;
    window.turn += turn;
    window.exposure += exposure;
    window.unit[translation_per_metre].add(way, kPosition);
    window.unit[translation_per_radian].add(turn, kPosition);
    window.unit[rotation_per_metre].add(way, heading);
    window.unit[rotation_per_radian].add(turn, heading);
    window.slip.add(exposure * kSlipTurn * kSlipTurn, heading);
    window.slip.add(exposure * kSlipShift * kSlipShift, kPosition);
  }
  const Pose2 end_from_start = end_from_odom * odom_from_robot.front();
  window.unit[label_position].add(2.0, kPosition);
  window.unit[label_heading].add(1.0, lever(end_from_start));
  window.unit[label_heading].add(1.0, kHeading);
  Symmetric3 one_slip;
  if (window.exposure > 0.0) one_slip.add(1.0 / window.exposure, window.slip);
  window.slip = one_slip;
  const Pose2 error = end_from_start * start_from_end;
  window.error = {error.x, error.y, error.theta.radians()};
  return window;
}

std::vector<PlacedWindow> motion_windows(std::span<const LabelledOdometry> moments, const MotionWindowParams& params) {
  // Thinned to steps; labels stand at steps only.
  std::vector<std::size_t> steps;
  std::vector<Pose2> odometry;
  std::vector<double> along;  // [m] of effort
  const double step_turn = params.step_turn * std::numbers::pi / 180.0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Pose2 step = steps.empty() ? Pose2{} : inverse(odometry.back()) * moments[i].odom_from_robot;
    const double way = norm(step.position());
    if (!steps.empty() && way < params.step_way && std::abs(step.theta.radians()) < step_turn) continue;
    along.push_back(along.empty() ? 0.0 : along.back() + effort(step));
    steps.push_back(i);
    odometry.push_back(moments[i].odom_from_robot);
  }
  std::vector<PlacedWindow> windows;
  for (const double length : params.lengths) {
    double next = 0.0;
    std::size_t end = 0;
    for (std::size_t start = 0; start < steps.size(); ++start) {
      if (along[start] < next || !moments[steps[start]].sure) continue;
      end = std::max(end, start + 1);
      while (end < steps.size() && along[end] - along[start] < length) ++end;
      if (end == steps.size()) break;
      if (!moments[steps[end]].sure) continue;
      next = along[start] + params.stride;
      const Pose2 start_from_end = inverse(moments[steps[start]].map_from_robot) * moments[steps[end]].map_from_robot;
      windows.push_back({motion_window(std::span{odometry}.subspan(start, end - start + 1), start_from_end),
                         steps[start], steps[end]});
    }
  }
  return windows;
}

}  // namespace docent::motion_models
