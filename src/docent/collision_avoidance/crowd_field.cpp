#include "docent/collision_avoidance/crowd_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace docent {
namespace {

constexpr int kCount = CrowdField::kCells * CrowdField::kCells;
constexpr float kFar = 1e6F;            // [s]
constexpr double kHazardCost = 1000.0;  // nobody steps out of the way there
constexpr float kAslant = 1.41421356F;
constexpr double kLastPart = 1.0;  // [m] of a path that may be made for: to join it earlier may be to wait for ever
constexpr double kBeyond = 4.0;    // [m] a path that goes on is made for so far beyond its end

}  // namespace

Result<void> CrowdFitParams::validate() const {
  if (!(horizon >= 0.6 && horizon <= 6.0)) return fail("avoid.crowd.horizon must lie between 0.6 and 6 s");
  if (!(hard_margin >= 0.0 && hard_margin <= intimate && intimate <= personal && personal <= 2.0))
    return fail("avoid.crowd: 0 <= hard_margin <= intimate <= personal <= 2 m must hold");
  for (const double weight :
       {intimate_weight, personal_weight, hidden_weight, blocked_weight, crossed_weight, uncertainty, change_weight}) {
    if (!(weight >= 0.0)) return fail("avoid.crowd: weights must be >= 0");
  }
  if (!(keeping > 0.0 && keeping <= 1.0)) return fail("avoid.crowd.keeping must lie in (0, 1]");
  if (!(patience > 0.0)) return fail("avoid.crowd.patience must be > 0 s");
  return {};
}

CrowdField::CrowdField(const CrowdFitParams& params, double robot_radius)
    : params_{params},
      robot_radius_{robot_radius},
      layers_{static_cast<int>(std::lround(params.horizon / kStep))},
      costs_(static_cast<std::size_t>(layers_) + 1, Layer(kCount)),
      values_(costs_),
      share_(kCount) {}

int CrowdField::cell_at(Point2 in_odom) const {
  const auto column = std::lround((in_odom.x - low_.x) / kCell);
  const auto row = std::lround((in_odom.y - low_.y) / kCell);
  if (column < 0 || row < 0 || column >= kCells || row >= kCells) return -1;
  return static_cast<int>(row) * kCells + static_cast<int>(column);
}

void CrowdField::stamp(const Obstacle& obstacle, double time, Layer& layer) const {
  const Point2 at = is_walking(obstacle) ? obstacle.at + time * obstacle.velocity : obstacle.at;
  const double reach = obstacle.is_virtual ? robot_radius_ + obstacle.margin : robot_radius_ + params_.personal;
  const double widened = is_walking(obstacle) ? params_.uncertainty * time : 0.0;
  const auto bound = [](double value) { return std::clamp(static_cast<int>(std::ceil(value)), 0, kCells); };
  const int first_row = bound((at.y - reach - low_.y) / kCell);
  const int last_row = bound((at.y + reach - low_.y) / kCell);
  const int first = bound((at.x - reach - low_.x) / kCell);
  const int last = bound((at.x + reach - low_.x) / kCell);
  for (int row = first_row; row < last_row; ++row) {
    const double dy = low_.y + row * kCell - at.y;
    for (int column = first; column < last; ++column) {
      const double dx = low_.x + column * kCell - at.x;
      const double squared = dx * dx + dy * dy;
      if (squared >= reach * reach) continue;
      const double gap = std::sqrt(squared) - robot_radius_;
      double cost = 0.0;
      if (obstacle.is_virtual) {
        cost = kHazardCost;
      } else if (gap < params_.hard_margin) {
        cost =
            is_walking(obstacle) || obstacle.stood < params_.stands ? params_.crossed_weight : params_.blocked_weight;
      } else if (gap - widened < params_.intimate) {
        cost = ease_ * params_.intimate_weight;
      } else {
        cost = ease_ * params_.personal_weight * (params_.personal - gap) / (params_.personal - params_.intimate);
      }
      float& here = layer[static_cast<std::size_t>(row * kCells + column)];
      here = std::max(here, static_cast<float>(cost));
    }
  }
}

void CrowdField::add_shadows(Point2 robot, std::span<const Obstacle> obstacles, Layer& layer) const {
  constexpr int kDirections = 180;
  constexpr double kBody = 0.5;  // [m] behind its near side the shadow begins
  constexpr double kToIndex = kDirections / (2.0 * std::numbers::pi);
  std::array<double, kDirections> seen{};
  seen.fill(std::numeric_limits<double>::infinity());
  const auto index_of = [&](Point2 offset) {
    const double turned = std::atan2(offset.y, offset.x) + std::numbers::pi;
    return static_cast<std::size_t>(turned * kToIndex) % kDirections;
  };
  for (const auto& obstacle : obstacles) {
    if (obstacle.is_virtual) continue;
    const Point2 offset = obstacle.at - robot;
    double& range = seen[index_of(offset)];
    range = std::min(range, norm(offset));
  }
  const auto hidden = static_cast<float>(ease_ * params_.hidden_weight);
  for (int cell = 0; cell < kCount; ++cell) {
    const Point2 offset = low_ + Point2{kCell * (cell % kCells), kCell * (cell / kCells)} - robot;
    float& cost = layer[static_cast<std::size_t>(cell)];
    if (norm(offset) > seen[index_of(offset)] + kBody) cost = std::max(cost, hidden);
  }
}

void CrowdField::build(Point2 robot, std::span<const Obstacle> obstacles, const CrowdPath& path, double ease) {
  ease_ = ease;
  is_final_ = !path.goes_on;
  // Cells keep their places in odom: what is decided does not flicker with the robot's own motion.
  constexpr int kMiddle = kCells / 2;
  low_ = {(std::round(robot.x / kCell) - kMiddle) * kCell, (std::round(robot.y / kCell) - kMiddle) * kCell};
  Layer& standing = costs_.back();
  std::fill(standing.begin(), standing.end(), 0.0F);
  for (const auto& obstacle : obstacles) {
    if (!is_walking(obstacle)) stamp(obstacle, 0.0, standing);
  }
  add_shadows(robot, obstacles, standing);
  std::fill(values_.back().begin(), values_.back().end(), kFar);
  open_.clear();
  seed_path(path, path.goes_on ? kBeyond : 0.0);
  if (path.goes_on) seed_front(robot, path);
  keep_to_way();
  solve_standing();
  find_way(robot);
  for (std::size_t layer = 0; layer + 1 < costs_.size(); ++layer) costs_[layer] = standing;
  for (std::size_t layer = 0; layer < costs_.size(); ++layer) {
    for (const auto& obstacle : obstacles) {
      if (is_walking(obstacle)) stamp(obstacle, static_cast<double>(layer) * kStep, costs_[layer]);
    }
  }
  for (std::size_t layer = costs_.size() - 1; layer-- > 0;) solve_layer(layer);
}

void CrowdField::seed_path(const CrowdPath& path, double beyond) {
  Layer& values = values_.back();
  double left = beyond;
  end_ = -1;
  const auto seed = [&](Point2 at) {
    const int cell = cell_at(at);
    if (cell < 0) return;
    const bool is_end = end_ < 0;  // as far as the field reaches
    if (is_end) end_ = cell;
    float& value = values[static_cast<std::size_t>(cell)];
    // Somebody stands on the path there: not a place to make for, unless it is the end.
    const bool is_beset = costs_.back()[static_cast<std::size_t>(cell)] >= static_cast<float>(params_.blocked_weight);
    const auto seconds_left = static_cast<float>(left / kSpeed);
    if ((is_beset && !is_end) || seconds_left >= value) return;
    value = seconds_left;
    open_.emplace_back(seconds_left, cell);
  };
  const auto& points = path.points;
  seed(points.back());
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    const double length = distance(points[i], points[i + 1]);
    const int steps = std::max(1, static_cast<int>(std::ceil(length / kCell)));
    for (int k = 1; k <= steps; ++k) {
      left += length / steps;
      if (left > beyond + kLastPart && end_ >= 0) return;
      seed(points[i + 1] + (static_cast<double>(k) / steps) * (points[i] - points[i + 1]));
    }
  }
}

void CrowdField::seed_front(Point2 robot, const CrowdPath& path) {
  constexpr double kStraight = 0.95;                   // of its length; one that bends has walls to go round
  constexpr double kAhead = 0.5;                       // cosine of half the front
  constexpr double kRim = (kCells / 2) * kCell - 0.5;  // [m] from the robot
  const Point2 way = path.points.back() - robot;
  const double length = norm(way);
  double along = distance(robot, path.points.front());
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) along += distance(path.points[i], path.points[i + 1]);
  if (length < 1.0 || length < kStraight * along) return;
  const Point2 ahead = (1.0 / length) * way;
  const Point2 far = path.points.back() + kBeyond * ahead;
  for (int cell = 0; cell < kCount; ++cell) {
    const Point2 at = low_ + Point2{kCell * (cell % kCells), kCell * (cell / kCells)};
    const Point2 offset = at - robot;
    const auto index = static_cast<std::size_t>(cell);
    const double away = norm(offset);
    if (away < std::max(kRim, length) || dot(offset, ahead) < kAhead * away) continue;
    if (costs_.back()[index] >= static_cast<float>(params_.blocked_weight)) continue;
    const auto left = static_cast<float>(distance(at, far) / kSpeed);
    if (left >= values_.back()[index]) continue;
    values_.back()[index] = left;
    open_.emplace_back(left, cell);
  }
}

void CrowdField::keep_to_way() {
  std::fill(share_.begin(), share_.end(), 1.0F);
  constexpr int kWide = 3;  // cells
  for (const Point2 at : way_) {
    const int cell = cell_at(at);
    if (cell < 0) continue;
    const int row = cell / kCells;
    const int column = cell % kCells;
    for (int r = std::max(0, row - kWide); r <= std::min(kCells - 1, row + kWide); ++r) {
      for (int c = std::max(0, column - kWide); c <= std::min(kCells - 1, column + kWide); ++c)
        share_[static_cast<std::size_t>(r * kCells + c)] = static_cast<float>(params_.keeping);
    }
  }
}

/// Steepest descent over the values of the last layer.
void CrowdField::find_way(Point2 from) {
  way_.clear();
  const Layer& values = values_.back();
  for (int cell = cell_at(from); cell >= 0;) {
    way_.push_back(low_ + Point2{kCell * (cell % kCells), kCell * (cell / kCells)});
    const int row = cell / kCells;
    const int column = cell % kCells;
    int next = -1;
    float least = values[static_cast<std::size_t>(cell)];
    for (int r = std::max(0, row - 1); r <= std::min(kCells - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(kCells - 1, column + 1); ++c) {
        const int there = r * kCells + c;
        if (values[static_cast<std::size_t>(there)] >= least) continue;
        least = values[static_cast<std::size_t>(there)];
        next = there;
      }
    }
    cell = next;
  }
}

void CrowdField::solve_standing() {
  Layer& values = values_.back();
  const Layer& costs = costs_.back();
  std::make_heap(open_.begin(), open_.end(), std::greater<>{});
  while (!open_.empty()) {
    const auto [value, cell] = open_.front();
    std::pop_heap(open_.begin(), open_.end(), std::greater<>{});
    open_.pop_back();
    if (value > values[static_cast<std::size_t>(cell)]) continue;
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        const int row = cell / kCells + dr;
        const int column = cell % kCells + dc;
        if ((dr == 0 && dc == 0) || row < 0 || column < 0 || row >= kCells || column >= kCells) continue;
        const int next = row * kCells + column;
        const float seconds_a_cell = static_cast<float>(kCell / kSpeed) * (dr != 0 && dc != 0 ? kAslant : 1.0F);
        const float slowed = share_[static_cast<std::size_t>(next)] +
                             0.5F * (costs[static_cast<std::size_t>(cell)] + costs[static_cast<std::size_t>(next)]);
        const float reached = value + seconds_a_cell * slowed;
        if (reached >= values[static_cast<std::size_t>(next)]) continue;
        values[static_cast<std::size_t>(next)] = reached;
        open_.emplace_back(reached, next);
        std::push_heap(open_.begin(), open_.end(), std::greater<>{});
      }
    }
  }
}

void CrowdField::solve_layer(std::size_t layer) {
  const Layer& next = values_[layer + 1];
  const Layer& costs = costs_[layer + 1];
  Layer& values = values_[layer];
  constexpr auto kSeconds = static_cast<float>(kStep);
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const auto here = static_cast<std::size_t>(row * kCells + column);
      // Staying costs what the place costs: who waits beside people for nothing would wait for ever.
      float best = next[here] + kSeconds * (1.0F + costs[here]);
      for (int r = std::max(0, row - 1); r <= std::min(kCells - 1, row + 1); ++r) {
        for (int c = std::max(0, column - 1); c <= std::min(kCells - 1, column + 1); ++c) {
          const auto there = static_cast<std::size_t>(r * kCells + c);
          // A step aslant is longer: as if it took longer, or ways would prefer it.
          const float longer = r != row && c != column ? kAslant : 1.0F;
          best = std::min(best, next[there] + longer * kSeconds * (1.0F + costs[there]));
        }
      }
      values[here] = best;
    }
  }
  if (is_final_ && end_ >= 0) values[static_cast<std::size_t>(end_)] = values_.back()[static_cast<std::size_t>(end_)];
}

double CrowdField::sample(const Layer& layer, Point2 in_odom) const {
  constexpr double kLast = kCells - 1 - 1e-6;
  const double x = std::clamp((in_odom.x - low_.x) / kCell, 0.0, kLast);
  const double y = std::clamp((in_odom.y - low_.y) / kCell, 0.0, kLast);
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  const double right = x - static_cast<double>(column);
  const double up = y - static_cast<double>(row);
  const std::size_t cell = row * kCells + column;
  return (1.0 - up) *
             ((1.0 - right) * static_cast<double>(layer[cell]) + right * static_cast<double>(layer[cell + 1])) +
         up * ((1.0 - right) * static_cast<double>(layer[cell + kCells]) +
               right * static_cast<double>(layer[cell + kCells + 1]));
}

double CrowdField::value(int layer, Point2 in_odom) const {
  return sample(values_[static_cast<std::size_t>(std::clamp(layer, 0, layers_))], in_odom);
}

double CrowdField::cost(int layer, Point2 in_odom) const {
  return sample(costs_[static_cast<std::size_t>(std::clamp(layer, 0, layers_))], in_odom);
}

std::optional<Point2> CrowdField::way_on(Point2 from, double away) const {
  int cell = cell_at(from);
  if (cell < 0) return std::nullopt;
  const auto centre = [&](int index) { return low_ + Point2{kCell * (index % kCells), kCell * (index / kCells)}; };
  const int start = cell;
  for (std::size_t layer = 0; layer + 1 < values_.size(); ++layer) {
    const Layer& next = values_[layer + 1];
    const Layer& costs = costs_[layer + 1];
    const auto here = static_cast<std::size_t>(cell);
    float best = next[here] + static_cast<float>(kStep) * (1.0F + costs[here]);
    const int row = cell / kCells;
    const int column = cell % kCells;
    for (int r = std::max(0, row - 1); r <= std::min(kCells - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(kCells - 1, column + 1); ++c) {
        const auto there = static_cast<std::size_t>(r * kCells + c);
        const float longer = r != row && c != column ? kAslant : 1.0F;
        const float value = next[there] + longer * static_cast<float>(kStep) * (1.0F + costs[there]);
        if (value >= best) continue;
        best = value;
        cell = r * kCells + c;
      }
    }
    if (distance(centre(cell), from) >= away) return centre(cell);
  }
  if (cell == start) return std::nullopt;
  return centre(cell);
}

}  // namespace docent
