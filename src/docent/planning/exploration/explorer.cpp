#include "docent/planning/exploration/explorer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/planning/value_iteration/value_iteration.h"

namespace docent::planning {
namespace {

constexpr int kEnough = std::numeric_limits<int>::max();
constexpr double kSamePlace = 1.0;  ///< [m] from the last goal: still the same thing to explore

bool is_unknown(std::int8_t cell) { return cell < 0; }

bool borders_on_free(const OccupancyGrid& map, CellIndex cell) {
  for (int row = -1; row <= 1; ++row)
    for (int column = -1; column <= 1; ++column)
      if (map.is_free({cell.column + column, cell.row + row})) return true;
  return false;
}

/// Something stands between the two.
bool is_hidden(const OccupancyGrid& map, Point2 from, Point2 to) {
  const double length = distance(from, to);
  const double step = 0.5 * map.frame.resolution;
  for (double d = 0.0; d < length; d += step) {
    if (map.is_occupied(map.frame.cell_at(from + (d / length) * (to - from)))) return true;
  }
  return false;
}

/// [m] from the place to the middle of what is occupied, up to `most`: of the map itself, whose cells are finer than
/// those that ways are planned over.
double fine_clearance(const OccupancyGrid& map, Point2 place, double most) {
  const CellIndex centre = map.frame.cell_at(place);
  const int reach = static_cast<int>(std::ceil(most / map.frame.resolution));
  double least = most;
  for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
    for (int column = centre.column - reach; column <= centre.column + reach; ++column) {
      if (map.is_occupied({column, row})) least = std::min(least, distance(map.frame.centre({column, row}), place));
    }
  }
  return least;
}

/// The open cell nearest to the robot, which may stand a little nearer to something than it plans to.
std::optional<CellIndex> start_cell(const ValueIteration& planner, Point2 robot) {
  constexpr double kNear = 0.5;  // [m]
  const GridFrame& frame = planner.frame();
  const CellIndex centre = frame.cell_at(robot);
  const int reach = static_cast<int>(std::ceil(kNear / frame.resolution));
  std::optional<CellIndex> best;
  double least = kNear;
  for (int row = centre.row - reach; row <= centre.row + reach; ++row) {
    for (int column = centre.column - reach; column <= centre.column + reach; ++column) {
      const CellIndex cell{column, row};
      if (!frame.holds(cell) || planner.cost(cell) == ValueIteration::kClosed) continue;
      const double off = distance(frame.centre(cell), robot);
      if (off >= least) continue;
      least = off;
      best = cell;
    }
  }
  return best;
}

}  // namespace

Result<void> ExplorerParams::validate() const {
  if (coarsening < 1 || coarsening > 20) return fail("coarsening must be in 1..20");
  if (!(robot_radius > 0.0)) return fail("robot_radius must be > 0");
  if (!(wall_margin >= 0.0)) return fail("wall_margin must be >= 0");
  if (!(tight_margin >= 0.0 && tight_margin <= wall_margin)) return fail("0 <= tight_margin <= wall_margin must hold");
  if (!(tight_reach >= 0.0)) return fail("tight_reach must be >= 0");
  if (!(tight_cost >= 0.0)) return fail("tight_cost must be >= 0");
  if (!(comfort >= 0.0)) return fail("comfort must be >= 0");
  if (!(comfort_cost >= 0.0)) return fail("comfort_cost must be >= 0");
  if (!(home_cost >= 0.0)) return fail("home_cost must be >= 0");
  if (!(switch_cost >= 0.0)) return fail("switch_cost must be >= 0");
  if (!(open_reach > 0.0)) return fail("open_reach must be > 0");
  if (!(open_cost >= 0.0)) return fail("open_cost must be >= 0");
  if (!(border_margin >= 0.0 && hazard_margin >= 0.0)) return fail("border_margin and hazard_margin must be >= 0");
  if (!(doubt_sigmas >= 0.0 && doubt_free >= 0.0 && most_doubt >= 0.0)) return fail("doubt must be >= 0");
  if (!(gap >= 0.0)) return fail("gap must be >= 0");
  if (!(close > 0.0)) return fail("close must be > 0");
  if (close_looks < 1) return fail("close_looks must be >= 1");
  return {};
}

Explorer::Explorer(ExplorerParams params, std::vector<Polygon> hazards, Polygon area)
    : params_{params}, area_{std::move(area)} {
  for (Polygon& outline : hazards) {
    Hazard hazard{std::move(outline), {}, 0.0};
    for (const Point2 corner : hazard.outline)
      hazard.centre = hazard.centre + (1.0 / static_cast<double>(hazard.outline.size())) * corner;
    for (const Point2 corner : hazard.outline) hazard.radius = std::max(hazard.radius, distance(hazard.centre, corner));
    hazards_.push_back(std::move(hazard));
  }
}

bool Explorer::is_given_up(Point2 place, double within) const {
  return std::any_of(given_up_.begin(), given_up_.end(), [&](Point2 p) { return distance(p, place) < within; }) ||
         std::any_of(forgone_.begin(), forgone_.end(),
                     [&](const Disc& disc) { return distance(disc.centre, place) < disc.radius; });
}

Explorer::Margins Explorer::margins(const OccupancyGrid& map, std::optional<Point2> robot, bool is_squeezing) const {
  constexpr double kAway = 0.02;  // [m] nearer than the robot stands
  const double more = std::clamp(params_.doubt_sigmas * doubt_ - params_.doubt_free, 0.0, params_.most_doubt);
  Margins result;
  result.far = {is_squeezing ? params_.tight_margin : params_.wall_margin,
                params_.hazard_margin + (is_squeezing ? 0.0 : more), params_.border_margin};
  result.near = result.far;
  result.most_hazards = std::numeric_limits<double>::infinity();
  const auto near_to = [&](double there, double usual) {
    return std::clamp(there - kAway, std::min(usual, params_.tight_margin), usual);
  };
  if (robot) {
    const double keeps = params_.robot_radius + params_.wall_margin + 2.0 * kAway;
    result.near.walls = near_to(fine_clearance(map, *robot, keeps) - params_.robot_radius, result.near.walls);
    double nearest = result.most_hazards;
    for (const Hazard& hazard : hazards_) nearest = std::min(nearest, distance(hazard.outline, *robot));
    result.most_hazards = std::max(params_.tight_margin, nearest - params_.robot_radius - kAway);
  }
  if (robot && !area_.empty()) {
    const double there = contains(area_, *robot) ? outline_distance(area_, *robot) : 0.0;
    result.near.border = std::min(result.near.border, std::max(0.0, there - params_.tight_margin));
  }
  return result;
}

bool Explorer::is_clear_of_marks(Point2 place, double hazards, double most_hazards) const {
  constexpr double kRounding = 1e-6;   // [m]
  constexpr double kMostMargin = 5.0;  // [m]: whoever knows less of its marks stays where it is
  if (mark_margin_ && !hazards_.empty()) hazards += std::min(kMostMargin, mark_margin_(place));
  const double keep = params_.robot_radius + std::min(hazards, most_hazards);
  for (const Hazard& hazard : hazards_) {
    if (distance(hazard.centre, place) > hazard.radius + keep + kRounding) continue;
    if (distance(hazard.outline, place) < keep) return false;
  }
  return true;
}

bool Explorer::is_blocked(Point2 place) const {
  return std::any_of(blocked_.begin(), blocked_.end(),
                     [&](const Disc& disc) { return distance(disc.centre, place) < disc.radius; });
}

StandingRoom::Place Explorer::place_in(const StandingRoom& room, CellIndex cell) const {
  return room.best_in(cell, params_.coarsening, params_.robot_radius + params_.wall_margin - params_.border_margin);
}

/// Of entering a place, as a factor. @param spare  [m] beyond the usual margins @param walls  [m] to the nearest
float Explorer::cost_of(double spare, double walls) const {
  const double discomfort = params_.comfort > 0.0 ? std::clamp(1.0 - spare / params_.comfort, 0.0, 1.0) : 0.0;
  const double openness = std::clamp(walls / params_.open_reach - 1.0, 0.0, 1.0);
  const double extra = params_.comfort_cost * discomfort * discomfort + (spare < 0.0 ? params_.tight_cost : 0.0) +
                       params_.open_cost * openness;
  return static_cast<float>(1.0 + extra);
}

Explorer::Costs Explorer::costs_of(const OccupancyGrid& map, std::optional<Point2> robot, bool is_squeezing) const {
  const double border_reach = params_.border_margin + params_.comfort;
  Costs result{coarsened(map, params_.coarsening), StandingRoom{map, area_, border_reach}, {}, {}, {}, {}};
  const GridFrame& frame = result.coarse.frame;
  result.costs.assign(frame.size(), ValueIteration::kClosed);
  const Margins margins = this->margins(map, robot, is_squeezing);
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex cell{column, row};
      const std::size_t i = frame.index(cell);
      const bool is_free = result.coarse.is_free(cell);
      const bool is_frontier = is_unknown(result.coarse.cells[i]) && borders_on_free(result.coarse, cell);
      if (!(is_free || is_frontier)) continue;
      const bool is_near = robot && distance(*robot, frame.centre(cell)) < params_.tight_reach;
      const Clearance& keep = is_near ? margins.near : margins.far;
      const StandingRoom::Place place = place_in(result.room, cell);
      if (place.border < keep.border) continue;
      const double walls = place.walls - params_.robot_radius;
      const bool is_wide = walls >= (is_free ? keep.walls : params_.wall_margin);
      const bool may_be_wide = is_frontier && place.walls >= params_.gap;
      if (!(is_wide || may_be_wide)) continue;
      const double most = is_near ? margins.most_hazards : std::numeric_limits<double>::infinity();
      if (is_blocked(place.at) || !is_clear_of_marks(place.at, keep.hazards, most)) continue;
      if (is_frontier) {
        (is_wide ? result.frontier : result.gaps).push_back(cell);
        continue;
      }
      const double spare = std::min(walls - params_.wall_margin, place.border - params_.border_margin);
      result.costs[i] = static_cast<float>(frame.resolution) * cost_of(spare, place.walls);
    }
  }
  open_trail(result);
  return result;
}

/// A map whose poses have moved draws a door narrower than it is, or walls double: the robot must not be shut in.
void Explorer::open_trail(Costs& known) const {
  constexpr double kGap = 0.6;  // [m]: it was carried, or its poses have moved
  const GridFrame& frame = known.coarse.frame;
  const double step = 0.5 * frame.resolution;
  for (std::size_t k = 0; k + 1 < trail_.size(); ++k) {
    const double length = distance(trail_[k], trail_[k + 1]);
    if (length > kGap) continue;
    for (double d = 0.0; d < length; d += step) {
      const Point2 at = trail_[k] + (d / length) * (trail_[k + 1] - trail_[k]);
      const CellIndex cell = frame.cell_at(at);
      if (!frame.holds(cell) || !known.coarse.is_free(cell)) continue;
      const std::size_t i = frame.index(cell);
      if (known.costs[i] != ValueIteration::kClosed || is_blocked(at)) continue;
      if (!is_clear_of_marks(at, params_.tight_margin, params_.tight_margin)) continue;
      known.costs[i] = static_cast<float>(frame.resolution) * cost_of(-params_.wall_margin, 0.0);
      known.driven.emplace(i, at);
    }
  }
}

void Explorer::give_up_what_stays_unknown(const OccupancyGrid& coarse, std::span<const CellIndex> frontier,
                                          Point2 robot) {
  const GridFrame& frame = coarse.frame;
  for (const CellIndex cell : frontier) {
    const Point2 place = frame.centre(cell);
    const double off = distance(place, robot);
    if (off >= params_.close && off >= params_.robot_radius + frame.resolution) continue;
    if (is_given_up(place, frame.resolution)) continue;
    const std::pair<int, int> key{static_cast<int>(std::lround(place.x / frame.resolution)),
                                  static_cast<int>(std::lround(place.y / frame.resolution))};
    if (is_hidden(coarse, robot, place)) continue;  // behind a door's frame
    const int looks = off < params_.robot_radius + frame.resolution ? params_.close_looks : ++looked_at_[key];
    if (looks >= params_.close_looks) given_up_.push_back(place);
  }
}

std::vector<CellIndex> Explorer::views_of_gaps(const Costs& known) const {
  const GridFrame& frame = known.coarse.frame;
  const double reach = params_.close - frame.resolution;
  const int cells = static_cast<int>(std::ceil(reach / frame.resolution));
  std::vector<CellIndex> views;
  std::vector<bool> is_listed(frame.size(), false);
  for (const CellIndex gap : known.gaps) {
    const Point2 place = frame.centre(gap);
    if (is_given_up(place, frame.resolution)) continue;
    for (int row = gap.row - cells; row <= gap.row + cells; ++row) {
      for (int column = gap.column - cells; column <= gap.column + cells; ++column) {
        const CellIndex view{column, row};
        if (!frame.holds(view) || known.costs[frame.index(view)] == ValueIteration::kClosed) continue;
        if (is_listed[frame.index(view)] || distance(frame.centre(view), place) > reach) continue;
        if (is_hidden(known.coarse, frame.centre(view), place)) continue;
        is_listed[frame.index(view)] = true;
        views.push_back(view);
      }
    }
  }
  return views;
}

std::vector<Point2> Explorer::places_of(const Costs& known, std::span<const CellIndex> cells) const {
  std::vector<Point2> places;
  for (const CellIndex cell : cells) {
    const auto driven = known.driven.find(known.coarse.frame.index(cell));
    places.push_back(driven != known.driven.end() ? driven->second : place_in(known.room, cell).at);
  }
  return places;
}

std::optional<Exploration> Explorer::next(const OccupancyGrid& map, Point2 robot) {
  Costs known = costs_of(map, robot);
  const GridFrame& frame = known.coarse.frame;
  give_up_what_stays_unknown(known.coarse, known.frontier, robot);
  give_up_what_stays_unknown(known.coarse, known.gaps, robot);
  std::vector<ValueIteration::Goal> goals;
  for (const CellIndex cell : known.frontier) {
    const Point2 place = frame.centre(cell);
    if (is_given_up(place, frame.resolution)) continue;
    known.costs[frame.index(cell)] = static_cast<float>(frame.resolution);
    const bool is_same = !last_ || distance(*last_, place) < kSamePlace;
    const double far = home_ ? params_.home_cost * distance(*home_, place) : 0.0;
    goals.push_back({cell, static_cast<float>(far + (is_same ? 0.0 : params_.switch_cost))});
  }

  ValueIteration planner{frame};
  planner.set_costs(known.costs);
  planner.set_goals(goals);
  const auto start = start_cell(planner, robot);
  if (!start) return std::nullopt;
  if (!planner.settle(*start, kEnough) || planner.descend(*start).empty()) {
    goals.clear();
    for (const CellIndex cell : views_of_gaps(known)) goals.push_back({cell, 0.0F});
    planner.set_goals(goals);
    if (!planner.settle(*start, kEnough)) return std::nullopt;
  }
  Exploration result;
  const std::vector<CellIndex> cells = planner.descend(*start);
  if (cells.empty()) return std::nullopt;
  result.way = places_of(known, cells);
  result.way.back() = frame.centre(cells.back());
  result.cost = static_cast<double>(planner.value(*start));
  result.frontier = goals.size();
  last_ = result.way.back();
  return result;
}

std::vector<Point2> Explorer::way_to(const OccupancyGrid& map, Point2 robot, Point2 goal, bool is_squeezing) const {
  const Costs known = costs_of(map, robot, is_squeezing);
  ValueIteration planner{known.coarse.frame};
  planner.set_costs(known.costs);
  const CellIndex cell = known.coarse.frame.cell_at(goal);
  if (!known.coarse.frame.holds(cell)) return {};
  planner.set_goals(std::vector<ValueIteration::Goal>{{cell}});
  const auto start = start_cell(planner, robot);
  if (!start || !planner.settle(*start, kEnough)) return {};
  return places_of(known, planner.descend(*start));
}

std::vector<Point2> Explorer::way_to_room(const OccupancyGrid& map, Point2 robot) const {
  constexpr double kNear = 2.5;    // [m]
  constexpr double kRoomy = 0.35;  // [m] between centre and border
  constexpr float kEasy = 1.2F;    // times the cost of open floor
  const Costs known = costs_of(map, robot, true);
  const GridFrame& frame = known.coarse.frame;
  std::vector<ValueIteration::Goal> goals;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const CellIndex cell{column, row};
      const Point2 place = frame.centre(cell);
      if (distance(place, robot) > kNear) continue;
      if (known.costs[frame.index(cell)] > kEasy * static_cast<float>(frame.resolution)) continue;
      if (place_in(known.room, cell).border >= kRoomy) goals.push_back({cell});
    }
  }
  ValueIteration planner{frame};
  planner.set_costs(known.costs);
  planner.set_goals(goals);
  const auto start = start_cell(planner, robot);
  if (goals.empty() || !start || !planner.settle(*start, kEnough)) return {};
  return places_of(known, planner.descend(*start));
}

std::vector<Explorer::Unreached> Explorer::unreached(const OccupancyGrid& map) const {
  constexpr double kTogether = 0.5;   // [m] between cells of one group
  constexpr std::size_t kFewest = 3;  // cells: fewer are specks
  const Costs known = costs_of(map, std::nullopt);
  std::vector<Point2> left;
  for (const CellIndex cell : known.frontier) left.push_back(known.coarse.frame.centre(cell));
  std::vector<Unreached> groups;
  while (!left.empty()) {
    std::vector<Point2> group{left.back()};
    left.pop_back();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto near =
          std::partition(left.begin(), left.end(), [&](Point2 p) { return distance(p, group[i]) > kTogether; });
      group.insert(group.end(), near, left.end());
      left.erase(near, left.end());
    }
    if (group.size() < kFewest) continue;
    Point2 sum;
    for (const Point2 p : group) sum = sum + p;
    groups.push_back({(1.0 / static_cast<double>(group.size())) * sum, group.size()});
  }
  std::sort(groups.begin(), groups.end(), [](const Unreached& a, const Unreached& b) { return a.cells > b.cells; });
  return groups;
}

}  // namespace docent::planning
