#include "docent/modules/edge/scene_camera_module.h"

#include <cmath>
#include <numbers>

#include "docent/modules/shared/module_bench.h"

namespace docent::modules {
namespace {

class SceneCameraTest : public ModuleBench {
 protected:
  SceneCameraTest() : ModuleBench{"scene_camera", make_scene_camera} {
    museum.area = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
    museum.scene_camera = museum::SceneCamera{{1.0, 1.0}, 2.7};
    keep(topics::kSceneCameraView, view_, views_);
  }
  void believe(double x, double y, double deviation, bool is_sure) {
    docent_msgs::Belief belief;
    belief.header.stamp = to_message(hub.now());
    belief.localized = is_sure;
    docent_msgs::Hypothesis best;
    best.x = x;
    best.y = y;
    best.covariance = {deviation * deviation, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0, 1e-4};
    best.mass = 1.0;
    belief.hypotheses = {best};
    beliefs_.publish(belief);
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(hub.now()), "odom"};
    odometry_.publish(odometry);
    run(1.0);
  }
  transport::Publisher<docent_msgs::Belief> beliefs_ = world->publisher(topics::kBelief);
  transport::Publisher<nav_msgs::Odometry> odometry_ = world->publisher(topics::kOdometry);
  docent_msgs::CameraView view_;
  int views_ = 0;
};

TEST_F(SceneCameraTest, LooksAtTheRobotAndWiderWhenItIsUnsure) {
  start();
  believe(9.0, 1.0, 0.1, true);
  EXPECT_EQ(views_, 2) << "twice a second";
  EXPECT_NEAR(view_.pan, 0.0, 1e-9);
  const double sure = view_.field_of_view;
  believe(1.0, 9.0, 1.5, true);
  EXPECT_NEAR(view_.pan, 0.5 * std::numbers::pi, 1e-9);
  EXPECT_GT(view_.field_of_view, 1.2 * sure);
  EXPECT_EQ(view_.header.frame_id, "map");
}

TEST_F(SceneCameraTest, ShowsTheHallWhileTheRobotIsLost) {
  start();
  believe(9.0, 1.0, 0.1, false);
  EXPECT_NEAR(view_.pan, 0.25 * std::numbers::pi, 1e-9) << "towards the middle of the area";
}

TEST_F(SceneCameraTest, DoesNothingInAMuseumWithout) {
  museum.scene_camera.reset();
  start();
  believe(9.0, 1.0, 0.1, true);
  EXPECT_EQ(views_, 0);
}

TEST_F(SceneCameraTest, RefusesNonsense) {
  ASSERT_TRUE(config.set("scene_camera.widest=200"));
  EXPECT_FALSE(make_scene_camera({*world, museum, config, state, 1, true}));
}

}  // namespace
}  // namespace docent::modules
