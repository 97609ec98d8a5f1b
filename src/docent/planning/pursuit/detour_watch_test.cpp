#include "docent/planning/pursuit/detour_watch.h"

#include <gtest/gtest.h>

namespace docent::planning {
namespace {

/// Corners joined by points 0.2 m apart, as RoutePlanner gives them.
std::vector<Point2> way_through(const std::vector<Point2>& corners) {
  std::vector<Point2> way{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double length = distance(corners[i - 1], corners[i]);
    const int pieces = std::max(1, static_cast<int>(length / 0.2));
    for (int k = 1; k <= pieces; ++k)
      way.push_back(corners[i - 1] + (static_cast<double>(k) / pieces) * (corners[i] - corners[i - 1]));
  }
  return way;
}

class DetourWatchTest : public testing::Test {
 protected:
  Detour look(const std::vector<Point2>& corners, double for_s = 1.2) {
    Detour change = Detour::none;
    for (const double end = now_s + for_s; now_s < end; now_s += 0.2)
      change = watch.update(way_through(corners), time_from_seconds(now_s));
    return change;
  }
  double now_s = 0.0;
  DetourWatch watch{DetourParams{}};
};

TEST_F(DetourWatchTest, DrivingOnIsNoDetour) {
  EXPECT_EQ(look({{0, 0}, {10, 0}}), Detour::none);
  for (double x = 0.0; x < 9.0; x += 0.5) EXPECT_EQ(look({{x, 0.3}, {10, 0}}), Detour::none);
}

TEST_F(DetourWatchTest, RoundAPersonIsLocal) {
  look({{0, 0}, {10, 0}});
  EXPECT_EQ(look({{0, 0}, {2, 0}, {3, 1.2}, {4, 0}, {10, 0}}), Detour::local);
  EXPECT_GT(watch.extra(), 0.3);
  EXPECT_LT(watch.extra(), 1.5);
  EXPECT_EQ(look({{4, 0}, {10, 0}}), Detour::none) << "past it";
}

TEST_F(DetourWatchTest, AnotherPassageIsGlobalAndThenMeant) {
  look({{0, 0}, {10, 0}});
  EXPECT_EQ(look({{2, 0}, {-1, 0}, {-1, 5}, {10, 5}, {10, 0}}, 0.7), Detour::none) << "it must last";
  EXPECT_EQ(look({{2, 0}, {-1, 0}, {-1, 5}, {10, 5}, {10, 0}}, 0.4), Detour::global);
  EXPECT_EQ(look({{0, 0}, {-1, 0}, {-1, 5}, {10, 5}, {10, 0}}), Detour::none) << "now it is the way";
}

TEST_F(DetourWatchTest, ALongWayRoundASmallThingIsGlobal) {
  look({{0, 0}, {10, 0}});
  EXPECT_EQ(look({{0, 0}, {2, 0}, {2, 4}, {4, 4}, {4, 0}, {10, 0}}), Detour::global);
  EXPECT_NEAR(watch.extra(), 8.0, 1.5);
}

TEST_F(DetourWatchTest, TwoWaysThatTakeTurnsAreNone) {
  look({{0, 0}, {10, 0}});
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(look({{0, 0}, {2, 0}, {3, 1.2}, {4, 0}, {10, 0}}, 0.4), Detour::none);
    EXPECT_EQ(look({{0, 0}, {10, 0}}, 0.4), Detour::none);
  }
}

TEST_F(DetourWatchTest, AnotherGoalIsNoDetour) {
  look({{0, 0}, {10, 0}});
  watch.restart();
  EXPECT_EQ(look({{0, 0}, {0, 10}}), Detour::none);
}

}  // namespace
}  // namespace docent::planning
