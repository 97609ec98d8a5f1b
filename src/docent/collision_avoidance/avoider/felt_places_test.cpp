#include "docent/collision_avoidance/avoider/felt_places.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::collision_avoidance::felt_places_test {
namespace {

Time at(double s) { return time_from_seconds(s); }

TEST(FeltPlaces, StayInTheBuildingWhileOdometryWandersOff) {
  FeltPlaces felt{{}};
  felt.feel({1.0, 0.0}, {1.0, 0.0}, false, at(1.0));  // odometry's frame: nothing else is known
  EXPECT_NEAR(felt.gap({0.5, 0.0, {}}, {}), 0.5 - 0.265, 1e-9);
  felt.believe({10.0, 5.0, {}}, 0.99);
  EXPECT_NEAR(felt.gap({0.5, 0.0, {}}, {}), 0.5 - 0.265, 1e-9);
  felt.believe({9.5, 5.0, {}}, 0.5);
  EXPECT_NEAR(felt.gap({0.5, 0.0, {}}, {}), 0.5 - 0.265, 1e-9) << "nobody is sure";
  felt.believe({9.5, 5.0, {}}, 0.99);  // the wheels have counted half a metre too much since
  EXPECT_NEAR(felt.gap({1.0, 0.0, {}}, {}), 0.5 - 0.265, 1e-9);
}

TEST(FeltPlaces, OutlinesLieRoundTheDiscs) {
  FeltPlaces felt{{}};
  felt.feel({1.0, 0.0}, {1.0, 0.0}, false, at(1.0));
  const auto points = felt.outlines({0.0, 0.0, Angle::degrees(90)}, 3.0);
  ASSERT_GT(points.size(), 20U);
  double nearest = 10.0;
  for (const Point2& point : points) {
    EXPECT_NEAR(distance(point, {0.0, -1.3}), 0.3, 1e-9);
    nearest = std::min(nearest, norm(point));
  }
  EXPECT_NEAR(nearest, 1.0, 0.01);
  EXPECT_TRUE(felt.outlines({50.0, 0.0, {}}, 3.0).empty());
}

TEST(FeltPlaces, TheBodyThatStandsThereFreesThem) {
  FeltPlaces felt{{}};
  felt.believe({10.0, 5.0, {}}, 0.99);
  felt.feel({1.0, 0.0}, {1.0, 0.0}, false, at(1.0));
  felt.stand({1.0, 0.0}, 0.2, at(2.0));
  EXPECT_TRUE(std::isinf(felt.gap({1.0, 0.0, {}}, {})));
}

TEST(FeltPlaces, ACrippledRobotForgets) {
  FeltPlaces felt{{.remembers = false}};
  felt.feel({1.0, 0.0}, {1.0, 0.0}, false, at(1.0));
  EXPECT_TRUE(felt.outlines({}, 3.0).empty());
}

}  // namespace
}  // namespace docent::collision_avoidance::felt_places_test
