#include "docent/apps/laboratory/take_pictures/drawn_hall.h"

#include <cmath>
#include <numbers>
#include <string>

#include "docent/base/random.h"

namespace docent::apps::take_pictures_command {
namespace {

using simulator::SolidKind;

constexpr int kCorners = 12;       // of the opening and of columns
constexpr double kOpening = 0.3;   // of the hall's width: the opening's radius
constexpr double kFromEdge = 2.0;  // [m] columns and exhibits keep off walls

Polygon round(Point2 middle, double radius) {
  Polygon made;
  for (int i = 0; i < kCorners; ++i)
    made.push_back(middle + radius * unit(Angle::radians(2.0 * std::numbers::pi * i / kCorners)));
  return made;
}

Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

}  // namespace

simulator::World drawn_hall(const HallOptions& options) {
  const double l = options.length, w = options.width;
  simulator::World world;
  world.floor = box(0.0, 0.0, l, w);
  world.operating_area = box(0.5, 0.5, l - 0.5, w - 0.5);
  world.entrances = {{1.0, 1.0}};
  world.home = {0.5 * l, 0.5 * w};
  world.ceiling_height = options.height;
  world.ceiling_style.seed = options.seed;
  if (options.opening > 0.0)
    world.ceiling = {{round({0.5 * l, 0.5 * w}, kOpening * w), options.height + options.opening}};
  const double top = options.height + options.opening;
  const auto wall = [&](const char* id, const Polygon& outline) {
    world.solids.push_back({id, SolidKind::wall, outline, 0.0, top});
  };
  wall("west", box(-0.3, -0.3, 0.0, w + 0.3));
  wall("east", box(l, -0.3, l + 0.3, w + 0.3));
  wall("south", box(-0.3, -0.3, l + 0.3, 0.0));
  wall("north", box(-0.3, w, l + 0.3, w + 0.3));
  Rng rng = Rng{options.seed}.stream("hall");
  const auto anywhere = [&] {
    return Point2{rng.uniform(kFromEdge, l - kFromEdge), rng.uniform(kFromEdge, w - kFromEdge)};
  };
  const int columns = static_cast<int>(l * w / 150.0);
  for (int i = 0; i < columns; ++i) {
    const Point2 at = anywhere();
    const double radius = rng.uniform(0.2, 0.4);
    if (world.ceiling_at(at) == options.height)
      world.solids.push_back({"column-" + std::to_string(i), SolidKind::wall, round(at, radius), 0.0, options.height});
  }
  const int exhibits = static_cast<int>(l * w / 80.0);
  for (int i = 0; i < exhibits; ++i) {
    const Point2 at = anywhere();
    const double half = rng.uniform(0.3, 0.7), height = rng.uniform(0.6, 1.9);
    const std::string id = "exhibit-" + std::to_string(i);
    world.solids.push_back(
        {id, SolidKind::furniture, box(at.x - half, at.y - half, at.x + half, at.y + half), 0.0, height});
    world.attractions.push_back({id, at});
  }
  return world;
}

}  // namespace docent::apps::take_pictures_command
