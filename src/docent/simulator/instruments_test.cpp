#include "docent/simulator/instruments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
    const Physique disc = one_disc(kRadius);
    std::vector<Posture> people{{kRobot * somebody, {1.0, 0.0}, 0.0, &disc}};
    for (const Point2 other : others) people.push_back({kRobot * other, {1.0, 0.0}, 0.0, &disc});
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
  const auto left =
      with({{"left", "laser_left", {0.0, 0.5, Angle::degrees(90.0)}, {.field = Angle::degrees(90.0).radians()}}});
  EXPECT_TRUE(sees(*left, {0.0, 2.0}));
  EXPECT_TRUE(sees(*left, {1.2, 2.0}));
  EXPECT_FALSE(sees(*left, {2.0, 0.5})) << "beside its field of 90 degrees";
  EXPECT_FALSE(sees(*left, {0.0, -2.0}));
}

TEST_F(Sight, AScannerIsWrittenAsItIsSoldAndSeesTheBodysPosts) {
  Hardware hardware;
  hardware.scanners = {{"front",
                        "laser_front",
                        {},
                        {.field = 2.0 * std::numbers::pi,
                         .beams = 720,
                         .rate = 40.0,
                         .max_range = 4.0,
                         .is_clockwise = true,
                         .no_return = NoReturn::zero}}};
  hardware.posts = {{{0.0, -0.2}, 0.02}};
  Instruments instruments{*bus_, world_, hardware, Rng{1}};
  const auto robot = hub_.connect("robot");
  std::vector<sensor_msgs::LaserScan> scans;
  robot->subscribe<sensor_msgs::LaserScan>(topics::scan_topic("front"),
                                           [&](const auto& scan) { scans.push_back(scan); });
  for (std::size_t step = 0; step < 100; ++step) instruments.publish_scans(hub_.now(), step, kRobot, {});
  hub_.run_until(hub_.now() + seconds(0.1));
  ASSERT_EQ(scans.size(), 40U);
  const sensor_msgs::LaserScan& scan = scans.back();
  EXPECT_LT(scan.angle_increment, 0.0F);
  EXPECT_EQ(scan.range_max, 4.0F);
  ASSERT_EQ(scan.ranges.size(), 720U);
  const auto reading = [&](double bearing) {
    return static_cast<double>(scan.ranges[static_cast<std::size_t>(
        std::lround((bearing - static_cast<double>(scan.angle_min)) / static_cast<double>(scan.angle_increment)))]);
  };
  EXPECT_NEAR(reading(0.5 * std::numbers::pi), 3.0, 0.2) << "the wall to the left";
  EXPECT_NEAR(reading(-0.5 * std::numbers::pi), 0.18, 0.08) << "the post to the right";
  EXPECT_EQ(reading(0.0), 0.0) << "nothing ahead";
}

TEST_F(Sight, AScannerSeesWhatIsAtItsHeight) {
  Physique table;  // one leg in the middle
  table.parts = {{{}, 0.05, 0.0, 0.7, 0.0, false}, {{}, 0.5, 0.7, 0.75, 0.0, false}};
  table.reach = 0.5;
  const std::vector<Posture> people{{kRobot * Point2{2.0, 0.0}, {1.0, 0.0}, 0.0, &table}};
  for (const double height : {0.1, 0.38, 0.72}) {
    Hardware hardware;
    hardware.scanners.front().height = height;
    hardware.scanners.resize(1);
    Instruments instruments{*bus_, world_, hardware, Rng{1}};
    instruments.publish_scans(hub_.now(), 0, kRobot, people);
    const int met = instruments.met(0);
    if (height < 0.7) {
      EXPECT_LE(met, 4) << height;
      EXPECT_GE(met, 1) << height;
    } else {
      EXPECT_GE(met, 25) << "the top, edge on";
    }
  }
}

TEST_F(Sight, WithoutAScannerNobodyIsSeen) { EXPECT_FALSE(sees(*with({}), {1.0, 0.0})); }

}  // namespace
}  // namespace docent::simulator::instruments_test
