#include "docent/simulator/world/world_picture.h"

#include <gtest/gtest.h>

namespace docent::simulator {
namespace {

TEST(WorldPicture, ShowsEachKindWhereItStands) {
  World world;
  world.floor = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
  world.operating_area = {{0.5, 0.5}, {9.5, 0.5}, {9.5, 9.5}, {0.5, 9.5}};
  world.home = {9.0, 9.0};
  const auto box = [](double x, double y) -> Polygon {
    return {{x, y}, {x + 1.0, y}, {x + 1.0, y + 1.0}, {x, y + 1.0}};
  };
  world.solids = {{"w", SolidKind::wall, box(1.0, 1.0), 0.0, 3.0, false},
                  {"f", SolidKind::furniture, box(3.0, 1.0), 0.0, 1.0, false},
                  {"g", SolidKind::glass, box(5.0, 1.0), 0.0, 2.0, false},
                  {"s", SolidKind::stairs, box(7.0, 1.0), 0.0, 0.0, false}};
  const MapView view{{-1.0, -1.0}, {11.0, 11.0}, 20.0};
  const Image image = draw_world(world, view);
  const auto at = [&](double x, double y) {
    const Point2 pixel = view.pixel({x, y});
    return image.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  };
  const std::vector<Color> shades{at(-0.5, -0.5), at(2.5, 5.0), at(1.2, 1.2), at(3.2, 1.2), at(5.2, 1.2), at(7.2, 1.2)};
  for (std::size_t i = 0; i < shades.size(); ++i) {
    for (std::size_t k = i + 1; k < shades.size(); ++k) EXPECT_FALSE(shades[i] == shades[k]) << i << " and " << k;
  }
  EXPECT_EQ(at(2.5, 5.0), colors::kFloor);
}

}  // namespace
}  // namespace docent::simulator
