#include "docent/task_control/office/view_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace docent::task_control {

Result<void> ViewPlanParams::validate() const {
  if (!(near > 0.0 && far > near)) return fail("view.near must be > 0, view.far > near");
  if (!(half_field > 0.0 && half_field < 90.0)) return fail("view.half_field must be in (0, 90)");
  if (!(cell > 0.0 && lattice >= cell)) return fail("view.cell must be > 0, view.lattice >= cell");
  if (headings < 4) return fail("view.headings must be >= 4");
  if (!(clearance > 0.0 && least_gain > 0.0)) return fail("view.clearance and view.least_gain must be > 0");
  if (!(look_costs >= 0.0 && turn_costs >= 0.0)) return fail("view.look_costs and view.turn_costs must be >= 0");
  return {};
}

ViewPlan::ViewPlan(const OccupancyGrid& map, const std::function<bool(Point2)>& is_wanted,
                   const std::function<bool(Point2)>& may_stand, Point2 start, const ViewPlanParams& params)
    : params_{params} {
  const double ratio = map.frame.resolution / params.cell;
  frame_ = {static_cast<int>(std::ceil(map.frame.columns * ratio)), static_cast<int>(std::ceil(map.frame.rows * ratio)),
            params.cell, map.frame.origin};
  std::vector<bool> is_taken(frame_.size(), false), is_known(frame_.size(), false);
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const CellIndex cell = frame_.cell_at(map.frame.centre({column, row}));
      if (!frame_.holds(cell)) continue;
      if (map.is_occupied({column, row})) is_taken[frame_.index(cell)] = true;
      if (map.is_free({column, row})) is_known[frame_.index(cell)] = true;
    }
  }
  is_open_.resize(frame_.size());
  is_wanted_.resize(frame_.size());
  is_seen_.assign(frame_.size(), false);
  can_stand_.resize(frame_.size());
  const int reach = static_cast<int>(std::ceil(params.clearance / params.cell));
  std::vector<bool> is_near(frame_.size(), false);
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const std::size_t i = frame_.index({column, row});
      is_open_[i] = is_known[i] && !is_taken[i];
      if (!is_taken[i]) continue;
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
          if (frame_.holds({column + dx, row + dy}) && std::hypot(dx, dy) * params.cell < params.clearance)
            is_near[frame_.index({column + dx, row + dy})] = true;
    }
  }
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const std::size_t i = frame_.index({column, row});
      const Point2 at = frame_.centre({column, row});
      is_wanted_[i] = is_open_[i] && is_wanted(at);
      can_stand_[i] = is_open_[i] && !is_near[i] && may_stand(at);
    }
  }
  const std::vector<float> ways = ways_from(start);
  for (std::size_t i = 0; i < can_stand_.size(); ++i) can_stand_[i] = can_stand_[i] && std::isfinite(ways[i]);
  const int step = std::max(1, static_cast<int>(std::lround(params.lattice / params.cell)));
  for (int row = 0; row < frame_.rows; row += step) {
    for (int column = 0; column < frame_.columns; column += step) {
      if (!can_stand_[frame_.index({column, row})]) continue;
      Place place{frame_.centre({column, row}), false, {}};
      place.shows.resize(static_cast<std::size_t>(params.headings));
      for (const std::uint32_t cell : around(place.at)) {
        const Angle at = direction(place.at, centre_of(cell));
        for (int k = 0; k < params.headings; ++k)
          if (holds(Angle::degrees(360.0 * k / params.headings), at))
            place.shows[static_cast<std::size_t>(k)].push_back(cell);
      }
      places_.push_back(std::move(place));
    }
  }
}

bool ViewPlan::is_open(Point2 at) const {
  const CellIndex cell = frame_.cell_at(at);
  return frame_.holds(cell) && is_open_[frame_.index(cell)];
}

bool ViewPlan::is_clear(Point2 from, Point2 to) const {
  const double way = distance(from, to);
  const int steps = static_cast<int>(way / (0.5 * params_.cell));
  for (int k = 1; k < steps; ++k)
    if (!is_open(from + (static_cast<double>(k) / steps) * (to - from))) return false;
  return true;
}

bool ViewPlan::holds(Angle heading, Angle at) const {
  return std::abs((at - heading).radians()) <= params_.half_field * std::numbers::pi / 180.0;
}

Point2 ViewPlan::centre_of(std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(frame_.columns);
  return frame_.centre({static_cast<int>(cell % columns), static_cast<int>(cell / columns)});
}

std::vector<std::uint32_t> ViewPlan::around(Point2 at) const {
  std::vector<std::uint32_t> cells;
  const CellIndex middle = frame_.cell_at(at);
  const int reach = static_cast<int>(params_.far / params_.cell) + 1;
  for (int row = middle.row - reach; row <= middle.row + reach; ++row) {
    for (int column = middle.column - reach; column <= middle.column + reach; ++column) {
      if (!frame_.holds({column, row})) continue;
      const std::size_t i = frame_.index({column, row});
      if (!is_wanted_[i]) continue;
      const double away = distance(at, frame_.centre({column, row}));
      if (away >= params_.near && away <= params_.far && is_clear(at, frame_.centre({column, row})))
        cells.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return cells;
}

std::optional<std::size_t> ViewPlan::cell_near(Point2 at) const {
  constexpr double kNear = 0.8;  // [m]: the robot may stand nearer to a wall than a plan would have it
  std::optional<std::size_t> best;
  double least = kNear;
  const CellIndex middle = frame_.cell_at(at);
  const int reach = static_cast<int>(kNear / params_.cell);
  for (int row = middle.row - reach; row <= middle.row + reach; ++row) {
    for (int column = middle.column - reach; column <= middle.column + reach; ++column) {
      if (!frame_.holds({column, row}) || !can_stand_[frame_.index({column, row})]) continue;
      const double away = distance(at, frame_.centre({column, row}));
      if (away < least) least = away, best = frame_.index({column, row});
    }
  }
  return best;
}

std::vector<float> ViewPlan::ways_from(Point2 start) const {
  std::vector<float> ways(frame_.size(), std::numeric_limits<float>::infinity());
  const auto first = cell_near(start);
  if (!first) return ways;
  using Step = std::pair<float, std::size_t>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  ways[*first] = 0.0F;
  open.push({0.0F, *first});
  const int columns = frame_.columns;
  while (!open.empty()) {
    const auto [way, cell] = open.top();
    open.pop();
    if (way > ways[cell]) continue;
    const int column = static_cast<int>(cell) % columns, row = static_cast<int>(cell) / columns;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex other{column + dx, row + dy};
        if (!frame_.holds(other) || !can_stand_[frame_.index(other)]) continue;
        const float longer = way + static_cast<float>(params_.cell * std::hypot(dx, dy));
        if (longer >= ways[frame_.index(other)]) continue;
        ways[frame_.index(other)] = longer;
        open.push({longer, frame_.index(other)});
      }
    }
  }
  return ways;
}

void ViewPlan::see(const Pose2& map_from_base) {
  for (const std::uint32_t cell : around(map_from_base.position()))
    if (holds(map_from_base.theta, direction(map_from_base.position(), centre_of(cell)))) is_seen_[cell] = true;
}

std::optional<Pose2> ViewPlan::next(const Pose2& map_from_base) const {
  const std::vector<float> ways = ways_from(map_from_base.position());
  std::optional<Pose2> best;
  double most = 0.0;
  const double area = params_.cell * params_.cell;
  for (const Place& place : places_) {
    const double way = static_cast<double>(ways[frame_.index(frame_.cell_at(place.at))]);
    if (place.is_given_up || !std::isfinite(way)) continue;
    for (int k = 0; k < params_.headings; ++k) {
      const auto& shows = place.shows[static_cast<std::size_t>(k)];
      const double gain = area * static_cast<double>(std::count_if(
                                     shows.begin(), shows.end(), [&](std::uint32_t cell) { return !is_seen_[cell]; }));
      if (gain < params_.least_gain) continue;
      const Angle heading = Angle::degrees(360.0 * k / params_.headings);
      const double turn = std::abs((heading - map_from_base.theta).radians());
      const double worth = gain / (params_.look_costs + way + params_.turn_costs * turn);
      if (worth <= most) continue;
      most = worth;
      best = Pose2{place.at.x, place.at.y, heading};
    }
  }
  return best;
}

void ViewPlan::give_up(Point2 at) {
  constexpr double kAbout = 0.25;  // [m]
  for (Place& place : places_)
    if (distance(place.at, at) < kAbout) place.is_given_up = true;
}

std::optional<Pose2> ViewPlan::stand_before(Point2 thing, double radius, const Pose2& map_from_base) const {
  const std::vector<float> ways = ways_from(map_from_base.position());
  constexpr int kSides = 24;
  constexpr std::array kFurther{1.0, 1.2, 1.45};
  std::optional<Pose2> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double further : kFurther) {
    for (int k = 0; k < kSides; ++k) {
      const Point2 at = thing + further * radius * unit(Angle::degrees(360.0 * k / kSides));
      const CellIndex cell = frame_.cell_at(at);
      if (!frame_.holds(cell)) continue;
      const auto way = static_cast<double>(ways[frame_.index(cell)]);
      const bool is_given_up = std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
        return place.is_given_up && distance(place.at, at) < params_.lattice;
      });
      if (!(way < least) || is_given_up || !is_clear(at, thing)) continue;
      least = way;
      best = Pose2{at.x, at.y, direction(at, thing)};
    }
    if (best) break;
  }
  return best;
}

double ViewPlan::seen_share() const {
  std::vector<bool> can_be_seen(is_seen_.size(), false);
  for (const Place& place : places_)
    for (const auto& shows : place.shows)
      for (const std::uint32_t cell : shows) can_be_seen[cell] = true;
  double seen = 0.0, all = 0.0;
  for (std::size_t i = 0; i < is_seen_.size(); ++i) {
    all += can_be_seen[i] ? 1.0 : 0.0;
    seen += can_be_seen[i] && is_seen_[i] ? 1.0 : 0.0;
  }
  return all > 0.0 ? seen / all : 1.0;
}

}  // namespace docent::task_control
