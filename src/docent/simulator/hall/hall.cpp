#include "docent/simulator/hall/hall.h"

#include <algorithm>
#include <string>

namespace docent::simulator {
namespace {

constexpr double kLength = 14.0;  // [m]
constexpr double kWidth = 10.0;   // [m]
constexpr double kThick = 0.2;    // [m] walls
constexpr double kApart = 2.5;    // [m] between two places where people stand round a guide

Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

void add_walls(World& world) {
  const auto add = [&](const char* id, const Polygon& polygon) {
    world.solids.push_back({id, SolidKind::wall, polygon, 0.0, 3.0, false});
  };
  add("wall-south", box(-kThick, -kThick, kLength + kThick, 0.0));
  add("wall-north", box(-kThick, kWidth, kLength + kThick, kWidth + kThick));
  add("wall-west", box(-kThick, 0.0, 0.0, kWidth));
  add("wall-east", box(kLength, 0.0, kLength + kThick, kWidth));
}

void add_cases(World& world, Rng& rng) {
  constexpr double kCase = 0.7;  // [m] from the wall; half the length, too
  for (int i = 0; i < 6; ++i) {
    const double x = 3.0 + 4.0 * (i / 2) + rng.uniform(-0.6, 0.6);
    const bool south = i % 2 == 0;
    const std::string id = "case-" + std::to_string(i + 1);
    const Polygon polygon =
        south ? box(x - kCase, 0.0, x + kCase, kCase) : box(x - kCase, kWidth - kCase, x + kCase, kWidth);
    world.solids.push_back({id, SolidKind::furniture, polygon, 0.0, 1.2, false});
    world.attractions.push_back({id, {x, south ? 0.5 * kCase : kWidth - 0.5 * kCase}, 1.4, 1.0});
  }
}

void add_talks(World& world, Rng& rng) {
  const auto count = rng.integer(2, 4);
  std::vector<Point2> places;
  for (int attempt = 0; attempt < 200 && static_cast<std::int64_t>(places.size()) < count; ++attempt) {
    const Point2 place{rng.uniform(3.0, kLength - 3.0), rng.uniform(2.8, kWidth - 2.8)};
    const bool is_free =
        std::none_of(places.begin(), places.end(), [&](Point2 other) { return distance(other, place) < kApart; });
    if (is_free) places.push_back(place);
  }
  for (const Point2 place : places)
    world.attractions.push_back({"talk-" + std::to_string(world.attractions.size()), place, 1.0, 1.0});
}

}  // namespace

Hall draw_hall(Rng rng) {
  Hall hall;
  hall.world.floor = hall.world.operating_area = box(0.0, 0.0, kLength, kWidth);
  hall.start = {1.3, 0.5 * kWidth, Angle{}};
  hall.goal = {kLength - 1.3, 0.5 * kWidth};
  hall.world.home = hall.start.position();
  hall.world.visitors_per_hour = 0.0;
  add_walls(hall.world);
  add_cases(hall.world, rng);
  add_talks(hall.world, rng);
  return hall;
}

}  // namespace docent::simulator
