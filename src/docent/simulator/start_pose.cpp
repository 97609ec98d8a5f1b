#include "docent/simulator/start_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "docent/grid/clearance.h"

namespace docent::simulator {
namespace {

constexpr double kCell = 0.2;           // [m]
constexpr double kPassable = 0.38;      // [m] clearance that a way needs at the very least
constexpr double kRobotRadius = 0.265;  // [m]
constexpr double kUnsure = 0.08;        // [m] by which maps draw things elsewhere, and half a cell of a planner

/// A lattice of cells over the operating area.
struct Lattice {
  Point2 low;
  int columns = 0;
  int rows = 0;
  [[nodiscard]] Point2 centre_of(int cell) const {
    return low + Point2{(cell % columns + 0.5) * kCell, (cell / columns + 0.5) * kCell};
  }
};

Lattice lattice_over(const Polygon& area) {
  Point2 low = area.front();
  Point2 high = area.front();
  for (const Point2 corner : area) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  return {low, static_cast<int>((high.x - low.x) / kCell) + 1, static_cast<int>((high.y - low.y) / kCell) + 1};
}

/// The open cells that hang together with the one nearest to home; each becomes 0 in `open`.
std::vector<int> cells_from(Point2 home, const Lattice& lattice, std::vector<char>& open) {
  const int count = lattice.columns * lattice.rows;
  int nearest = -1;
  for (int cell = 0; cell < count; ++cell) {
    if (open[static_cast<std::size_t>(cell)] == 0) continue;
    if (nearest < 0 || distance(lattice.centre_of(cell), home) < distance(lattice.centre_of(nearest), home))
      nearest = cell;
  }
  if (nearest < 0) return {};
  std::vector<int> cells;
  std::vector<int> stack{nearest};
  open[static_cast<std::size_t>(nearest)] = 0;
  while (!stack.empty()) {
    const int cell = stack.back();
    stack.pop_back();
    cells.push_back(cell);
    const int column = cell % lattice.columns;
    for (const int next : {column > 0 ? cell - 1 : -1, column + 1 < lattice.columns ? cell + 1 : -1,
                           cell - lattice.columns, cell + lattice.columns}) {
      if (next < 0 || next >= count || open[static_cast<std::size_t>(next)] == 0) continue;
      open[static_cast<std::size_t>(next)] = 0;
      stack.push_back(next);
    }
  }
  return cells;
}

/// Where a planner surely leads a robot through: cells with the room that it asks for, whatever its map errs.
std::vector<char> drivable(const World& world, const WalkableFloor& floor, const Polygon& area,
                           const Lattice& lattice) {
  constexpr Clearance kNeeded{};
  std::vector<const Solid*> hazards;
  for (const Solid& solid : world.solids) {
    if (!is_seen_by_laser(solid)) hazards.push_back(&solid);
  }
  std::vector<char> open(static_cast<std::size_t>(lattice.columns * lattice.rows), 0);
  for (int cell = 0; cell < lattice.columns * lattice.rows; ++cell) {
    const Point2 centre = lattice.centre_of(cell);
    open[static_cast<std::size_t>(cell)] =
        floor.clearance(centre) >= kRobotRadius + kNeeded.walls + kUnsure && contains(area, centre) &&
        outline_distance(area, centre) >= kNeeded.border + kUnsure &&
        std::none_of(hazards.begin(), hazards.end(), [&](const Solid* hazard) {
          return distance(hazard->polygon, centre) < kRobotRadius + kNeeded.hazards + kUnsure;
        });
  }
  return open;
}

}  // namespace

std::optional<Pose2> random_start(const World& world, const WalkableFloor& floor, Rng& rng, double clearance,
                                  Point2 from, double away) {
  const Polygon& area = world.operating_area.size() >= 3 ? world.operating_area : world.floor;
  if (area.size() < 3) return std::nullopt;
  const Lattice lattice = lattice_over(area);
  std::vector<char> open(static_cast<std::size_t>(lattice.columns * lattice.rows), 0);
  for (int cell = 0; cell < lattice.columns * lattice.rows; ++cell) {
    const Point2 centre = lattice.centre_of(cell);
    open[static_cast<std::size_t>(cell)] = floor.clearance(centre) >= kPassable && contains(area, centre);
  }
  std::vector<int> places = cells_from(world.home, lattice, open);
  std::erase_if(places, [&](int cell) {
    const Point2 centre = lattice.centre_of(cell);
    return floor.clearance(centre) < clearance || outline_distance(area, centre) < clearance ||
           distance(centre, from) < away;
  });
  std::vector<char> open_to_drive = drivable(world, floor, area, lattice);
  std::vector<char> is_reached(open_to_drive.size(), 0);
  for (const int cell : cells_from(world.home, lattice, open_to_drive)) is_reached[static_cast<std::size_t>(cell)] = 1;
  while (!places.empty()) {
    const auto pick = static_cast<std::ptrdiff_t>(rng.integer(0, static_cast<std::int64_t>(places.size()) - 1));
    const int cell = places[static_cast<std::size_t>(pick)];
    if (is_reached[static_cast<std::size_t>(cell)] != 0) {
      const Point2 place = lattice.centre_of(cell);
      return Pose2{place.x, place.y, Angle::radians(rng.uniform(-std::numbers::pi, std::numbers::pi))};
    }
    places.erase(places.begin() + pick);
  }
  return std::nullopt;
}

}  // namespace docent::simulator
