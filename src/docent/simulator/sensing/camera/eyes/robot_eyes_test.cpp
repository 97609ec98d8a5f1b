#include "docent/simulator/sensing/camera/eyes/robot_eyes.h"

#include <gtest/gtest.h>

namespace docent::simulator {
namespace {

World bright_hall() {
  World world;
  world.floor = {{0.0, 0.0}, {20.0, 0.0}, {20.0, 14.0}, {0.0, 14.0}};
  world.operating_area = world.floor;
  world.ceiling_height = 3.5;
  world.ceiling_style.seed = 8;
  return world;
}

class RobotEyesTest : public ::testing::Test {
 protected:
  RobotEyesTest() { renderer_.set_furnishing(furnish(bright_hall())); }
  /// How hard edges are: the mean square of what changes from column to column.
  double sharpness(double angular) const {
    RobotEyesParams params;
    params.up.read_noise = params.up.shot_noise = 0.0;
    Rng rng{1};
    const auto grey =
        RobotEyes{params}.look_up(renderer_, {.time = 1.0, .world_from_base = {9.0, 7.0, {}}, .angular = angular}, rng);
    double sum = 0.0;
    for (std::size_t i = 1; i < grey.size(); ++i) sum += (grey[i] - grey[i - 1]) * (grey[i] - grey[i - 1]);
    return sum / static_cast<double>(grey.size());
  }
  Renderer renderer_;
};

TEST_F(RobotEyesTest, ATurningRobotSeesAFuzzyCeiling) { EXPECT_LT(sharpness(2.0), 0.85 * sharpness(0.0)); }

TEST_F(RobotEyesTest, SeeTheSameForASeedAndTheGainBrightens) {
  const RobotEyes eyes{{}};
  const auto look = [&](double gain) {
    Rng rng{3};
    return eyes.look_up(renderer_, {.time = 2.0, .world_from_base = {5.0, 5.0, {}}, .gain = gain}, rng);
  };
  EXPECT_EQ(look(1.0), look(1.0));
  const auto sum = [](const std::vector<std::uint8_t>& grey) {
    double all = 0.0;
    for (const std::uint8_t g : grey) all += g;
    return all;
  };
  EXPECT_GT(sum(look(1.4)), 1.08 * sum(look(1.0)));
}

TEST_F(RobotEyesTest, ADepthCameraThatLooksDownSeesTheFloorWhereItsMountSays) {
  const RobotEyes eyes{{}};
  Rng rng{3};
  const Glimpse glimpse{.time = 2.0, .world_from_base = {5.0, 5.0, {}}};
  const auto depths = eyes.measure_depths(renderer_, glimpse, rng);
  const Eye& eye = eyes.truth().depth;
  const Viewpoint view = viewpoint_of(eye.mount, glimpse.world_from_base, eyes.lean_at(2.0));
  int seen = 0;
  for (int y = 130; y < eye.lens.height; y += 10)
    for (int x = 5; x < eye.lens.width; x += 10) {
      const double z = 0.001 * depths[static_cast<std::size_t>(y * eye.lens.width + x)];
      if (z == 0.0) continue;
      ++seen;
      const Vec3 ray = eye.lens.ray(x + 0.5, y + 0.5);
      const Vec3 at = view.eye + static_cast<float>(z / static_cast<double>(ray.z)) * view.to_world(ray);
      EXPECT_NEAR(at.z, 0.0F, 0.05F) << x << " " << y;
    }
  EXPECT_GT(seen, 300);
}

TEST(EyeRig, IsALittleDifferentFromWhatIsTold) {
  const EyeRig told = told_rig({});
  const EyeRig rig = true_rig(told, Rng{1}), other = true_rig(told, Rng{2});
  EXPECT_NE(to_yaml(rig), to_yaml(told));
  EXPECT_NE(to_yaml(rig), to_yaml(other));
  EXPECT_NEAR(rig.up.lens.focal_x, told.up.lens.focal_x, 0.02 * told.up.lens.focal_x);
  EXPECT_NEAR(rig.up.mount.tilt, told.up.mount.tilt, 0.03);
  const EyeRig large = told_rig({.width = 640, .height = 480, .fisheye = true});
  EXPECT_DOUBLE_EQ(large.front.lens.focal_x, 2.0 * told.front.lens.focal_x);
  EXPECT_EQ(large.up.lens.kind, LensKind::fisheye);
}

}  // namespace
}  // namespace docent::simulator
