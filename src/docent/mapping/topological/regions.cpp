#include "docent/mapping/topological/regions.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

namespace docent::mapping {
namespace {

CellIndex cell_of(const GridFrame& frame, std::size_t index) {
  const auto columns = static_cast<std::size_t>(frame.columns);
  return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
}

/// Calls f with each of the eight neighbours of a cell that lie on the grid.
template <class F>
void for_neighbours(const GridFrame& frame, std::size_t cell, const F& f) {
  const auto [column, row] = cell_of(frame, cell);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if ((dx != 0 || dy != 0) && frame.holds({column + dx, row + dy})) f(frame.index({column + dx, row + dy}));
}

/// Cells that hang together and fulfil a condition.
template <class Condition>
std::vector<std::size_t> grow(const GridFrame& frame, std::size_t seed, std::vector<bool>& seen,
                              const Condition& is_part) {
  std::vector<std::size_t> cells{seed};
  seen[seed] = true;
  for (std::size_t next = 0; next < cells.size(); ++next) {
    for_neighbours(frame, cells[next], [&](std::size_t cell) {
      if (seen[cell] || !is_part(cell)) return;
      seen[cell] = true;
      cells.push_back(cell);
    });
  }
  return cells;
}

/// Walls, and all that is not known to be free; furniture that stands free of them is floor.
std::vector<bool> walls_of(const OccupancyGrid& map, double thing) {
  const GridFrame& frame = map.frame;
  std::vector<bool> wall(frame.size());
  for (std::size_t i = 0; i < wall.size(); ++i) wall[i] = map.cells[i] < 0 || map.cells[i] >= 20;
  std::vector<bool> seen(frame.size(), false);
  for (std::size_t i = 0; i < wall.size(); ++i) {
    if (!wall[i] || seen[i]) continue;
    const auto cells = grow(frame, i, seen, [&wall](std::size_t cell) { return wall[cell]; });
    int left = frame.columns, right = 0, low = frame.rows, high = 0;
    for (const std::size_t cell : cells) {
      const auto [column, row] = cell_of(frame, cell);
      left = std::min(left, column);
      right = std::max(right, column);
      low = std::min(low, row);
      high = std::max(high, row);
    }
    const bool at_border = left == 0 || low == 0 || right == frame.columns - 1 || high == frame.rows - 1;
    if (at_border || std::max(right - left, high - low) * frame.resolution > thing) continue;
    for (const std::size_t cell : cells) wall[cell] = false;
  }
  return wall;
}

/// Regions while they grow.
class Merging {
 public:
  explicit Merging(const RegionParams& params, double cell_area) : params_{params}, cell_area_{cell_area} {}

  int found(float clearance) {
    parent_.push_back(static_cast<int>(parent_.size()));
    widest_.push_back(clearance);
    cells_.push_back(0);
    return parent_.back();
  }
  int root(int region) {
    while (parent_[at(region)] != region) region = parent_[at(region)] = parent_[at(parent_[at(region)])];
    return region;
  }
  [[nodiscard]] double area(int root) const { return cells_[at(root)] * cell_area_; }  ///< [m2]
  void add_cell(int region) { ++cells_[at(root(region))]; }
  /// Two regions meet where the floor is so clear [m].
  void meet(int a, int b, float clearance) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (widest_[at(a)] < widest_[at(b)]) std::swap(a, b);
    const bool is_door = 2.0 * static_cast<double>(clearance) <= params_.door &&
                         static_cast<double>(clearance) <= params_.narrower * static_cast<double>(widest_[at(b)]) &&
                         cells_[at(b)] * cell_area_ >= params_.least_area;
    if (is_door) return;
    parent_[at(b)] = a;
    cells_[at(a)] += cells_[at(b)];
  }

 private:
  static std::size_t at(int region) { return static_cast<std::size_t>(region); }
  RegionParams params_;
  double cell_area_;
  std::vector<int> parent_;
  std::vector<float> widest_;
  std::vector<double> cells_;
};

/// Where two regions touch: each place by itself, for two rooms may have two doors.
std::vector<Gap> gaps_of(const Regions& regions) {
  const GridFrame& frame = regions.frame;
  std::vector<std::pair<int, int>> border(frame.size(), {Regions::kNone, Regions::kNone});
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const int own = regions.of[i];
    if (own == Regions::kNone) continue;
    for_neighbours(frame, i, [&](std::size_t cell) {
      const int other = regions.of[cell];
      if (other != Regions::kNone && other != own) border[i] = std::minmax(own, other);
    });
  }
  std::vector<Gap> gaps;
  std::vector<bool> seen(frame.size(), false);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (border[i].first == Regions::kNone || seen[i]) continue;
    const auto cells = grow(frame, i, seen, [&](std::size_t cell) { return border[cell] == border[i]; });
    const auto wider = [&regions](std::size_t a, std::size_t b) { return regions.clearance[a] < regions.clearance[b]; };
    const std::size_t middle = *std::max_element(cells.begin(), cells.end(), wider);
    const CellIndex cell{static_cast<int>(middle % static_cast<std::size_t>(frame.columns)),
                         static_cast<int>(middle / static_cast<std::size_t>(frame.columns))};
    gaps.push_back(
        {border[i].first, border[i].second, frame.centre(cell), 2.0 * static_cast<double>(regions.clearance[middle])});
  }
  return gaps;
}

}  // namespace

Result<void> RegionParams::validate() const {
  if (!(door > 0.0)) return fail("door must be > 0 m");
  if (!(narrower > 0.0 && narrower <= 1.0)) return fail("narrower must be > 0 and <= 1");
  if (!(least_area >= 0.0)) return fail("least_area must be >= 0 m2");
  if (!(thing >= 0.0)) return fail("thing must be >= 0 m");
  return {};
}

Regions cut_into_regions(const OccupancyGrid& map, const RegionParams& params) {
  Regions regions{map.frame, std::vector<int>(map.frame.size(), Regions::kNone), {}, {}, 0};
  const std::vector<bool> wall = walls_of(map, params.thing);
  regions.clearance = distance_transform(map.frame, wall);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < wall.size(); ++i)
    if (!wall[i]) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return regions.clearance[a] > regions.clearance[b]; });
  Merging merging{params, map.frame.resolution * map.frame.resolution};
  for (const std::size_t cell : order) {
    std::size_t best = cell;
    for_neighbours(map.frame, cell, [&](std::size_t other) {
      if (regions.of[other] == Regions::kNone) return;
      if (best != cell) merging.meet(regions.of[best], regions.of[other], regions.clearance[cell]);
      if (best == cell || regions.clearance[other] > regions.clearance[best]) best = other;
    });
    regions.of[cell] = best == cell ? merging.found(regions.clearance[cell]) : regions.of[best];
    merging.add_cell(regions.of[cell]);
  }
  std::map<int, int> numbers;
  for (const std::size_t cell : order) {
    const int root = merging.root(regions.of[cell]);
    const bool is_place = merging.area(root) >= params.least_area;  // what is left is shut in, as between two walls
    regions.of[cell] =
        is_place ? numbers.try_emplace(root, static_cast<int>(numbers.size())).first->second : Regions::kNone;
  }
  regions.count = static_cast<int>(numbers.size());
  regions.gaps = gaps_of(regions);
  return regions;
}

}  // namespace docent::mapping
