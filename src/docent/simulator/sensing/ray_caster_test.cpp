#include "docent/simulator/sensing/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

World hall() {
  World world;
  world.solids.push_back({"room", SolidKind::wall, box(-10.0, -8.0, 12.0, 9.0), 0.0, 3.0, false});
  world.solids.push_back({"podium", SolidKind::furniture, box(2.0, -1.0, 3.0, 1.0), 0.0, 0.3, false});
  world.solids.push_back({"pane", SolidKind::glass, box(5.0, -2.0, 5.05, 2.0), 0.0, 2.0, false});
  world.solids.push_back({"plate", SolidKind::plate, box(-3.0, -3.0, -2.0, 3.0), 0.0, 0.1, false});
  return world;
}

TEST(RayCaster, MeetsWhatReachesItsHeight) {
  const RayCaster high{surfaces_at(hall(), 0.38)};
  const RayCaster low{surfaces_at(hall(), 0.25)};
  EXPECT_DOUBLE_EQ(high.cast({}, {1.0, 0.0}, 50.0).distance, 12.0);  // over the podium, through the glass
  EXPECT_DOUBLE_EQ(high.cast({}, {1.0, 0.0}, 50.0).glass_distance, 5.0);
  EXPECT_DOUBLE_EQ(high.cast({}, {1.0, 0.0}, 50.0).glass_cosine, 1.0);
  EXPECT_DOUBLE_EQ(low.cast({}, {1.0, 0.0}, 50.0).distance, 2.0);
  EXPECT_TRUE(std::isinf(low.cast({}, {1.0, 0.0}, 50.0).glass_distance));  // behind the podium
  EXPECT_DOUBLE_EQ(low.cast({}, {-1.0, 0.0}, 50.0).distance, 10.0);        // no sensor meets a plate
  EXPECT_TRUE(std::isinf(low.cast({}, {-1.0, 0.0}, 9.0).distance));
}

TEST(RayCaster, AgreesWithTestingEverySurface) {
  Rng rng{7};
  for (int world = 0; world < 20; ++world) {
    std::vector<Surface> surfaces;
    for (int i = 0; i < 60; ++i) {
      const Point2 a{rng.uniform(-20.0, 20.0), rng.uniform(-15.0, 15.0)};
      surfaces.push_back({{a, a + Point2{rng.uniform(-6.0, 6.0), rng.uniform(-6.0, 6.0)}}, rng.chance(0.2)});
    }
    const RayCaster caster{surfaces};
    for (int ray = 0; ray < 300; ++ray) {
      const Point2 origin{rng.uniform(-25.0, 25.0), rng.uniform(-20.0, 20.0)};
      const Point2 way = unit(Angle::radians(rng.uniform(-3.2, 3.2)));
      double opaque = 10.0;
      double glass = 10.0;
      for (const Surface& surface : surfaces) {
        const auto hit = ray_distance(origin, way, surface.segment);
        if (!hit) continue;
        (surface.glass ? glass : opaque) = std::min(surface.glass ? glass : opaque, *hit);
      }
      const RayHit hit = caster.cast(origin, way, 10.0);
      ASSERT_NEAR(std::min(hit.distance, 10.0), opaque, 1e-9) << "world " << world << " ray " << ray;
      if (glass < opaque) {
        ASSERT_NEAR(hit.glass_distance, glass, 1e-9) << "world " << world << " ray " << ray;
      }
    }
  }
}

TEST(RayCaster, AxisAlignedRaysAlongCellBordersLeakNowhere) {
  const RayCaster caster{surfaces_at(hall(), 0.38)};
  for (int i = -14; i <= 16; ++i) {
    const Point2 origin{0.0, 0.5 * i - 0.1};
    EXPECT_NEAR(caster.cast(origin, {-1.0, 0.0}, 50.0).distance, 10.0, 1e-9);
    EXPECT_NEAR(caster.cast({0.5 * i - 0.1, 0.0}, {0.0, 1.0}, 50.0).distance, 9.0, 1e-9);
  }
  for (int degree = 0; degree < 3600; ++degree) {
    EXPECT_TRUE(std::isfinite(caster.cast({}, unit(Angle::degrees(0.1 * degree)), 50.0).distance));
  }
}

}  // namespace
}  // namespace docent::simulator
