#include "docent/mapping/occupancy/sight_layer.h"

#include <gtest/gtest.h>

namespace docent::mapping::sight_layer_test {
namespace {

const GridFrame kFrame{60, 40, 0.1, {0.0, 0.0}};
const Point2 kRobot{1.0, 2.0};
const Segment kEdge{{2.0, 1.6}, {2.0, 2.4}};

struct Sighted {
  SightLayer layer{kFrame, std::vector<bool>(kFrame.size()), {}};
  double now = 0.0;
  void see(std::vector<Segment> lines, Point2 robot = kRobot, std::vector<Point2> laser_points = {}) {
    const LaserLook laser{{robot.x, robot.y, {}}, -3.0, 6.0, laser_points};
    layer.see(robot, lines, std::span{&laser, 1}, time_from_seconds(now += 0.1));
  }
  [[nodiscard]] bool blocks(Point2 at) const { return layer.is_blocked(kFrame.index(kFrame.cell_at(at))); }
};

TEST(SightLayer, TwoLooksMarkAndTwoFree) {
  Sighted sighted;
  sighted.see({kEdge});
  EXPECT_FALSE(sighted.blocks({2.0, 2.0}));
  sighted.see({kEdge});
  EXPECT_TRUE(sighted.blocks({2.0, 2.0}));
  EXPECT_TRUE(sighted.layer.take_changes());
  sighted.see({});
  EXPECT_TRUE(sighted.blocks({2.0, 2.0}));
  sighted.see({});
  EXPECT_FALSE(sighted.blocks({2.0, 2.0}));
}

TEST(SightLayer, WhatANearerLineHidesStays) {
  Sighted sighted;
  for (int i = 0; i < 3; ++i) sighted.see({kEdge});
  for (int i = 0; i < 9; ++i) sighted.see({{{1.5, 1.0}, {1.5, 3.0}}});
  EXPECT_TRUE(sighted.blocks({2.0, 2.0}));
}

TEST(SightLayer, WhatIsFarAwayStaysUntilItIsForgotten) {
  Sighted sighted;
  for (int i = 0; i < 3; ++i) sighted.see({kEdge});
  for (int i = 0; i < 9; ++i) sighted.see({}, {5.5, 2.0});
  EXPECT_TRUE(sighted.blocks({2.0, 2.0}));
  sighted.layer.forget(time_from_seconds(1000.0));
  EXPECT_TRUE(sighted.blocks({2.0, 2.0}));
  sighted.layer.forget(time_from_seconds(2000.0));
  EXPECT_FALSE(sighted.blocks({2.0, 2.0}));
}

TEST(SightLayer, WhatALaserSeesIsLeftToTheLasers) {
  Sighted sighted;
  for (int i = 0; i < 3; ++i) sighted.see({kEdge}, kRobot, {{2.1, 1.7}});
  EXPECT_FALSE(sighted.blocks({2.0, 1.7}));
  EXPECT_TRUE(sighted.blocks({2.0, 2.3}));
}

}  // namespace
}  // namespace docent::mapping::sight_layer_test
