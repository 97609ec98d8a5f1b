#include "docent/simulator/sensing/camera/things/stairs.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace docent::simulator {
namespace {

World cellar(double bottom = 0.0) {
  World world;
  world.floor = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
  world.operating_area = world.floor;
  world.solids.push_back({"down", SolidKind::stairs, {{4.0, 2.0}, {6.0, 2.0}, {6.0, 6.0}, {4.0, 6.0}}, bottom, 0.0});
  return world;
}

TEST(Stairs, AreEnteredWhereNothingIsInTheWay) {
  World world = cellar();
  const auto rail = [&](const char* id, double x0, double y0, double x1, double y1) {
    world.solids.push_back({id, SolidKind::furniture, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, 0.0, 1.0});
  };
  rail("west", 3.85, 2.0, 3.95, 6.0);
  rail("south", 4.0, 1.85, 6.0, 1.95);
  rail("east", 6.05, 2.0, 6.15, 6.0);
  EXPECT_EQ(entry_of(world.solids.front(), world), 2U) << "from the north";
}

TEST(Stairs, GoDownStepByStepToTheirBottom) {
  for (const double bottom : {0.0, -1.0}) {
    const World world = cellar(bottom);
    Mesh mesh;
    add_stairs(mesh, world.solids.front(), world);
    // Treads by their depth and how far from the entry, which is the southern side.
    double deepest = 0.0;
    for (const auto& corners : mesh.triangles) {
      const Vec3 middle = (1.0F / 3.0F) * (mesh.points[corners[0]] + mesh.points[corners[1]] + mesh.points[corners[2]]);
      if (mesh.normals[corners[0]].z < 0.9F) continue;
      const double along = static_cast<double>(middle.y) - 2.0, depth = -static_cast<double>(middle.z);
      const double steps = std::floor(along / 0.28) + 1.0;
      EXPECT_NEAR(depth, std::min(0.17 * steps, bottom < 0.0 ? 1.0 : 3.0), 1e-4) << along;
      deepest = std::max(deepest, depth);
    }
    EXPECT_NEAR(deepest, bottom < 0.0 ? 1.0 : 15 * 0.17, 1e-4) << "4 m are 15 steps";
  }
}

}  // namespace
}  // namespace docent::simulator
