#include "docent/simulator/office/office.h"

#include <gtest/gtest.h>

#include <set>

#include "docent/simulator/crowd/walkable_floor.h"

namespace docent::simulator {
namespace {

TEST(Office, IsTheSameForASeedAndAnotherForAnother) {
  const Office first = draw_office(7);
  const Office again = draw_office(7);
  ASSERT_EQ(first.world.solids.size(), again.world.solids.size());
  for (std::size_t i = 0; i < first.world.solids.size(); ++i) {
    EXPECT_EQ(first.world.solids[i].polygon, again.world.solids[i].polygon);
  }
  std::set<double> lengths;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Polygon floor = draw_office(seed).world.floor;
    lengths.insert(distance(floor[0], floor[1]));
  }
  EXPECT_EQ(lengths.size(), 20U);
}

TEST(Office, ARobotReachesEveryStopAndMostOfTheFloor) {
  double reached = 0.0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const Office office = draw_office(seed);
    const WalkableFloor floor{office.world};
    FlowField field = floor.field_to(office.home.position(), 0.3);
    EXPECT_TRUE(floor.is_reachable(office.home.position())) << seed;
    EXPECT_GE(office.stops.size(), 2U);
    for (const Stop& stop : office.stops) {
      EXPECT_GT(floor.clearance(stop.pose.position()), 0.45) << seed << ' ' << stop.id;
      EXPECT_TRUE(floor.direction(field, stop.pose.position(), 0.3)) << seed << ' ' << stop.id;
    }
    reached += floor.free_area() / std::abs(signed_area(office.world.floor));
  }
  EXPECT_GT(reached / 25.0, 0.4);
}

TEST(Office, HasWallsDoorsFurnitureAndSomePanes) {
  int doors = 0;
  int panes = 0;
  int movable = 0;
  int turned = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Office office = draw_office(seed);
    for (const Solid& solid : office.world.solids) {
      if (solid.id.starts_with("door")) ++doors;
      if (solid.kind == SolidKind::glass) ++panes;
      if (solid.movable) ++movable;
      EXPECT_TRUE(is_simple(solid.polygon)) << solid.id;
    }
    const Polygon& floor = office.world.floor;
    if (std::abs(direction(floor[0], floor[1]).degrees()) > 1.0) ++turned;
  }
  EXPECT_GT(doors, 60);
  EXPECT_GT(panes, 5);
  EXPECT_GT(movable, 100);
  EXPECT_GT(turned, 8);
}

}  // namespace
}  // namespace docent::simulator
