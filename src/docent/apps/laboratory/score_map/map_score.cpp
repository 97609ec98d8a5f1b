#include "docent/apps/laboratory/score_map/map_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/apps/laboratory/score_map/reachable_floor.h"
#include "docent/mapping/scan_matching/correlative_matcher.h"
#include "docent/mapping/scan_matching/point_sweep.h"

namespace docent::apps::score_map_command {
namespace {

constexpr double kGhost = 0.3;  // [m]

/// The true outlines, and distances from them on a fine grid.
class Structure {
 public:
  explicit Structure(const simulator::World& world) {
    constexpr double kStep = 0.02;  // [m]
    for (const simulator::Solid& solid : world.solids) {
      const bool is_seen = solid.bottom <= simulator::kLaserHeight && solid.top >= simulator::kLaserHeight;
      for (const Segment& side : sides(solid.polygon)) {
        const double length = distance(side.a, side.b);
        for (double d = 0.0; d < length; d += kStep) {
          const Point2 at = side.a + (d / length) * (side.b - side.a);
          points_.push_back(at);
          if (is_seen) seen_.push_back(at);
        }
      }
    }
    constexpr double kMargin = 1.0;  // [m]
    Point2 low = points_.front();
    Point2 high = low;
    for (const Point2 p : points_) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    frame_.resolution = kStep;
    frame_.origin = {low.x - kMargin, low.y - kMargin};
    frame_.columns = static_cast<int>((high.x - low.x + 2.0 * kMargin) / kStep) + 1;
    frame_.rows = static_cast<int>((high.y - low.y + 2.0 * kMargin) / kStep) + 1;
    std::vector<bool> is_outline(frame_.size(), false);
    for (const Point2 p : points_) is_outline[frame_.index(frame_.cell_at(p))] = true;
    distances_ = distance_transform(frame_, is_outline);
  }
  /// [m] to the nearest outline; a metre outside of the building.
  [[nodiscard]] double distance_from(Point2 at) const {
    const CellIndex cell = frame_.cell_at(at);
    return frame_.holds(cell) ? static_cast<double>(distances_[frame_.index(cell)]) : 1.0;
  }
  [[nodiscard]] std::span<const Point2> points() const { return points_; }
  [[nodiscard]] std::span<const Point2> seen() const { return seen_; }  ///< what lasers can see, at their height

 private:
  std::vector<Point2> points_;
  std::vector<Point2> seen_;
  GridFrame frame_;
  std::vector<float> distances_;
};

std::vector<Point2> occupied_cells(const OccupancyGrid& map) {
  std::vector<Point2> cells;
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      if (map.is_occupied({column, row})) cells.push_back(map.frame.centre({column, row}));
    }
  }
  return cells;
}

double misfit(const Structure& structure, std::span<const Point2> cells, const Pose2& world_from_map) {
  double sum = 0.0;
  for (const Point2 cell : cells) sum += std::min(kGhost, structure.distance_from(world_from_map * cell));
  return sum / static_cast<double>(cells.size());
}

/// Steps along each axis, ever smaller, as long as the misfit falls.
Pose2 finely_laid(const Structure& structure, std::span<const Point2> cells, Pose2 pose) {
  double least = misfit(structure, cells, pose);
  for (double step = 0.16; step > 0.001; step *= 0.5) {
    for (bool is_better = true; is_better;) {
      is_better = false;
      for (const Pose2& by : {Pose2{step, 0, {}}, Pose2{-step, 0, {}}, Pose2{0, step, {}}, Pose2{0, -step, {}},
                              Pose2{0, 0, Angle::radians(0.1 * step)}, Pose2{0, 0, Angle::radians(-0.1 * step)}}) {
        const Pose2 tried = pose * by;
        const double now = misfit(structure, cells, tried);
        if (now >= least) continue;
        least = now;
        pose = tried;
        is_better = true;
      }
    }
  }
  return pose;
}

/// Of the surfaces that lasers can see and that border on floor which the map calls free, those it has.
double found_share(const Structure& structure, const OccupancyGrid& map, const Pose2& world_from_map) {
  constexpr double kNear = 0.15;  // [m]
  const Pose2 map_from_world = inverse(world_from_map);
  const int reach = static_cast<int>(std::lround(kNear / map.frame.resolution));
  std::size_t bordering = 0;
  std::size_t found = 0;
  for (const Point2 at : structure.seen()) {
    const CellIndex cell = map.frame.cell_at(map_from_world * at);
    bool is_free = false;
    bool is_occupied = false;
    for (int row = cell.row - reach; row <= cell.row + reach; ++row) {
      for (int column = cell.column - reach; column <= cell.column + reach; ++column) {
        is_free = is_free || map.is_free({column, row});
        is_occupied = is_occupied || map.is_occupied({column, row});
      }
    }
    bordering += is_free ? 1U : 0U;
    found += is_free && is_occupied ? 1U : 0U;
  }
  return bordering == 0 ? 0.0 : static_cast<double>(found) / static_cast<double>(bordering);
}

void measure_cover(const simulator::World& world, const Structure& structure, const OccupancyGrid& map,
                   MapScore& score) {
  constexpr double kBeside = 0.1;  // [m]: floor so near to a wall may lie in the wall's cell
  const ReachableFloor floor = reachable_floor(world);
  const Pose2 map_from_world = inverse(score.world_from_map);
  const auto covered = std::count_if(floor.cells.begin(), floor.cells.end(), [&](Point2 at) {
    const CellIndex cell = map.frame.cell_at(map_from_world * at);
    return map.is_free(cell) || (map.is_occupied(cell) && structure.distance_from(at) <= kBeside);
  });
  score.floor = static_cast<double>(floor.cells.size()) * floor.step * floor.step;
  score.covered = floor.cells.empty() ? 0.0 : static_cast<double>(covered) / static_cast<double>(floor.cells.size());
}

}  // namespace

Result<MapScore> score_map(const OccupancyGrid& map, const simulator::World& world) {
  const std::vector<Point2> cells = occupied_cells(map);
  if (cells.empty()) return fail("the map holds nothing occupied");
  const Structure structure{world};
  const mapping::MatchGrid grid{mapping::thinned_points(structure.seen(), 0.1), {0.2, 0.3, 8}};
  // About the middles of both: then the window is small.
  Point2 middle;
  for (const Point2 cell : cells) middle = middle + (1.0 / static_cast<double>(cells.size())) * cell;
  Point2 true_middle;
  for (const Point2 p : structure.seen())
    true_middle = true_middle + (1.0 / static_cast<double>(structure.seen().size())) * p;
  std::vector<Point2> query;
  for (const Point2 cell : mapping::thinned_points(cells, 0.4)) query.push_back(cell - middle);
  const auto coarse = mapping::best_match(grid, query, {true_middle.x, true_middle.y, {}},
                                          {.reach = 20.0, .turn = std::numbers::pi}, 0.3);
  if (!coarse) return fail("the map fits nowhere onto the world");
  MapScore score;
  score.world_from_map = finely_laid(structure, cells, coarse->reference_from_sweep * Pose2{-middle.x, -middle.y, {}});
  score.occupied = cells.size();
  score.free = static_cast<std::size_t>(std::count(map.cells.begin(), map.cells.end(), OccupancyGrid::kFree));
  std::vector<double> errors;
  for (const Point2 cell : cells) {
    const double away = structure.distance_from(score.world_from_map * cell);
    if (away > kGhost) {
      ++score.ghosts;
    } else {
      errors.push_back(away);
    }
  }
  if (errors.empty()) return fail("the map fits nowhere onto the world");
  std::sort(errors.begin(), errors.end());
  for (const double error : errors) score.wall_error += error / static_cast<double>(errors.size());
  score.wall_error_p95 = errors[static_cast<std::size_t>(0.95 * static_cast<double>(errors.size() - 1))];
  score.found = found_share(structure, map, score.world_from_map);
  measure_cover(world, structure, map, score);
  return score;
}

}  // namespace docent::apps::score_map_command
