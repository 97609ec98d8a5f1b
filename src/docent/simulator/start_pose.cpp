#include "docent/simulator/start_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace docent::simulator {
namespace {

constexpr double kCell = 0.2;       // [m]
constexpr double kPassable = 0.38;  // [m] clearance that the robot's way needs

}  // namespace

std::optional<Pose2> random_start(const World& world, const WalkableFloor& floor, Rng& rng, double clearance,
                                  Point2 from, double away) {
  const Polygon& area = world.operating_area.size() >= 3 ? world.operating_area : world.floor;
  if (area.size() < 3) return std::nullopt;
  Point2 low = area.front();
  Point2 high = area.front();
  for (const Point2 corner : area) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  const int columns = static_cast<int>((high.x - low.x) / kCell) + 1;
  const int rows = static_cast<int>((high.y - low.y) / kCell) + 1;
  const auto centre_of = [&](int cell) {
    return low + Point2{(cell % columns + 0.5) * kCell, (cell / columns + 0.5) * kCell};
  };
  std::vector<char> open(static_cast<std::size_t>(columns * rows), 0);
  int nearest = -1;
  for (int cell = 0; cell < columns * rows; ++cell) {
    const Point2 centre = centre_of(cell);
    if (floor.clearance(centre) < kPassable || !contains(area, centre)) continue;
    open[static_cast<std::size_t>(cell)] = 1;
    if (nearest < 0 || distance(centre, world.home) < distance(centre_of(nearest), world.home)) nearest = cell;
  }
  if (nearest < 0) return std::nullopt;
  std::vector<int> stack{nearest};
  std::vector<int> places;
  open[static_cast<std::size_t>(nearest)] = 0;
  while (!stack.empty()) {
    const int cell = stack.back();
    stack.pop_back();
    const Point2 centre = centre_of(cell);
    if (floor.clearance(centre) >= clearance && outline_distance(area, centre) >= clearance &&
        distance(centre, from) >= away) {
      places.push_back(cell);
    }
    const int column = cell % columns;
    for (const int next :
         {column > 0 ? cell - 1 : -1, column + 1 < columns ? cell + 1 : -1, cell - columns, cell + columns}) {
      if (next < 0 || next >= columns * rows || open[static_cast<std::size_t>(next)] == 0) continue;
      open[static_cast<std::size_t>(next)] = 0;
      stack.push_back(next);
    }
  }
  if (places.empty()) return std::nullopt;
  const auto pick = static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(places.size()) - 1));
  const Point2 place = centre_of(places[pick]);
  return Pose2{place.x, place.y, Angle::radians(rng.uniform(-std::numbers::pi, std::numbers::pi))};
}

}  // namespace docent::simulator
