#include "docent/simulator/sensing/camera/mesh/mesh.h"

#include <gtest/gtest.h>

namespace docent::simulator {
namespace {

TEST(Mesh, CutsAConcavePolygonIntoItsArea) {
  Mesh mesh;
  add_level(mesh, {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {2.0, 1.0}, {0.0, 4.0}}, 0.0, true, {});
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 twice = cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
    EXPECT_GT(twice.z, 0.0F);
    area += 0.5 * static_cast<double>(twice.z);
  }
  EXPECT_NEAR(area, 10.0, 1e-5);
}

}  // namespace
}  // namespace docent::simulator
