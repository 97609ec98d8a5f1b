#include "docent/simulator/instruments.h"

#include <gtest/gtest.h>

#include "docent/transport/virtual_time_bus.h"

namespace docent::simulator::instruments_test {
namespace {

constexpr double kRadius = 0.25;  // [m] of people

/// A robot at (5, 5) that looks along x, with a wall 3 m to its left.
class Sight : public ::testing::Test {
 protected:
  Sight() {
    world_.floor = {{0.0, 0.0}, {20.0, 0.0}, {20.0, 10.0}, {0.0, 10.0}};
    world_.solids.push_back(
        {"wall", SolidKind::wall, {{0.0, 8.0}, {20.0, 8.0}, {20.0, 8.1}, {0.0, 8.1}}, 0.0, 3.0, false});
  }
  [[nodiscard]] std::unique_ptr<Instruments> with(std::vector<Hardware::Scanner> scanners) {
    Hardware hardware;
    hardware.scanners = std::move(scanners);
    return std::make_unique<Instruments>(*bus_, world_, hardware, Rng{1});
  }
  /// Somebody so far from the robot, in its frame [m].
  [[nodiscard]] static bool sees(const Instruments& instruments, Point2 somebody, std::vector<Point2> others = {}) {
    std::vector<Disc> people{{kRobot * somebody, kRadius}};
    for (const Point2 other : others) people.push_back({kRobot * other, kRadius});
    return instruments.sees(kRobot, 0, people);
  }
  static constexpr Pose2 kRobot{5.0, 5.0, Angle{}};
  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> bus_ = hub_.connect("simulator");
  World world_;
};

TEST_F(Sight, TwoScannersSeeAllRound) {
  const auto two = with(Hardware{}.scanners);
  for (int degree = 0; degree < 360; ++degree) EXPECT_TRUE(sees(*two, 2.0 * unit(Angle::degrees(degree)))) << degree;
  EXPECT_FALSE(sees(*two, {10.5, 0.0})) << "beyond its reach";
  EXPECT_FALSE(sees(*two, {0.0, 4.0})) << "behind the wall";
  EXPECT_FALSE(sees(*two, {3.0, 0.0}, {{1.0, 0.0}})) << "behind somebody";
  EXPECT_TRUE(sees(*two, {3.0, 0.0}, {{1.0, 0.6}}));
}

TEST_F(Sight, OneScannerInFrontSeesNobodyBehind) {
  const auto front = with({Hardware{}.scanners.front()});
  EXPECT_TRUE(sees(*front, {2.0, 0.0}));
  EXPECT_TRUE(sees(*front, {0.3, 2.0})) << "to its side";
  EXPECT_TRUE(sees(*front, {-0.1, 2.0})) << "a part of them is in front";
  for (int degree = 100; degree <= 260; ++degree)
    EXPECT_FALSE(sees(*front, 2.0 * unit(Angle::degrees(degree)))) << degree;
}

TEST_F(Sight, AScannerLooksFromWhereItIsMounted) {
  const auto left = with({{"left", "laser_left", {0.0, 0.5, Angle::degrees(90.0)}, Angle::degrees(90.0).radians()}});
  EXPECT_TRUE(sees(*left, {0.0, 2.0}));
  EXPECT_TRUE(sees(*left, {1.2, 2.0}));
  EXPECT_FALSE(sees(*left, {2.0, 0.5})) << "beside its field of 90 degrees";
  EXPECT_FALSE(sees(*left, {0.0, -2.0}));
}

TEST_F(Sight, WithoutAScannerNobodyIsSeen) { EXPECT_FALSE(sees(*with({}), {1.0, 0.0})); }

}  // namespace
}  // namespace docent::simulator::instruments_test
