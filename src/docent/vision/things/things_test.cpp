#include <gtest/gtest.h>

#include <algorithm>

#include "docent/vision/depth/testing.h"
#include "docent/vision/things/floor_things.h"
#include "docent/vision/things/thing_map.h"
#include "docent/vision/things/thing_patch.h"
#include "docent/vision/things/thing_sight.h"

namespace docent::vision {
namespace {

using made_up_room::Box;
using made_up_room::Scene;

Box box_at(double x, double y, double wide, double high, double bottom = 0.0) {
  return {{x - 0.5 * wide, y - 0.5 * wide, bottom}, {x + 0.5 * wide, y + 0.5 * wide, bottom + high}};
}

FloorView view_of(const Scene& scene, FloorThingFinder* finder = nullptr) {
  Rng rng{7};
  const DepthCamera camera = made_up_room::front_camera();
  FloorThingFinder own{camera};
  return (finder != nullptr ? *finder : own).find(made_up_room::picture_of(scene, camera, 0.0, rng), rng);
}

TEST(FloorThings, MeasuresWhereACanStandsAndHowLargeItIs) {
  for (const double x : {1.1, 1.6, 2.2, 2.6}) {
    const FloorView view = view_of({{box_at(x, 0.3, 0.07, 0.12)}});
    ASSERT_EQ(view.things.size(), 1U) << x;
    const FloorThing& can = view.things.front();
    EXPECT_NEAR(can.middle.x, x, 0.03);
    EXPECT_NEAR(can.middle.y, 0.3, 0.02);
    EXPECT_NEAR(can.width, 0.07, 0.025);
    EXPECT_NEAR(can.height, 0.12, 0.02);
    EXPECT_LT(can.covariance.trace(), 0.01);
  }
}

TEST(FloorThings, FurnitureWallsAndTheEdgeOfATableAreNone) {
  const Scene room{
      {box_at(2.0, 0.7, 0.5, 0.7), Box{{2.9, -3.0, 0.0}, {3.0, 3.0, 2.5}}, box_at(1.7, -0.4, 0.3, 0.05, 0.3)}};
  EXPECT_TRUE(view_of(room).things.empty());
  EXPECT_TRUE(view_of(room).sees_floor);
}

TEST(FloorThings, TwoCansBesideEachOtherAreTwo) {
  EXPECT_EQ(view_of({{box_at(1.6, 0.15, 0.07, 0.12), box_at(1.6, -0.15, 0.07, 0.12)}}).things.size(), 2U);
}

TEST(FloorThings, SaysWhereTheFloorIsBare) {
  FloorThingFinder finder{made_up_room::front_camera()};
  static_cast<void>(view_of({{box_at(1.6, 0.3, 0.07, 0.12)}}, &finder));
  EXPECT_TRUE(finder.is_bare({1.6, -0.3}, 0.04));
  EXPECT_FALSE(finder.is_bare({1.6, 0.3}, 0.04));
  EXPECT_FALSE(finder.is_bare({-1.0, 0.0}, 0.04)) << "behind it";
}

ThingLook look_at(Point2 place, const std::string& object, bool is_named = true) {
  return {place, 0.0009 * Eigen::Matrix2d::Identity(), 0.07, 0.12, is_named, object};
}

TEST(ThingMap, JoinsLooksAtOneThingAndBecomesSurer) {
  ThingMap map;
  map.add(look_at({1.0, 1.0}, "can"), time_from_seconds(1.0));
  map.add(look_at({1.03, 0.98}, "can"), time_from_seconds(2.0));
  map.add(look_at({2.0, 1.0}, "wad"), time_from_seconds(2.0));
  ASSERT_EQ(map.things().size(), 2U);
  EXPECT_EQ(map.object_of(map.things()[0]), "") << "twice is not enough";
  map.add(look_at({0.99, 1.01}, "can"), time_from_seconds(3.0));
  EXPECT_EQ(map.object_of(map.things()[0]), "can");
  EXPECT_NEAR(map.things()[0].in_map.x, 1.007, 0.01);
  EXPECT_LT(map.things()[0].covariance(0, 0), 0.0005);
}

TEST(ThingMap, WhatIsMostlyNothingKnownHasNoName) {
  ThingMap map;
  for (int i = 0; i < 10; ++i) map.add(look_at({1.0, 1.0}, i % 2 == 0 ? "can" : ""), time_from_seconds(i));
  EXPECT_EQ(map.object_of(map.things()[0]), "");
}

TEST(ThingMap, ForgetsByBareFloorAndNotBySilence) {
  ThingMap map;
  map.add(look_at({1.0, 1.0}, "can"), time_from_seconds(1.0));
  const std::uint32_t id = map.things().front().id;
  for (int i = 0; i < 3; ++i) map.see_bare(id);
  map.add(look_at({1.0, 1.0}, "can"), time_from_seconds(900.0));
  ASSERT_EQ(map.things().size(), 1U);
  for (int i = 0; i < 4; ++i) map.see_bare(id);
  EXPECT_TRUE(map.things().empty());
}

/// A picture of a red block on a grey floor, and nothing else.
TEST(ThingPatch, CutsTheThingOutToScale) {
  LensParams params;
  params.columns = 320, params.rows = 240;
  params.focal_x = params.focal_y = 232.0;
  params.centre_x = 159.5, params.centre_y = 119.5;
  DepthCamera mount;
  mount.mount = {0.16, 0.05, 1.1, {}, Angle::degrees(28.0), {}};
  const FrontCamera camera{*Lens::make(params), mount.position(), mount.base_from_camera()};
  for (const double x : {1.2, 2.4}) {
    pictures::Image picture{320, 240, {120, 118, 112, 255}};
    const auto low = camera.pixel_of({x, 0.035, 0.0}), high = camera.pixel_of({x, -0.035, 0.12});
    ASSERT_TRUE(low && high);
    for (int row = static_cast<int>(high->y()); row <= static_cast<int>(low->y()); ++row)
      for (int column = static_cast<int>(low->x()); column <= static_cast<int>(high->x()); ++column)
        picture.set(column, row, {180, 20, 20, 255});
    const auto patch = thing_patch(picture, camera, {{x, 0.0}, 0.07, 0.12});
    ASSERT_TRUE(patch) << x;
    int shown = 0, red = 0;
    for (int row = 0; row < kPatchSide; ++row)
      for (int column = 0; column < kPatchSide; ++column) {
        shown += patch->at(column, row).red != 215 ? 1 : 0;  // the sheet's
        red += patch->at(column, row).green < 100 ? 1 : 0;
      }
    EXPECT_GT(red, 0.65 * shown) << "the rest is what lies before a thing without an upper side";
    const double area = shown * kPatchSize * kPatchSize / (kPatchSide * kPatchSide);
    EXPECT_NEAR(area, 0.07 * 0.12, 0.0008) << x;
    EXPECT_FALSE(thing_patch(picture, camera, {{0.3, 0.0}, 0.07, 0.12})) << "below the picture";
  }
}

TEST(ThingSight, PutsLooksOfADriveTogetherAndForgetsWhatWasPickedUp) {
  ThingSight sight{{}, {}, std::nullopt};
  EXPECT_EQ(sight.depth_camera(), nullptr);
  const DepthCamera camera = made_up_room::front_camera();
  sight.set_depth_camera(camera);
  Rng rng{5};
  const Scene scene{{box_at(2.6, 0.1, 0.07, 0.12)}};
  double now = 1.0;
  const auto look = [&](const Scene& seen, double x) {
    const auto patches = sight.see(made_up_room::picture_of(seen, camera, x, rng),
                                   {time_from_seconds(now), {10.0 + x, 20.0, {}}, 1e-4 * Eigen::Matrix3d::Identity()});
    EXPECT_TRUE(patches.empty()) << "no colours were seen";
    now += 0.2;
  };
  for (const double x : {0.2, 0.5, 0.8, 1.1}) look(scene, x);
  ASSERT_EQ(sight.map().things().size(), 1U);
  const MappedThing& thing = sight.map().things().front();
  EXPECT_EQ(thing.looks, 4);
  EXPECT_NEAR(thing.in_map.x, 12.6, 0.03);
  EXPECT_NEAR(thing.in_map.y, 20.1, 0.02);
  EXPECT_EQ(sight.map().object_of(thing), "") << "nobody has taught it anything";
  for (int i = 0; i < 4; ++i) look({}, 1.1);
  EXPECT_TRUE(sight.map().things().empty());
  EXPECT_EQ(sight.looked(), time_from_seconds(now - 0.2));
}

}  // namespace
}  // namespace docent::vision
