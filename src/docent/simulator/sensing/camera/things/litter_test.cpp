#include "docent/simulator/sensing/camera/things/litter.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::simulator {
namespace {

TEST(Litter, FillsItsSolid) {
  const auto square = [](double half) -> Polygon {
    return {{3.0 - half, 4.0 - half}, {3.0 + half, 4.0 - half}, {3.0 + half, 4.0 + half}, {3.0 - half, 4.0 + half}};
  };
  const std::vector<Solid> all{{"a", SolidKind::furniture, square(0.03), 0.0, 0.12, false, SolidForm::can},
                               {"b", SolidKind::furniture, square(0.04), 0.0, 0.06, false, SolidForm::wad},
                               {"c", SolidKind::furniture, square(0.15), 0.0, 0.45, false, SolidForm::bin}};
  for (const Solid& solid : all) {
    Mesh mesh;
    add_litter(mesh, solid);
    ASSERT_FALSE(mesh.triangles.empty());
    const double radius = distance(solid.polygon[0], Point2{3.0, 4.0});
    float top = 0.0F;
    double widest = 0.0;
    for (const Vec3 p : mesh.points) {
      top = std::max(top, p.z);
      EXPECT_GE(p.z, -1e-6F);
      widest = std::max(widest, distance(Point2{static_cast<double>(p.x), static_cast<double>(p.y)}, Point2{3.0, 4.0}));
    }
    EXPECT_LE(widest, radius + 1e-6) << solid.id;
    EXPECT_GT(widest, 0.8 * radius) << solid.id;
    EXPECT_LE(top, solid.top + 1e-6);
    EXPECT_GT(top, 0.75 * solid.top) << solid.id;
  }
}

}  // namespace
}  // namespace docent::simulator
