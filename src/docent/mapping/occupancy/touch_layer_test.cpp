#include "docent/mapping/occupancy/touch_layer.h"

#include <gtest/gtest.h>

namespace docent::mapping::touch_layer_test {
namespace {

constexpr GridFrame kFrame{40, 40, 0.15, {0.0, 0.0}};
constexpr double kBody = 0.265;  // [m]

class TouchLayerTest : public ::testing::Test {
 protected:
  [[nodiscard]] bool blocked(Point2 point) const { return layer.is_blocked(kFrame.index(kFrame.cell_at(point))); }
  TouchLayer layer{kFrame, std::vector<bool>(kFrame.size(), false), {}};
};

TEST_F(TouchLayerTest, TheThingLiesBeyondTheOutline) {
  layer.feel({3.0 + kBody, 3.0}, {1.0, 0.0}, time_from_seconds(1.0));
  EXPECT_TRUE(blocked({3.4, 3.0}));
  EXPECT_TRUE(blocked({3.9, 3.0}));
  EXPECT_FALSE(blocked({3.0, 3.0})) << "the body stands there";
  EXPECT_FALSE(blocked({4.4, 3.0}));
  EXPECT_TRUE(layer.take_changes().has_value());
  EXPECT_FALSE(layer.take_changes().has_value());
}

TEST_F(TouchLayerTest, OnlyTheBodyAndTimeFreeIt) {
  layer.feel({3.0 + kBody, 3.0}, {1.0, 0.0}, time_from_seconds(1.0));
  layer.forget(time_from_seconds(1000.0));
  EXPECT_TRUE(blocked({3.6, 3.0}));
  for (double x = 3.2; x < 4.4; x += 0.1) layer.stand({x, 3.0}, kBody);
  EXPECT_FALSE(blocked({3.6, 3.0}));
  EXPECT_TRUE(blocked({3.6, 3.375})) << "it did not stand there";
  layer.forget(time_from_seconds(1802.0));
  EXPECT_FALSE(blocked({3.6, 3.375}));
}

TEST_F(TouchLayerTest, AMappedWallIsNoNews) {
  layer = TouchLayer{kFrame, std::vector<bool>(kFrame.size(), true), {}};
  layer.feel({3.0, 3.0}, {1.0, 0.0}, time_from_seconds(1.0));
  EXPECT_FALSE(layer.take_changes().has_value());
}

}  // namespace
}  // namespace docent::mapping::touch_layer_test
