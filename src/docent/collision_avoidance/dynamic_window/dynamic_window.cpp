#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "docent/collision_avoidance/body/braking.h"

namespace docent::collision_avoidance {

namespace {

constexpr double kOnTheSpot = 1e-6;  // [m/s]

}  // namespace

Result<void> DynamicWindowParams::validate() const {
  if (!(cycle >= 0.05 && cycle <= 1.0)) return fail("avoid.window.cycle must lie between 0.05 and 1 s");
  for (const double weight : {heading_weight, clearance_weight, speed_weight, change_weight}) {
    if (!(weight >= 0.0)) return fail("avoid.window: weights must be >= 0");
  }
  if (!(heading_time > 0.0)) return fail("avoid.window.heading_time must be > 0 s");
  if (linear_steps < 3 || linear_steps > 41 || angular_steps < 3 || angular_steps > 81) {
    return fail("avoid.window: linear_steps must lie in 3..41 and angular_steps in 3..81");
  }
  if (!(real_margin >= 0.03 && virtual_margin >= 0.03)) return fail("avoid.window: margins must be >= 0.03 m");
  if (!(border_margin >= 0.05)) return fail("avoid.window.border_margin must be >= 0.05 m");
  if (!(security_time >= 0.0 && security_most >= 0.0)) return fail("avoid.window: security must be >= 0");
  if (!(creep_speed > 0.0 && creep_speed <= 0.3)) return fail("avoid.window.creep_speed must lie in (0, 0.3] m/s");
  return {};
}

double DynamicWindowParams::speed_with(double slack) const {
  if (slack >= security_most || security_time == 0.0) return std::numeric_limits<double>::infinity();
  return creep_speed + std::max(0.0, slack) / security_time;
}

DynamicWindow::DynamicWindow(const BaseLimits& limits, const DynamicWindowParams& params, InstructionSet set)
    : limits_{limits}, params_{params}, kernels_{velocity_kernels(set)}, forwards_{set}, backwards_{set} {
  const std::size_t lanes = VelocityKernels::kLanes;
  stride_ = (static_cast<std::size_t>(params.angular_steps) + lanes - 1) / lanes * lanes;
  linear_.resize(static_cast<std::size_t>(params.linear_steps));
  for (auto* columns : {&angular_, &half_cosine_, &half_sine_, &cosine_, &sine_, &change_}) columns->resize(stride_);
  Polygon mirrored = limits.outline.corners();
  for (Point2& corner : mirrored) corner.x = -corner.x;
  if (auto tail_first = Outline::make(std::move(mirrored))) tail_first_ = std::move(*tail_first);
  for (auto* cells : {&curvatures_, &ways_, &clearances_, &values_}) cells->resize(linear_.size() * stride_);
}

DynamicWindow::Reachable DynamicWindow::reachable(const Velocity& velocity, const Steering& steering) const {
  const double cycle = params_.cycle;
  const double cap = std::clamp(steering.speed_cap, 0.0, limits_.max_speed);
  const double floor = steering.may_reverse ? -params_.creep_speed : 0.0;
  const double braked = velocity.linear - limits_.deceleration * cycle;
  const double low = std::min(std::max(floor, braked), std::max(cap, braked));
  const double high = std::max(low, std::min(cap, velocity.linear + limits_.acceleration * cycle));
  const double turn = limits_.turn_acceleration * cycle;
  return {low, high, std::max(-limits_.max_turn_rate, velocity.angular - turn),
          std::min(limits_.max_turn_rate, velocity.angular + turn)};
}

/// The way [m] that must be free at a speed.
double DynamicWindow::least_way(double linear) const {
  const double stopping = std::abs(linear) * limits_.hold() + linear * linear / (2.0 * limits_.deceleration);
  return params_.two_second_rule ? std::max(stopping, params_.rule_time * std::abs(linear)) : stopping;
}

void DynamicWindow::lay_out(const Reachable& range) {
  const int rows = params_.linear_steps;
  const int columns = params_.angular_steps;
  for (int row = 0; row < rows; ++row) {
    linear_[static_cast<std::size_t>(row)] = range.slowest + (range.fastest - range.slowest) * row / (rows - 1);
  }
  for (std::size_t i = 0; i < stride_; ++i) {
    const int column = std::min(static_cast<int>(i), columns - 1);
    angular_[i] = range.right + (range.left - range.right) * column / (columns - 1);
    const double turn = angular_[i] * params_.heading_time;
    half_cosine_[i] = std::cos(0.5 * turn);
    half_sine_[i] = std::sin(0.5 * turn);
    cosine_[i] = std::cos(turn);
    sine_[i] = std::sin(turn);
  }
  for (int row = 0; row < rows; ++row) {
    const double linear = linear_[static_cast<std::size_t>(row)];
    // On the spot the way is free whatever the curvature.
    const double per_speed = std::abs(linear) < kOnTheSpot ? 0.0 : 1.0 / linear;
    for (std::size_t i = 0; i < stride_; ++i) curvatures_[padded(row, 0) + i] = angular_[i] * per_speed;
  }
}

void DynamicWindow::measure_ways(std::span<const Obstacle> obstacles) {
  reach_points_.clear();
  border_points_.clear();
  const double body = limits_.outline.empty() ? limits_.radius : 0.0;
  for (const auto& obstacle : obstacles) {
    auto& points = obstacle.is_border && !limits_.outline.empty() ? border_points_ : reach_points_;
    points.push_back({obstacle.at, reach_of(obstacle, body)});
  }
  if (!limits_.outline.empty()) return measure_ways_of_outline();
  // Rows rise: first those in reverse, then those on the spot, then those forwards.
  std::size_t row = 0;
  const auto rows_while = [&](auto&& is_of_them) {
    const std::size_t first = row * stride_;
    while (row < linear_.size() && is_of_them(linear_[row])) ++row;
    return std::pair{first, row * stride_ - first};
  };
  const auto ask = [&](FreeWays& ways, bool backwards, const std::pair<std::size_t, std::size_t>& part) {
    if (part.second == 0) return;
    ways.build(reach_points_, backwards);
    ways.along(std::span{curvatures_}.subspan(part.first, part.second),
               std::span{ways_}.subspan(part.first, part.second));
  };
  ask(backwards_, true, rows_while([](double linear) { return linear <= -kOnTheSpot; }));
  const auto still = rows_while([](double linear) { return linear < kOnTheSpot; });
  std::fill_n(ways_.begin() + static_cast<std::ptrdiff_t>(still.first), still.second, FreeWays::kHorizon);
  ask(forwards_, false, rows_while([](double) { return true; }));
}

/// Here `reach` of a point is the margin alone. O(velocities * points), the closed form for those in the way alone.
void DynamicWindow::measure_ways_of_outline() {
  for (std::size_t row = 0; row < linear_.size(); ++row) {
    const bool backwards = linear_[row] < 0.0;
    const Outline& outline = backwards ? tail_first_ : limits_.outline;
    for (std::size_t i = row * stride_; i < (row + 1) * stride_; ++i) {
      ways_[i] = FreeWays::kHorizon;
      if (std::abs(linear_[row]) < kOnTheSpot) continue;
      const double curvature = std::clamp(curvatures_[i], -FreeWays::kMaxCurvature, FreeWays::kMaxCurvature);
      for (const auto& point : reach_points_) {
        const Point2 at{backwards ? -point.at.x : point.at.x, point.at.y};
        const double reach = outline.circumradius() + point.reach;
        const double power = 0.5 * (dot(at, at) - reach * reach);
        if (power > 0.0 && (std::abs(curvature * power - at.y) >= reach || norm(at) - reach >= ways_[i])) continue;
        ways_[i] = std::min(ways_[i], outline.arc_distance(curvature, at, point.reach));
      }
      for (const auto& point : border_points_) {
        const Point2 at{backwards ? -point.at.x : point.at.x, point.at.y};
        ways_[i] = std::min(ways_[i], arc_distance(curvature, {at, point.reach}));
      }
    }
  }
}

void DynamicWindow::judge_rows(const Velocity& last, std::span<const Obstacle> obstacles, const Steering& steering) {
  // On the spot every way is free: what counts is the way that is turned to.
  const double steered_way = straight_free_way(steering.bearing, obstacles, limits_.radius, params_.enough_way);
  const VelocityColumns columns{half_cosine_.data(), half_sine_.data(), cosine_.data(), sine_.data(), change_.data()};
  const double speed = std::max(steering.speed_cap, params_.least_scale);
  const Point2 ahead = unit(Angle::radians(steering.bearing));
  for (std::size_t row = 0; row < linear_.size(); ++row) {
    const double linear = linear_[row];
    for (std::size_t i = 0; i < stride_; ++i) {
      change_[i] = params_.change_weight * (std::abs(linear - last.linear) / limits_.max_speed +
                                            std::abs(angular_[i] - last.angular) / limits_.max_turn_rate);
    }
    const std::size_t first = row * stride_;
    const auto ways = std::span{ways_}.subspan(first, stride_);
    std::copy(ways.begin(), ways.end(), clearances_.begin() + static_cast<std::ptrdiff_t>(first));
    if (std::abs(linear) < params_.turning_speed)
      std::fill_n(clearances_.begin() + static_cast<std::ptrdiff_t>(first), stride_, steered_way);
    // Where the steered-for point is nearly reached its bearing tells little: look at most from half way.
    const double far = std::max(steering.distance, 2.0 * std::abs(linear) * params_.heading_time);
    const VelocityRow judged{linear,
                             params_.heading_time,
                             far * ahead.x,
                             far * ahead.y,
                             params_.heading_weight,
                             params_.speed_weight / speed,
                             params_.clearance_weight,
                             params_.enough_way,
                             least_way(linear)};
    kernels_.values(judged, columns, ways.data(), clearances_.data() + first, stride_, values_.data() + first);
  }
}

/// A good velocity whose neighbours are bad is one that noise made: each admissible one gets the mean of its 3 x 3
/// neighbours, itself four times; those refused count as nothing.
void DynamicWindow::smooth(std::vector<EvaluatedVelocity>& window) const {
  const int rows = params_.linear_steps;
  const int columns = params_.angular_steps;
  std::vector<double> beside(linear_.size() * stride_, 0.0);  // sums of three in a row
  for (int row = 0; row < rows; ++row) {
    double before = 0.0;
    double here = std::max(0.0, values_[padded(row, 0)]);
    for (int column = 0; column < columns; ++column) {
      const double after = column + 1 < columns ? std::max(0.0, values_[padded(row, column + 1)]) : 0.0;
      beside[padded(row, column)] = before + here + after;
      before = here;
      here = after;
    }
  }
  for (int row = 0; row < rows; ++row) {
    const int high = (row > 0 ? 1 : 0) + 1 + (row + 1 < rows ? 1 : 0);
    for (int column = 0; column < columns; ++column) {
      const double value = values_[padded(row, column)];
      const int wide = (column > 0 ? 1 : 0) + 1 + (column + 1 < columns ? 1 : 0);
      double sum = 3.0 * value + beside[padded(row, column)];
      if (row > 0) sum += beside[padded(row - 1, column)];
      if (row + 1 < rows) sum += beside[padded(row + 1, column)];
      window.push_back({{linear_[static_cast<std::size_t>(row)], angular_[static_cast<std::size_t>(column)]},
                        value < 0.0 ? -1.0 : sum / (3 + high * wide)});
    }
  }
}

WindowChoice DynamicWindow::choose(const Velocity& velocity, const Velocity& last, std::span<const Obstacle> obstacles,
                                   const Steering& steering) {
  const Reachable range = reachable(velocity, steering);
  lay_out(range);
  measure_ways(obstacles);
  judge_rows(last, obstacles, steering);
  WindowChoice choice;
  choice.window.reserve(linear_.size() * static_cast<std::size_t>(params_.angular_steps));
  smooth(choice.window);

  // The closed form takes the velocity as reached at once. The few best are checked with the real dynamics: kept until
  // the watchdog bites, and braked at the next scan.
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < choice.window.size(); ++i) {
    if (choice.window[i].value >= 0.0) order.push_back(i);
  }
  const auto is_worse = [&](std::uint32_t a, std::uint32_t b) {
    const double of_a = choice.window[a].value;
    const double of_b = choice.window[b].value;
    return of_a < of_b || (of_a == of_b && a > b);
  };
  std::make_heap(order.begin(), order.end(), is_worse);
  // Of many refused ones only every so many is tried, so that the slow end of the window has its turn.
  for (std::size_t tried = 0; !order.empty() && tried < static_cast<std::size_t>(params_.tries); ++tried) {
    EvaluatedVelocity& candidate = choice.window[order.front()];
    if (can_brake_in_time(velocity, candidate.velocity, limits_.hold(), obstacles, limits_, 0.0) &&
        can_brake_in_time(velocity, candidate.velocity, params_.next_check, obstacles, limits_, 0.0)) {
      choice.command = candidate.velocity;
      return choice;
    }
    candidate.value = -1.0;
    for (std::size_t skip = 0;
         skip < 1 + tried / static_cast<std::size_t>(params_.tries_to_skip_more) && !order.empty(); ++skip) {
      std::pop_heap(order.begin(), order.end(), is_worse);
      order.pop_back();
    }
  }
  // Standing still or turning on the spot is always right where it can be reached.
  choice.is_braking = true;
  if (std::abs(velocity.linear) < params_.standing_speed) {
    const double wanted = std::clamp(steering.bearing / params_.heading_time, range.right, range.left);
    choice.is_braking = false;
    // A disc turns in its own place; another body may not.
    const bool may_turn =
        limits_.outline.empty() || can_brake_in_time(velocity, {0.0, wanted}, limits_.hold(), obstacles, limits_, 0.0);
    choice.command = {0.0, may_turn ? wanted : 0.0};
  }
  return choice;
}

}  // namespace docent::collision_avoidance
