#include "docent/modules/eyes/dock_module.h"

#include <algorithm>

#include "docent/messages/dock_topics.h"
#include "docent/modules/eyes/tag_scene_for_test.h"
#include "docent/modules/shared/module_bench.h"

namespace docent::modules::dock_module_test {
namespace {

const Pose2 kCharger{3.0, 1.0, Angle::degrees(30.0)};  // map
constexpr double kContact = 0.35;                      // [m]

/// A base that does what `dock` wants, before a charger; its odometry begins at the map's origin, turned.
class DockTest : public ModuleBench {
 protected:
  DockTest() : ModuleBench{"dock", make_dock} {
    for (const char* setting : {"dock.enabled=true", "dock.place.tilt=0"}) EXPECT_TRUE(config.set(setting));
    keep(topics::kDockDrive, wish_, wishes_);
    keep(topics::kDockState, state_, states_);
    keep(topics::kDockPose, pose_, poses_);
  }
  /// Before the contacts, in the charger's frame.
  void stand(double x, double y, double degrees) { map_from_base_ = kCharger * Pose2{x, y, Angle::degrees(degrees)}; }
  void order(const std::string& id) {
    docent_msgs::DriveGoal goal;
    goal.id = id, goal.x = kCharger.x, goal.y = kCharger.y, goal.theta = kCharger.theta.radians();
    orders_.publish(goal);
  }
  [[nodiscard]] Pose2 odom_from_base() const { return inverse(kMapFromOdom) * map_from_base_; }
  void say_odometry() {
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(hub.now()), "odom"};
    odometry.pose.pose = to_message(odom_from_base());
    odometry_.publish(odometry);
    docent_msgs::Belief belief;
    belief.header.stamp = to_message(hub.now());
    belief.localized = true;
    // A few centimetres and degrees wrong.
    const Pose2 believed = kMapFromOdom * Pose2{0.04, -0.05, Angle::degrees(1.5)} * odom_from_base();
    belief.hypotheses.resize(1);
    belief.hypotheses[0].x = believed.x, belief.hypotheses[0].y = believed.y;
    belief.hypotheses[0].theta = believed.theta.radians();
    belief.hypotheses[0].mass = 1.0;
    belief.odom_pose = to_message(odom_from_base());
    beliefs_.publish(belief);
  }
  void say_battery() {
    const Pose2 at = inverse(kCharger) * map_from_base_;
    sensor_msgs::BatteryState battery;
    battery.present = true, battery.percentage = 0.3F;
    const bool has_current = std::abs(at.y) < 0.02 && at.x > -0.01 && at.x < 0.05;
    battery.power_supply_status = has_current ? 1 : 2;
    battery_.publish(battery);
  }
  /// [s], until it is over.
  void pass(double duration) {
    for (double t = 0.0; t < duration; t += 0.05) {
      say_odometry();
      if (++ticks_ % 5 == 0 && sends_) {
        infos_.publish(scene_.info());
        // The tag stands before the contacts; the picture is on its way for a moment.
        auto image =
            scene_.picture(inverse(kCharger * Pose2{kContact, 0.0, Angle::degrees(180.0)}) * map_from_base_, rng_);
        if (is_black_) std::fill(image.data.begin(), image.data.end(), std::uint8_t{0});
        image.header = {to_message(hub.now()), "front_camera"};
        images_.publish(image);
      }
      if (ticks_ % 20 == 0) say_battery();
      const int before = wishes_;
      run(0.05);
      if (wishes_ == before) wish_ = {};
      map_from_base_ = map_from_base_ * Pose2{0.05 * wish_.linear, 0.0, Angle::radians(0.05 * wish_.angular)};
      if (state_.state == "arrived" || (state_.state == "unreachable" && !state_.id.empty())) return;
    }
  }

  static constexpr double kFar = 1.5;
  const Pose2 kMapFromOdom{1.0, -2.0, Angle::degrees(50.0)};
  tag_scene::TagScene scene_;
  Rng rng_{5};
  Pose2 map_from_base_;
  bool sends_ = true, is_black_ = false;
  int ticks_ = 0;
  transport::Publisher<sensor_msgs::Image> images_ = world->publisher(topics::kFrontImage);
  transport::Publisher<sensor_msgs::CameraInfo> infos_ = world->publisher(topics::kFrontInfo);
  transport::Publisher<nav_msgs::Odometry> odometry_ = world->publisher(topics::kOdometry);
  transport::Publisher<docent_msgs::Belief> beliefs_ = world->publisher(topics::kBelief);
  transport::Publisher<sensor_msgs::BatteryState> battery_ = world->publisher(topics::kBattery);
  transport::Publisher<docent_msgs::DriveGoal> orders_ = world->publisher(topics::kDockOrder);
  docent_msgs::Drive wish_;
  docent_msgs::GoalState state_;
  geometry_msgs::PoseWithCovarianceStamped pose_;
  int wishes_ = 0, states_ = 0, poses_ = 0;
};

TEST_F(DockTest, DrivesToTheContacts) {
  stand(-kFar, 0.4, -25.0);
  start();
  pass(1.0);
  EXPECT_EQ(state_.state, "idle");
  EXPECT_EQ(wishes_, 0) << "nobody has ordered it";
  order("d/1");
  pass(90.0);
  EXPECT_EQ(state_.state, "arrived") << state_.reason;
  EXPECT_EQ(state_.id, "d/1");
  const Pose2 at = inverse(kCharger) * map_from_base_;
  EXPECT_NEAR(at.y, 0.0, 0.01);
  EXPECT_NEAR(at.theta.degrees(), 0.0, 4.0);
  ASSERT_GT(poses_, 5);
  const Pose2 tag = kMapFromOdom * from_message(pose_.pose.pose);
  const Pose2 truth = kCharger * Pose2{kContact, 0.0, Angle::degrees(180.0)};
  EXPECT_LT(distance(tag.position(), truth.position()), 0.02);
  EXPECT_GT(pose_.pose.covariance[0], 0.0);
}

TEST_F(DockTest, WithoutATagItSaysSo) {
  stand(-kFar, 0.0, 0.0);
  scene_.id = 9;
  start();
  pass(1.0);
  order("d/1");
  pass(40.0);
  EXPECT_EQ(state_.state, "unreachable");
  EXPECT_NE(state_.reason.find("no tag 0"), std::string::npos) << state_.reason;
  EXPECT_NEAR(distance(map_from_base_.position(), (kCharger * Pose2{-kFar, 0.0, {}}).position()), 0.0, 0.01);
}

TEST_F(DockTest, AnEyeThatFailsIsNamedAndNothingIsDrivenByIt) {
  stand(-kFar, 0.0, 0.0);
  is_black_ = true;
  start();
  pass(2.0);
  EXPECT_EQ(state_.state, "unreachable");
  EXPECT_NE(module->health().reason.find("front camera: nothing is on its pictures"), std::string::npos)
      << module->health().reason;
  order("d/1");
  pass(3.0);
  EXPECT_EQ(state_.state, "unreachable");
  EXPECT_EQ(state_.id, "d/1");
  sends_ = false;
  run(2.0);
  EXPECT_NE(module->health().reason.find("no picture any more"), std::string::npos) << module->health().reason;
}

TEST_F(DockTest, SaysNothingWhereThereIsNoCamera) {
  ASSERT_TRUE(config.set("dock.enabled=false"));
  stand(-kFar, 0.0, 0.0);
  start();
  order("d/1");
  pass(2.0);
  EXPECT_EQ(states_ + wishes_ + poses_, 0);
  EXPECT_EQ(module->health().state, "ready");
}

}  // namespace
}  // namespace docent::modules::dock_module_test
