#include "docent/simulator/world/world_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"

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
  pictures::Axes axes = pictures::Axes::metres({-1.0, -1.0}, {11.0, 11.0}, 120.0);
  draw_world(axes, world);
  const pictures::Image image = pictures::raster_inside(axes);
  const auto at = [&](double x, double y) {
    const Point2 pixel = pictures::kPixelsPerPoint * axes.page({x, y});
    return image.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
  };
  const std::vector<pictures::Color> shades{at(-0.5, -0.5), at(2.5, 5.0), at(1.2, 1.2),
                                            at(3.2, 1.2),   at(5.2, 1.2), at(7.2, 1.2)};
  for (std::size_t i = 0; i < shades.size(); ++i) {
    for (std::size_t k = i + 1; k < shades.size(); ++k) EXPECT_FALSE(shades[i] == shades[k]) << i << " and " << k;
  }
  EXPECT_EQ(at(2.5, 5.0), pictures::colors::kFloor);
}

TEST(WorldPicture, ItsLegendHasWhatIsThereAndNothingElse) {
  World world;
  world.floor = world.operating_area = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}};
  world.solids = {{"s", SolidKind::stairs, {{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}}, 0.0, 0.0, false}};
  const auto path = std::filesystem::temp_directory_path() / ("docent_world_" + std::to_string(getpid()) + ".svg");
  ASSERT_TRUE(draw_world(world).save(path));
  const std::string svg = read_file(path).value();
  std::filesystem::remove(path);
  for (const char* word : {"x [m], y [m]", "stairs", "home"}) EXPECT_NE(svg.find(word), std::string::npos) << word;
  for (const char* word : {"glass", "plate", "entrance", "furniture"})
    EXPECT_EQ(svg.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace docent::simulator
