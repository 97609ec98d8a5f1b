#include "docent/simulator/sensing/camera/traced_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"
#include "docent/simulator/sensing/camera/hall_for_test.h"
#include "docent/simulator/sensing/camera/renderer.h"

/// Where pictures have things, held against where they are.
namespace docent::simulator {
namespace {

/// The middle of what is darker than its plain surroundings.
Point2 middle_of_dark(const RawPicture& raw) {
  Point2 sum;
  double weight = 0.0;
  for (int y = 0; y < raw.height; ++y)
    for (int x = 0; x < raw.width; ++x) {
      const auto at = static_cast<std::size_t>(y * raw.width + x);
      const double dark = std::max(0.0, 0.45 - static_cast<double>(raw.light[at].green));
      if (dot(raw.where[at], raw.where[at]) == 0.0F) continue;
      sum = sum + dark * Point2{x + 0.5, y + 0.5};
      weight += dark;
    }
  return (1.0 / weight) * sum;
}

TEST(TracedScene, HeightsShowByParallaxFromTwoPlaces) {
  World world = wide_hall();
  world.marks = {{"low", 0, {10.0, 15.0}, 3.49, {}, -kUp, 0.4}, {"high", 0, {30.0, 15.0}, 18.49, {}, -kUp, 2.0}};
  Renderer renderer;
  renderer.set_furnishing(furnish(world));
  const LensModel lens = plain_lens(320, 240, 1.0);
  const RayTable table{lens};
  for (const Mark& mark : world.marks) {
    const auto seen_from = [&](double ahead) {
      const Pose2 base{mark.position.x + ahead, mark.position.y, Angle{}};
      return middle_of_dark(renderer.expose(viewpoint_of({.x = 0.0, .y = 0.0, .z = 1.3, .tilt = kUp}, base), table));
    };
    const double base = 0.15 * mark.height;  // [m]
    const double shift = std::abs(seen_from(-base).y - seen_from(base).y);
    const double height = 1.3 + lens.focal_x * 2.0 * base / shift;
    EXPECT_NEAR(height, mark.height, 0.01 * mark.height) << mark.id;
  }
}

TEST(TracedScene, ThePartsOfTheCeilingAreAtTheirHeights) {
  Renderer renderer;
  renderer.set_furnishing(furnish(wide_hall()));
  const RayTable table{plain_lens(64, 64, 1.0)};
  const auto above = [&](double x) {
    const auto probed =
        renderer.probe(viewpoint_of({.x = 0.0, .y = 0.0, .z = 1.3, .tilt = kUp}, {x, 15.0, Angle{}}), table, 0.075);
    return probed.meetings[32 * 64 + 32].z;
  };
  EXPECT_NEAR(above(10.0), 2.2F, 1e-3F);
  EXPECT_NEAR(above(30.0), 17.2F, 1e-2F);
  // Just below the edge one sees the upright side of the opening.
  const auto probed = renderer.probe(viewpoint_of({.x = 0.0, .y = 0.0, .z = 1.3, .tilt = kUp}, {20.2, 15.0, Angle{}}),
                                     RayTable{plain_lens(64, 64, 2.0)}, 0.075);
  int upright = 0;
  for (const auto& met : probed.meetings) upright += met.z > 2.5F && met.z < 16.0F ? 1 : 0;
  EXPECT_GT(upright, 50);
}

TEST(TracedScene, BentLensesPutKnownPointsWhereTheirConstantsSay) {
  World world = wide_hall();
  for (const LensModel& lens : {plain_lens(320, 240, 1.2), bent_lens(), fish_lens()}) {
    const RayTable table{lens};
    const Viewpoint view = viewpoint_of({.x = 0.1, .z = 1.3, .pan = 0.2, .tilt = 1.2, .roll = 0.3},
                                        {10.0, 15.0, Angle::degrees(50.0)}, {.roll = 0.01, .pitch = -0.02});
    Rng rng{7};
    int tried = 0;
    while (tried < 12) {
      const Point2 place{rng.uniform(20.0, lens.width - 20.0), rng.uniform(20.0, lens.height - 20.0)};
      const Vec3 ray = lens.ray(place.x, place.y);
      if (dot(ray, ray) == 0.0F || ray.z < 0.3F) continue;
      const Vec3 at = view.eye + 1.2F * view.to_world(ray);
      if (at.z < 0.2F || at.z > 3.2F) continue;
      ++tried;
      Renderer renderer;
      renderer.set_furnishing(furnish(world));
      const RawPicture before = renderer.expose(view, table);
      Mesh ball;
      add_ball(ball, at, 0.04, 0.04, {{0.9F, 0.0F, 0.0F}}, 24);
      renderer.set_figures(std::move(ball));
      const RawPicture with = renderer.expose(view, table);
      Point2 sum;
      double weight = 0.0;
      for (int y = 0; y < lens.height; ++y)
        for (int x = 0; x < lens.width; ++x) {
          const auto i = static_cast<std::size_t>(y * lens.width + x);
          const double changed = with.light[i].green < 0.5F * before.light[i].green ? 1.0 : 0.0;
          sum = sum + changed * Point2{x + 0.5, y + 0.5};
          weight += changed;
        }
      ASSERT_GT(weight, 10.0);
      EXPECT_LT(distance((1.0 / weight) * sum, place), 0.6) << place.x << " " << place.y;
    }
  }
}

TEST(TracedScene, DepthsShowStairsATableTopGlassAndTheProjectorsShadow) {
  World world = wide_hall();
  const auto box = [](double x0, double y0, double x1, double y1) -> Polygon {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  };
  world.solids = {{"down", SolidKind::stairs, box(7.0, 14.0, 9.5, 16.0), -1.0, 0.0},
                  {"rail", SolidKind::furniture, box(9.6, 14.0, 9.7, 16.0), 0.0, 1.0},
                  {"table", SolidKind::furniture, box(7.0, 20.0, 9.0, 22.0), 0.85, 0.9},
                  {"case", SolidKind::glass, box(8.0, 5.0, 8.1, 7.0), 0.0, 2.0},
                  {"behind", SolidKind::wall, box(9.0, 4.0, 9.2, 8.0), 0.0, 3.0},
                  {"post", SolidKind::furniture, box(8.0, 25.9, 8.1, 26.1), 0.0, 2.0},
                  {"screen", SolidKind::wall, box(9.0, 24.0, 9.2, 28.0), 0.0, 3.0}};
  Renderer renderer;
  renderer.set_furnishing(furnish(world));
  const LensModel lens = plain_lens(160, 120, 1.0);
  const RayTable table{lens};
  const auto probe = [&](double z, double tilt, double y) {
    return renderer.probe(viewpoint_of({.z = z, .tilt = tilt}, {6.0, y, Angle{}}), table, 0.075);
  };
  const auto seen = [&](const RawDepth& raw, int x, int y) {
    return raw.meetings[static_cast<std::size_t>(y * 160 + x)];
  };
  // Heights by depth: z along the axis, 0.6 rad down.
  const RawDepth stairs = probe(1.2, -0.6, 15.0);
  double lowest = 0.0, highest = -9.0;
  for (int y = 0; y < 120; ++y) {
    const auto met = seen(stairs, 80, y);
    if (met.z <= 0.0F || met.z > 3.6F) continue;
    const double v = (y + 0.5 - 60.0) / lens.focal_y;
    const double height = 1.2 + static_cast<double>(met.z) * (-std::sin(0.6) - v * std::cos(0.6));
    lowest = std::min(lowest, height);
    if (y > 100) highest = std::max(highest, height);
  }
  EXPECT_NEAR(lowest, -1.0, 0.02) << "a hole";
  EXPECT_NEAR(highest, 0.0, 0.02);
  const auto under = probe(0.3, 0.4, 21.0);
  const auto met = seen(under, 80, 60);
  EXPECT_NEAR(0.3 + static_cast<double>(met.z) * std::sin(0.4), 0.85, 0.01) << "the table's underside";
  const auto pane = seen(probe(1.0, 0.0, 6.0), 80, 60);
  EXPECT_NEAR(pane.z, 3.0F, 0.01F);
  EXPECT_NEAR(pane.glass, 2.0F, 0.01F);
  const auto edge = probe(1.0, 0.0, 26.0);
  int unlit = 0;
  double column = 0.0;
  for (int x = 0; x < 160; ++x)
    if (!seen(edge, x, 60).is_lit) ++unlit, column += x;
  EXPECT_GT(unlit, 0);
  EXPECT_LT(column / unlit, 75.0) << "the projector is to the right, its shadow to the left of the post";
}

}  // namespace
}  // namespace docent::simulator
