#include "docent/vision/depth/depth_sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "docent/vision/depth/testing.h"

namespace docent::vision {
namespace {

using made_up_room::Box;
using made_up_room::front_camera;
using made_up_room::picture_of;
using made_up_room::Scene;

/// Looks `times` times from one place.
void look_at(DepthSight& sight, const Scene& scene, int times, Rng& rng, double x = 0.0,
             const DepthCamera& camera = front_camera()) {
  for (int i = 0; i < times; ++i) {
    const auto seen = sight.see(picture_of(scene, camera, x, rng), {x, 0.0, {}});
    ASSERT_TRUE(seen) << seen.error().message;
  }
}

double nearest_line(const DepthSight& sight, double x = 0.0) {
  double nearest = 100.0;
  for (const SeenLine& line : sight.lines({x, 0.0, {}})) nearest = std::min(nearest, distance(line.line, {0.0, 0.0}));
  return nearest;
}

TEST(DepthSight, EmptyFloorIsFreeWhileTheCameraShakes) {
  DepthSight sight{front_camera()};
  Rng rng{1};
  for (int i = 0; i < 30; ++i) look_at(sight, {.shake = 0.3 * rng.normal()}, 1, rng);
  EXPECT_TRUE(sight.cells().empty()) << sight.cells().size() << " cells";
}

TEST(DepthSight, SeesLowThingsAndTheEdgeOfATableWhereTheyAre) {
  for (const auto& [box, where] : {std::pair{Box{{1.2, -0.1, 0.0}, {1.4, 0.1, 0.08}}, 1.2},
                                   std::pair{Box{{1.0, -0.5, 0.72}, {1.6, 0.5, 0.76}}, 1.0}}) {
    DepthSight sight{front_camera()};
    Rng rng{2};
    look_at(sight, {.boxes = {box}}, 3, rng);
    ASSERT_FALSE(sight.cells().empty());
    EXPECT_NEAR(nearest_line(sight), where, 0.06);
    for (const SeenLine& line : sight.lines({})) {
      EXPECT_FALSE(line.is_drop);
      EXPECT_GT(line.across_sigma, 0.01);
      EXPECT_LT(line.across_sigma, 0.1);
    }
    EXPECT_LE(sight.lines({}).size(), 12U) << "a few lines";
  }
}

TEST(DepthSight, WhatHangsHigherThanTheRobotAndACarpetAreFree) {
  DepthSight sight{front_camera()};
  Rng rng{3};
  look_at(sight, {.boxes = {{{1.0, -1.0, 1.5}, {2.0, 1.0, 1.6}}, {{1.0, -0.5, 0.0}, {2.0, 0.5, 0.015}}}}, 5, rng);
  EXPECT_TRUE(sight.cells().empty());
}

TEST(DepthSight, AnEdgeOfTheFloorIsADropThatSilenceNeverFrees) {
  DepthSight sight{front_camera()};
  Rng rng{4};
  look_at(sight, {.floor_until = 1.5}, 4, rng);
  double nearest = 100.0;
  for (const SeenLine& line : sight.lines({}))
    if (line.is_drop) nearest = std::min(nearest, distance(line.line, {0.0, 0.0}));
  EXPECT_NEAR(nearest, 1.5, 0.12);
  const std::size_t drops = sight.cells().size();
  // Black pictures, and pictures of which half is black, say nothing.
  DepthPicture black = picture_of({.floor_until = 1.5}, front_camera(), 0.0, rng);
  std::fill(black.depth.begin(), black.depth.begin() + static_cast<std::ptrdiff_t>(black.depth.size() * 7 / 10), 0.0F);
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(sight.see(black, {}));
  EXPECT_GE(sight.cells().size(), drops);
  std::fill(black.depth.begin(), black.depth.end(), 0.0F);
  EXPECT_FALSE(sight.see(black, {}));
  EXPECT_GE(sight.cells().size(), drops);
  // Floor that is seen in its place frees it.
  look_at(sight, {}, 6, rng);
  EXPECT_TRUE(sight.cells().empty());
}

TEST(DepthSight, AFloorThatDoesNotAnswerIsADropAfterSomePictures) {
  DepthSight sight{front_camera()};
  Rng rng{5};
  DepthPicture hole = picture_of({}, front_camera(), 0.0, rng);
  for (int row = 100; row < 160; ++row)
    for (int column = 80; column < 240; ++column) hole.depth[hole.index(column, row)] = 0.0F;
  ASSERT_TRUE(sight.see(hole, {}));
  EXPECT_TRUE(sight.cells().empty()) << "one picture may fail";
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(sight.see(hole, {}));
  ASSERT_FALSE(sight.cells().empty());
  EXPECT_TRUE(sight.cells().front().is_drop);
}

TEST(DepthSight, APersonWhoHasPassedLeavesNothingBehind) {
  DepthSight sight{front_camera()};
  Rng rng{6};
  // Five pictures a second; across at 1 m/s, 1.5 m ahead, with a wall behind.
  const Box wall{{3.5, -4.0, 0.0}, {3.6, 4.0, 2.5}};
  std::size_t most = 0;
  for (double y = -2.0; y <= 2.0; y += 0.2) {
    look_at(sight, {.boxes = {wall, {{1.4, y - 0.2, 0.0}, {1.6, y + 0.2, 1.7}}}}, 1, rng);
    most = std::max(most, sight.cells().size());
  }
  EXPECT_GT(most, 10U) << "the person was seen";
  look_at(sight, {.boxes = {wall}}, 5, rng);  // a second
  for (const LayerCell& cell : sight.cells()) EXPECT_GT(cell.centre.x, 3.3) << cell.centre.y;
}

TEST(DepthSight, ATableStaysWhenTheRobotLooksBelowIt) {
  DepthCamera camera = front_camera();
  camera.mount.down = Angle::degrees(20.0);  // the table's edge, 1.3 m before it, is in view
  DepthSight sight{camera};
  Rng rng{7};
  const Scene table{.boxes = {{{1.5, -0.6, 0.86}, {2.1, 0.6, 0.9}}}};
  look_at(sight, table, 3, rng, 0.0, camera);
  EXPECT_NEAR(nearest_line(sight), 1.5, 0.06);
  // It comes nearer, and then looks at the floor below.
  for (double x = 0.0; x < 0.9; x += 0.05) look_at(sight, table, 1, rng, x, camera);
  look_at(sight, table, 20, rng, 0.9, camera);
  EXPECT_NEAR(nearest_line(sight, 0.9), 0.6, 0.08);
}

TEST(DepthSight, RefusesPicturesOfAnotherSize) {
  DepthSight sight{front_camera()};
  EXPECT_FALSE(sight.see({10, 10, std::vector<float>(100, 1.0F)}, {}));
}

TEST(GroundPlane, IsFoundThoughTheCameraLooksAskewAndATableFillsTheView) {
  Rng rng{8};
  for (const double shake : {-2.5, -1.0, 0.0, 1.0, 2.5}) {
    const Scene scene{.boxes = {{{0.9, -0.2, 0.7}, {1.6, 1.0, 0.74}}}, .shake = shake};
    const DepthCamera camera = front_camera();
    const DepthPicture picture = picture_of(scene, camera, 0.0, rng);
    DepthPoints points;
    points.fill(camera, picture);
    const GroundPlane plane = find_ground_plane(picture, points, {}, rng);
    ASSERT_TRUE(plane.is_seen);
    // The camera looks lower than it knows: the floor seems to rise.
    EXPECT_NEAR(std::asin(-plane.normal.x()) * 180.0 / std::numbers::pi, shake, 0.25);
    EXPECT_NEAR(plane.normal.y(), 0.0, 0.005);
  }
}

}  // namespace
}  // namespace docent::vision
