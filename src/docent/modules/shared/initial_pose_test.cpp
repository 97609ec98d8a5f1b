#include "docent/modules/shared/initial_pose.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "docent/messages/conversions.h"
#include "docent/modules/host/module_host.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

/// `localize` by each method in a room of 6 x 4 m, without a single scan or echo: what it believes, it was told.
class InitialPose : public testing::TestWithParam<const char*> {
 protected:
  InitialPose()
      : state_{std::filesystem::temp_directory_path() / ("docent_initial_pose_" + std::to_string(::getpid()))} {
    std::filesystem::create_directories(state_);
    museum_.map.frame = {120, 80, 0.05, {0.0, 0.0}};
    museum_.map.cells.assign(museum_.map.frame.size(), OccupancyGrid::kFree);
    for (int row = 0; row < 80; ++row)
      for (int column = 0; column < 120; ++column)
        if (row < 4 || column < 4 || row >= 76 || column >= 116)
          museum_.map.cells[museum_.map.frame.index({column, row})] = OccupancyGrid::kOccupied;
    museum_.home = {1.0, 1.0, Angle{}};
    EXPECT_TRUE(config_.set(std::string{"localize.method="} + GetParam()));
    world_->subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { belief_ = belief; });
    world_->subscribe<docent_msgs::Health>(topics::kHealth, [this](const auto& health) { health_ = health; });
    ModuleHost::Options options;
    options.state = state_;
    options.virtual_time = true;
    auto host = ModuleHost::create(*find_module("localize"), hub_.connect("localize"), museum_, config_, options);
    EXPECT_TRUE(host) << host.error().message;
    host_ = std::move(*host);
  }
  ~InitialPose() override { std::filesystem::remove_all(state_); }
  InitialPose(const InitialPose&) = delete;
  InitialPose& operator=(const InitialPose&) = delete;

  /// The robot drives along its odometry's x axis at 0.5 m/s.
  void drive(double duration) {
    for (const Time end = hub_.now() + seconds(duration); hub_.now() < end;) {
      odometry_.x += 0.025;
      nav_msgs::Odometry message;
      message.header = {to_message(hub_.now()), "odom"};
      message.pose.pose = to_message(odometry_);
      odometry_publisher_.publish(message);
      hub_.run_until(hub_.now() + seconds(0.05));
    }
  }
  [[nodiscard]] geometry_msgs::PoseWithCovarianceStamped told(const Pose2& pose, double deviation) const {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header = {to_message(hub_.now()), "map"};
    message.pose.pose = to_message(pose);
    message.pose.covariance[0] = message.pose.covariance[7] = deviation * deviation;
    message.pose.covariance[35] = 0.01;
    return message;
  }
  void say(const geometry_msgs::PoseWithCovarianceStamped& message) {
    pose_publisher_.publish(message);
    hub_.run_until(hub_.now() + seconds(0.6));  // a health message comes by
  }
  /// The best hypothesis, carried on by odometry. @pre there is one
  [[nodiscard]] Pose2 believed_now() const {
    const auto& best = belief_.hypotheses.front();
    return Pose2{best.x, best.y, Angle::radians(best.theta)} * (inverse(from_message(belief_.odom_pose)) * odometry_);
  }
  void expect_refused(const geometry_msgs::PoseWithCovarianceStamped& message, const std::string& why) {
    const auto before = belief_;
    say(message);
    EXPECT_EQ(health_.state, "degraded");
    EXPECT_NE(health_.reason.find("messages of initialpose refused: " + why), std::string::npos) << health_.reason;
    ASSERT_EQ(belief_.hypotheses.empty(), before.hypotheses.empty());
    if (before.hypotheses.empty()) return;
    EXPECT_NEAR(belief_.hypotheses[0].x, before.hypotheses[0].x, 1e-9);
    EXPECT_NEAR(belief_.hypotheses[0].y, before.hypotheses[0].y, 1e-9);
  }

  std::filesystem::path state_;
  transport::VirtualTimeHub hub_;
  museum::Museum museum_;
  robot::RobotConfig config_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  transport::Publisher<nav_msgs::Odometry> odometry_publisher_ = world_->publisher(topics::kOdometry);
  transport::Publisher<geometry_msgs::PoseWithCovarianceStamped> pose_publisher_ =
      world_->publisher(topics::kInitialPose);
  std::unique_ptr<ModuleHost> host_;
  docent_msgs::Belief belief_;
  docent_msgs::Health health_;
  Pose2 odometry_;
};

TEST_P(InitialPose, MovesTheBeliefAsSureAsItWasSaid) {
  drive(1.0);
  say(told({4.0, 2.5, Angle::degrees(90.0)}, 0.2));
  ASSERT_FALSE(belief_.hypotheses.empty());
  const auto best = belief_.hypotheses.front();
  EXPECT_NEAR(best.x, 4.0, 0.1);
  EXPECT_NEAR(best.y, 2.5, 0.1);
  EXPECT_NEAR(best.theta, std::numbers::pi / 2.0, 0.06);
  EXPECT_GT(best.mass, 0.8);
  EXPECT_NEAR(std::sqrt(best.covariance[0]), 0.2, 0.05);
  EXPECT_NEAR(std::sqrt(best.covariance[8]), 0.1, 0.04);
  say(told({2.0, 1.5, Angle{}}, 0.0));
  ASSERT_FALSE(belief_.hypotheses.empty());
  EXPECT_NEAR(belief_.hypotheses[0].x, 2.0, 0.1);
  EXPECT_NEAR(std::sqrt(belief_.hypotheses[0].covariance[0]), 0.1, 0.05) << "nobody points more exactly";
  EXPECT_EQ(health_.reason.find("refused"), std::string::npos) << health_.reason;
}

TEST_P(InitialPose, HoldsForTheMomentOfItsStamp) {
  drive(1.0);
  auto message = told({2.0, 2.0, Angle{}}, 0.1);
  drive(1.0);  // half a metre on
  pose_publisher_.publish(message);
  drive(0.3);  // `localize` by sonars tells what it believes eight times a second
  ASSERT_FALSE(belief_.hypotheses.empty());
  // Grid and particles tell the belief as of the stamp, with odometry of then: whoever reads it carries it on.
  EXPECT_NEAR(believed_now().x, 2.65, 0.1);
  message.header.stamp.sec += 1000;  // by a clock that is nothing like ours
  pose_publisher_.publish(message);
  drive(0.3);
  EXPECT_NEAR(believed_now().x, 2.15, 0.1) << "it stood there when it was told";
}

TEST_P(InitialPose, IsRefusedWithAReason) {
  hub_.run_until(time_from_seconds(0.1));
  expect_refused(told({2.0, 2.0, Angle{}}, 0.3), "pose came before any odometry");
  drive(1.0);
  say(told({4.0, 2.5, Angle{}}, 0.3));
  expect_refused(told({-3.0, 2.0, Angle{}}, 0.3), "pose lies outside the map");
  expect_refused(told({3.0, 9.0, Angle{}}, 0.3), "pose lies outside the map");
  expect_refused(told({0.1, 2.0, Angle{}}, 0.3), "pose lies where the map has no free floor");
  auto message = told({2.0, 2.0, Angle{}}, 0.3);
  message.header.frame_id = "odom";
  expect_refused(message, "frame_id is not map");
  message.header.frame_id = "map";
  message.pose.pose.position.y = std::nan("");
  expect_refused(message, "y is no number of this world");
  expect_refused(told({2.0, 2.0, Angle{}}, 20.0), "covariance is wider than 10 m: it names no place");
}

INSTANTIATE_TEST_SUITE_P(Methods, InitialPose, testing::Values("grid", "particles", "sonar"),
                         [](const auto& of) { return std::string{of.param}; });

}  // namespace
}  // namespace docent::modules
