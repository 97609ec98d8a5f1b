#include "docent/simulator/sensing/camera/renderer.h"

#include <gtest/gtest.h>

#include "docent/simulator/sensing/camera/figures.h"

namespace docent::simulator {
namespace {

constexpr int kSide = 64;  // [pixels]

/// A room of 10 x 10 m with a red thing in its middle, as a wall would stand there or not.
World room(bool has_wall) {
  World world;
  world.floor = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
  world.operating_area = world.floor;
  if (has_wall) world.solids.push_back({"screen", SolidKind::wall, {{4.0, 3.0}, {4.2, 3.0}, {4.2, 7.0}, {4.0, 7.0}}});
  return world;
}

Lens lens_at(Vec3 eye, double pan, double tilt) { return {eye, pan, tilt, 1.0, kSide, kSide}; }

class RendererTest : public ::testing::Test {
 protected:
  Renderer renderer_;
  Mesh figures_;
  void stand(Point2 at) { add_limb(figures_, lifted(at, 0.0), lifted(at, 2.0), 0.3, 0.3, {{0.8F, 0.0F, 0.0F}}); }
  static bool is_red(pictures::Color color) { return color.red > 2 * std::max(color.green, color.blue) + 20; }
  /// The middle column and row of what is red; nullopt: nothing is.
  static std::optional<Point2> middle_of_red(const pictures::Image& image) {
    Point2 sum;
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (is_red(image.at(x, y))) {
          sum = sum + Point2{x + 0.5, y + 0.5};
          ++count;
        }
    if (count == 0) return std::nullopt;
    return (1.0 / count) * sum;
  }
};

TEST_F(RendererTest, ShowsAThingWhereThePinholeHasIt) {
  renderer_.set_furnishing(furnish(room(false)));
  stand({8.0, 6.0});
  renderer_.set_figures(figures_);
  const auto ahead = middle_of_red(renderer_.draw(lens_at({2.0F, 6.0F, 1.0F}, 0.0, 0.0)));
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->x, kSide / 2.0, 1.0);
  EXPECT_NEAR(ahead->y, kSide / 2.0, 1.0);
  // Turned to the left by 0.2 rad it moves to the right by the focal length times tan 0.2.
  const double focal = 0.5 * kSide / std::tan(0.5);
  const auto turned = middle_of_red(renderer_.draw(lens_at({2.0F, 6.0F, 1.0F}, 0.2, 0.0)));
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->x, kSide / 2.0 + focal * std::tan(0.2), 1.5);
  const auto raised = middle_of_red(renderer_.draw(lens_at({2.0F, 6.0F, 1.0F}, 0.0, 0.2)));
  ASSERT_TRUE(raised);
  EXPECT_NEAR(raised->y, kSide / 2.0 + focal * std::tan(0.2), 2.5);
}

TEST_F(RendererTest, AWallHidesWhatIsBehindIt) {
  stand({8.0, 5.0});
  renderer_.set_furnishing(furnish(room(true)));
  renderer_.set_figures(figures_);
  EXPECT_FALSE(middle_of_red(renderer_.draw(lens_at({1.0F, 5.0F, 1.0F}, 0.0, 0.0))));
  EXPECT_TRUE(middle_of_red(renderer_.draw(lens_at({6.0F, 5.0F, 1.0F}, 0.0, 0.0))));
  renderer_.set_furnishing(furnish(room(false)));
  EXPECT_TRUE(middle_of_red(renderer_.draw(lens_at({1.0F, 5.0F, 1.0F}, 0.0, 0.0))));
}

TEST_F(RendererTest, ThrowsAShadowOnTheFloor) {
  const auto darkest = [&] {
    const auto image = renderer_.draw(lens_at({5.0F, 5.0F, 2.9F}, 0.0, -1.5));
    int least = 255;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        if (!is_red(image.at(x, y))) least = std::min<int>(least, image.at(x, y).green);
    return least;
  };
  renderer_.set_furnishing(furnish(room(false)));
  renderer_.set_figures(figures_);
  const int bright = darkest();
  add_level(figures_, {{4.5, 4.5}, {5.5, 4.5}, {5.5, 5.5}, {4.5, 5.5}}, 1.0, true, {{0.8F, 0.0F, 0.0F}});
  renderer_.set_figures(figures_);
  EXPECT_LT(darkest(), bright - 20);
}

TEST_F(RendererTest, TheSameSceneGivesTheSamePixels) {
  const auto draw = [] {
    Renderer renderer;
    renderer.set_furnishing(furnish(room(true)));
    Mesh mesh;
    for (std::uint32_t i = 0; i < 20; ++i)
      add_figure(mesh, {i, {1.0 + 0.4 * i, 5.0, Angle::radians(i)}, 1.7, 0.1 * i, true});
    add_robot(mesh, {{5.0, 2.0, Angle{}}});
    renderer.set_figures(std::move(mesh));
    const auto image = renderer.draw(lens_at({0.5F, 0.5F, 2.5F}, 0.8, -0.3));
    return std::vector<std::uint8_t>{image.bytes().begin(), image.bytes().end()};
  };
  EXPECT_EQ(draw(), draw());
}

TEST_F(RendererTest, NamesTheExhibits) {
  World world = room(false);
  world.exhibits = {"wankel"};
  world.attractions = {{"wankel", {5.0, 5.0}}, {"bench", {2.0, 2.0}}};
  const Furnishing made = furnish(world);
  ASSERT_EQ(made.posters.size(), 1U) << "a bench has no sign";
  const auto bytes = made.posters.front().bytes();
  EXPECT_GT(std::count(bytes.begin(), bytes.end(), 255), 2000) << "white letters";
}

}  // namespace
}  // namespace docent::simulator
