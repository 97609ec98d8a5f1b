#include "docent/simulator/eye_drivers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/messages/conversions.h"
#include "docent/simulator/museum_bench.h"

namespace docent::simulator::eye_drivers_test {
namespace {

SimulationOptions with_eyes(const char* scenario = "events: []") {
  SimulationOptions made = options("empty", Pose2{5.0, 5.0, Angle{}}, 3);
  CameraOptions cameras{.for_people = false};
  cameras.eyes.up = cameras.eyes.depth = true;
  cameras.eyes.eyes.rig.width = 80, cameras.eyes.eyes.rig.height = 60;
  made.cameras = cameras;
  made.scenario = parse_scenario(scenario, "s.yaml").value();
  return made;
}

struct Pictures {
  std::vector<sensor_msgs::Image> depth, up;
  std::vector<sensor_msgs::CameraInfo> infos;
  std::vector<double> ages;
  int for_people = 0;
  explicit Pictures(Bench& bench) {
    auto& bus = *bench.robot_bus;
    bus.subscribe<sensor_msgs::Image>(topics::kDepthImage, [this, &bus](const auto& m) {
      depth.push_back(m);
      ages.push_back(to_seconds(bus.now() - from_message(m.header.stamp)));
    });
    bus.subscribe<sensor_msgs::Image>(topics::kCeilingImage, [this](const auto& m) { up.push_back(m); });
    bus.subscribe<sensor_msgs::CameraInfo>(topics::kDepthInfo, [this](const auto& m) { infos.push_back(m); });
    bus.subscribe<sensor_msgs::CompressedImage>(topics::kCamera, [this](const auto&) { ++for_people; });
  }
};

TEST(EyeDrivers, SendPicturesAndLensesAtTheirRates) {
  Bench bench{with_eyes()};
  const Pictures seen{bench};
  bench.run(4.0);
  EXPECT_EQ(seen.depth.size(), 20U);
  EXPECT_EQ(seen.up.size(), 10U);
  EXPECT_EQ(seen.for_people, 0);
  ASSERT_EQ(seen.infos.size(), 20U);
  EXPECT_EQ(seen.infos.front().width, 80U);
  EXPECT_EQ(seen.depth.front().encoding, "16UC1");
  EXPECT_EQ(seen.depth.front().data.size(), 2U * 80 * 60);
  EXPECT_EQ(seen.up.front().encoding, "mono8");
  EXPECT_NE(seen.depth[3].data, seen.depth[4].data) << "noise";
}

TEST(EyeDrivers, ChangeNothingElse) {
  SimulationOptions without = with_eyes();
  without.cameras.reset();
  Bench blind{std::move(without)};
  Bench seeing{with_eyes()};
  for (Bench* bench : {&blind, &seeing}) bench->drive(0.3, 0.1, 5.0);
  EXPECT_EQ(blind.hash, seeing.hash);
}

TEST(EyeDrivers, HaveFaults) {
  Bench bench{with_eyes(
      "events:\n  - {at: 1, eye: {eye: depth, kind: gone, for: 1}}\n  - {at: 2, eye: {eye: depth, kind: frozen, for: "
      "1}}\n"
      "  - {at: 3, eye: {eye: depth, kind: black, for: 1}}\n  - {at: 4, eye: {eye: depth, kind: late, delay: 0.6, for: "
      "1}}\n")};
  const Pictures seen{bench};
  bench.run(0.95);
  const std::size_t before = seen.depth.size();
  bench.run(1.0);
  EXPECT_LE(seen.depth.size() - before, 1U) << "gone";
  bench.run(1.0);
  EXPECT_EQ(seen.depth.back().data, seen.depth[seen.depth.size() - 2].data) << "frozen";
  bench.run(1.0);
  EXPECT_TRUE(std::all_of(seen.depth.back().data.begin(), seen.depth.back().data.end(), [](auto b) { return b == 0; }));
  bench.run(1.5);
  EXPECT_NEAR(*std::max_element(seen.ages.begin(), seen.ages.end()), 0.6, 0.02);
}

TEST(EyeDrivers, AFrontCameraSendsColoursAndFails) {
  SimulationOptions made = with_eyes("events: [{at: 2, eye: {eye: front, kind: gone}}]");
  made.cameras->eyes.up = made.cameras->eyes.depth = false;
  made.cameras->eyes.front = true;
  made.cameras->eyes.eyes.rig.front_times = 1.5;
  Bench bench{std::move(made)};
  std::vector<sensor_msgs::Image> seen;
  bench.robot_bus->subscribe<sensor_msgs::Image>(topics::kFrontImage, [&](const auto& m) { seen.push_back(m); });
  bench.run(4.0);
  ASSERT_NEAR(static_cast<double>(seen.size()), 8.0, 1.0);
  EXPECT_EQ(seen.front().encoding, "rgb8");
  EXPECT_EQ(seen.front().width, 120U);
  EXPECT_EQ(seen.front().data.size(), 3U * 120 * 90);
}

}  // namespace
}  // namespace docent::simulator::eye_drivers_test
