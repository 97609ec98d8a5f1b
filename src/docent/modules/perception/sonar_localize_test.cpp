#include "docent/modules/perception/sonar_localize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "docent/messages/conversions.h"
#include "docent/modules/perception/localize_module.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules::sonar_localize_test {
namespace {

/// `localize` with `method: sonar` before a robot that drives rounds in a room of 9 x 6 m with a case in a corner; its
/// odometry is 3 % short and veers.
class SonarLocalize : public ::testing::Test {
 protected:
  SonarLocalize() : state_{std::filesystem::path{::testing::TempDir()} / "docent_sonar_localize_test"} {
    std::filesystem::remove_all(state_);
    std::filesystem::create_directories(state_);
    museum_.map.frame = {200, 140, 0.05, {-0.5, -0.5}};
    museum_.map.cells.assign(museum_.map.frame.size(), OccupancyGrid::kFree);
    for (int row = 0; row < 140; ++row) {
      for (int column = 0; column < 200; ++column) {
        const bool wall = row < 10 || row >= 130 || column < 10 || column >= 190;
        const bool box = column >= 150 && row >= 100;
        if (wall || box) museum_.map.cells[museum_.map.frame.index({column, row})] = OccupancyGrid::kOccupied;
      }
    }
    museum_.home = {2.0, 1.5, Angle{}};
    world_map_ = std::make_unique<localization::EchoMap>(museum_.map);
    truth_ = museum_.home;
    EXPECT_TRUE(config_.set("localize.method=sonar"));
    world_->subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { belief_ = belief; });
    world_->every(seconds(0.05), [this] { step(); });
    start();
  }
  ~SonarLocalize() override { std::filesystem::remove_all(state_); }
  SonarLocalize(const SonarLocalize&) = delete;
  SonarLocalize& operator=(const SonarLocalize&) = delete;

  void start() {
    module_.reset();
    bus_ = hub_.connect("localize");
    auto made = make_localize({*bus_, museum_, config_, state_, 1, true});
    ASSERT_TRUE(made) << made.error().message;
    module_ = std::move(*made);
  }
  void run(double duration) { hub_.run_until(hub_.now() + seconds(duration)); }

  void step() {
    // Sides of 4 and 2 m, and quarter turns.
    constexpr double kSpeed = 0.5;
    const double side = leg_ % 2 == 0 ? 4.0 : 2.0;
    Pose2 by{kSpeed * 0.05, 0.0, Angle{}};
    if (way_ >= side) by = {0.0, 0.0, Angle::degrees(3.0)};
    way_ += by.x;
    turned_ += by.theta.degrees();
    if (turned_ > 89.9) {
      way_ = turned_ = 0.0;
      ++leg_;
    }
    truth_ = truth_ * by;
    odometry_ = odometry_ * Pose2{0.97 * by.x, 0.0, by.theta + Angle::radians(0.03 * by.x)};
    nav_msgs::Odometry message;
    message.header = {to_message(world_->now()), "odom"};
    message.pose.pose = to_message(odometry_);
    odometry_publisher_.publish(message);
    for (const int sonar : {count_ % 24, (count_ + 8) % 24, (count_ + 16) % 24}) ping(sonar);
    ++count_;
  }
  void ping(int sonar) {
    const Pose2 base_from_sonar = config_.body().base_from_sonar(sonar);
    const auto echo = world_map_->expect(truth_ * base_from_sonar, 0.2, 9, 5.0);
    sensor_msgs::Range range;
    range.header = {to_message(world_->now()), (sonar < 10 ? "sonar_0" : "sonar_") + std::to_string(sonar)};
    range.field_of_view = 0.26F;
    range.max_range = 5.0F;
    range.range = echo && echo->slant < 0.4 ? static_cast<float>(echo->range) : 5.0F;
    sonar_publisher_.publish(range);
  }
  [[nodiscard]] double error() const {
    if (belief_.hypotheses.empty()) return 1e9;
    return std::hypot(belief_.hypotheses[0].x - truth_.x, belief_.hypotheses[0].y - truth_.y);
  }

  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  std::unique_ptr<transport::Bus> bus_;
  transport::Publisher<nav_msgs::Odometry> odometry_publisher_ = world_->publisher(topics::kOdometry);
  transport::Publisher<sensor_msgs::Range> sonar_publisher_ = world_->publisher(topics::kSonar);
  museum::Museum museum_;
  robot::RobotConfig config_;
  std::filesystem::path state_;
  std::unique_ptr<localization::EchoMap> world_map_;
  std::unique_ptr<Module> module_;
  docent_msgs::Belief belief_;
  Pose2 truth_;
  Pose2 odometry_;
  int count_ = 0;
  int leg_ = 0;
  double way_ = 0.0;
  double turned_ = 0.0;
};

TEST_F(SonarLocalize, FollowsTheRobotFromHome) {
  run(1.0);
  EXPECT_TRUE(belief_.localized);
  run(150.0);
  EXPECT_TRUE(belief_.localized);
  EXPECT_LT(error(), 0.25);
  EXPECT_GT(distance(museum_.home * odometry_.position(), truth_.position()), 0.5) << "odometry alone would not do";
  EXPECT_EQ(module_->health().state, "ready");
  ASSERT_EQ(belief_.hypotheses.size(), 1U);
  double mass = 0.0;
  for (const auto& cell : belief_.cells) mass += static_cast<double>(cell.mass);
  for (const float value : belief_.rest.mass) mass += static_cast<double>(value);
  EXPECT_NEAR(mass, 1.0, 1e-3);
}

TEST_F(SonarLocalize, GoesOnAfterARestart) {
  run(40.0);
  start();
  run(5.0);
  EXPECT_TRUE(belief_.localized);
  EXPECT_LT(error(), 0.3);
}

TEST_F(SonarLocalize, SaysWhatIsMissing) {
  run(5.0);
  world_.reset();
  run(5.0);
  EXPECT_EQ(module_->health().state, "degraded");
  EXPECT_EQ(module_->health().reason, "no odom");
}

TEST(SonarLocalizeConfiguration, UnknownMethodsAndWildStartsAreFaults) {
  robot::RobotConfig config;
  ASSERT_TRUE(config.set("localize.method=compass"));
  transport::VirtualTimeHub hub;
  const auto bus = hub.connect("localize");
  const museum::Museum museum;
  const auto made = make_localize({*bus, museum, config, "", 1, true});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("method"), std::string::npos);
  SonarLocalizeParams params;
  params.start_heading_error = 0.0;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::modules::sonar_localize_test
