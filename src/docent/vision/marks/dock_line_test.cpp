#include "docent/vision/marks/dock_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::vision {
namespace {

/// Corners of a tag as a camera on its mount would see it; the test's own geometry.
std::optional<SeenTag> seen_tag(const DockCamera& camera, const DockLineParams& params, const Pose2& base_from_tag,
                                double noise, Rng& rng) {
  SeenTag tag{params.tag, {}, 50.0};
  constexpr double kRight[4] = {-1.0, 1.0, 1.0, -1.0}, kUp[4] = {-1.0, -1.0, 1.0, 1.0};
  for (std::size_t i = 0; i < 4; ++i) {
    const Point2 floor = base_from_tag * Point2{0.0, 0.5 * kRight[i] * params.side};
    const double ahead = floor.x - camera.x, left = floor.y - camera.y;
    const double above = params.height + 0.5 * kUp[i] * params.side - camera.z;
    const double pan = camera.pan.radians(), down = camera.down.radians();
    const double level = std::cos(pan) * ahead + std::sin(pan) * left;
    const double depth = std::cos(down) * level - std::sin(down) * above;
    if (depth < 0.1) return std::nullopt;
    const Eigen::Vector3d at{std::sin(pan) * ahead - std::cos(pan) * left,
                             -std::sin(down) * level - std::cos(down) * above, depth};
    tag.corners[i] = camera.lens.pixel_of(at);
    tag.corners[i].column += noise * rng.normal();
    tag.corners[i].row += noise * rng.normal();
  }
  return tag;
}

TEST(TagPoses, HoldTheRightOneAndSayWhatTheMirrorIs) {
  Rng rng{1};
  const DockCamera camera;
  const DockLineParams params;
  for (int i = 0; i < 200; ++i) {
    const double turned = rng.uniform(-50.0, 50.0);
    const Pose2 base_from_tag{rng.uniform(0.8, 2.0), rng.uniform(-0.2, 0.2), Angle::degrees(180.0 + turned)};
    const auto tag = seen_tag(camera, params, base_from_tag, 0.1, rng);
    ASSERT_TRUE(tag);
    const auto poses = tag_poses(*tag, camera.lens, params.side);
    ASSERT_FALSE(poses.empty());
    ASSERT_LE(poses.size(), 2U);
    double nearest = 10.0;
    for (const TagPose& pose : poses) {
      // The tag's normal in the level camera's frame: right is minus left.
      const Eigen::Vector3d normal = pose.camera_from_tag.col(2);
      const Eigen::Vector3d truly{-std::sin(base_from_tag.theta.radians()), 0.0,
                                  std::cos(base_from_tag.theta.radians())};
      nearest = std::min(nearest, std::acos(std::min(1.0, normal.dot(truly))));
      EXPECT_NEAR(pose.position.z(), base_from_tag.x - camera.x, 0.05 * base_from_tag.x);
    }
    EXPECT_LT(nearest, 0.25) << turned;
    // Seen from above the mirror's plane leans, so the vertical one is known where the tag is turned enough.
    const auto known = resolved(poses, {0.0, -1.0, 0.0}, true, 0.05);
    if (!known) continue;
    EXPECT_GT(known->camera_from_tag.col(1).dot(Eigen::Vector3d{0.0, -1.0, 0.0}), 0.98);
  }
}

TEST(DockLine, IsWhereTheTagIsThoughTheMountIsWrongAndPicturesComeLate) {
  DockCamera camera, truth;
  truth.pan = Angle::degrees(0.5);
  truth.down = Angle::degrees(-0.5);
  const DockLineParams params;
  Rng rng{2};
  DockLine line{camera, params};
  const Pose2 odom_from_tag{2.0, 0.3, Angle::degrees(170.0)};
  std::optional<std::pair<Time, SeenTag>> late;
  for (int i = 0; i < 60; ++i) {
    const Time now = time_from_seconds(0.1 * i);
    const Pose2 base{0.02 * i, 0.1 * std::sin(0.1 * i), Angle::radians(0.15 * std::sin(0.2 * i))};
    line.add_odometry(now, base);
    if (late) {
      EXPECT_TRUE(line.add_tags(late->first, {late->second}));
    }
    late.reset();
    if (const auto tag = seen_tag(truth, params, inverse(base) * odom_from_tag, 0.2, rng)) late.emplace(now, *tag);
  }
  ASSERT_TRUE(line.estimate());
  const auto& found = *line.estimate();
  EXPECT_TRUE(found.is_sure);
  EXPECT_NEAR(found.odom_from_tag.x, 2.0, 0.02);
  EXPECT_NEAR(found.odom_from_tag.y, 0.3, 0.012);
  EXPECT_NEAR((found.odom_from_tag.theta - odom_from_tag.theta).radians(), 0.0, 0.03);
  EXPECT_GT(found.across_sigma, 0.0005);
  EXPECT_LT(found.across_sigma, 0.02);
  EXPECT_NEAR(found.pan_error.radians(), 0.5 * std::numbers::pi / 180.0, 0.005);
}

TEST(DockLine, NeverFlipsWhileItIsSure) {
  const DockCamera camera;
  const DockLineParams params;
  int sure = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    Rng rng{static_cast<std::uint64_t>(seed)};
    DockLine line{camera, params};
    const Pose2 odom_from_tag{2.2, 0.0, Angle::degrees(180.0 + rng.uniform(-25.0, 25.0))};
    for (int i = 0; i < 50; ++i) {
      const Pose2 base{0.02 * i, rng.normal(0.0, 0.002), Angle::radians(0.02 * rng.normal())};
      line.add_odometry(time_from_seconds(0.2 * i), base);
      const auto tag = seen_tag(camera, params, inverse(base) * odom_from_tag, 0.5, rng);
      ASSERT_TRUE(tag);
      (void)line.add_tags(time_from_seconds(0.2 * i), {*tag});
      ASSERT_TRUE(line.estimate());
      if (!line.estimate()->is_sure) continue;
      EXPECT_NEAR((line.estimate()->odom_from_tag.theta - odom_from_tag.theta).radians(), 0.0, 0.3) << seed << " " << i;
    }
    sure += line.estimate()->is_sure ? 1 : 0;
  }
  EXPECT_GE(sure, 15);
}

TEST(DockLine, SaysNothingWithoutOdometryOrWithAnotherTag) {
  const DockCamera camera;
  DockLineParams params;
  Rng rng{3};
  DockLine line{camera, params};
  auto tag = seen_tag(camera, params, {1.5, 0.0, Angle::degrees(180.0)}, 0.0, rng);
  EXPECT_FALSE(line.add_tags(time_from_seconds(1.0), {*tag}));
  line.add_odometry(time_from_seconds(1.0), {});
  EXPECT_FALSE(line.add_tags(time_from_seconds(1.5), {*tag})) << "later than all odometry";
  tag->id = 7;
  EXPECT_FALSE(line.add_tags(time_from_seconds(1.0), {*tag}));
  EXPECT_FALSE(line.estimate());
  tag->id = params.tag;
  EXPECT_TRUE(line.add_tags(time_from_seconds(1.0), {*tag}));
  line.forget();
  EXPECT_FALSE(line.estimate());
}

}  // namespace
}  // namespace docent::vision
