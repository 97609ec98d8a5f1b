#include "docent/vision/pan_tilt_zoom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace docent::vision {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

class PanTiltZoomTest : public ::testing::Test {
 protected:
  PanTiltZoomParams params_;
  PanTiltZoom camera_{{{1.0, 2.0}, 2.7}, {10.0, 10.0}, params_};
  /// [rad] of the robot's waist off the middle of the picture.
  double off(const View& view, Point2 robot) const {
    const Point2 offset = robot - Point2{1.0, 2.0};
    return std::abs(std::remainder(std::atan2(offset.y, offset.x) - view.pan, 2.0 * std::numbers::pi));
  }
};

TEST_F(PanTiltZoomTest, BringsTheRobotIntoTheMiddleAndShowsWhatIsRoundIt) {
  const View near = camera_.follow(Point2{4.0, 2.0}, 0.1);
  EXPECT_NEAR(near.pan, 0.0, 1e-9);
  EXPECT_NEAR(near.tilt, -std::atan2(2.0, 3.0), 1e-9);
  const View far = camera_.follow(Point2{1.0, 22.0}, 0.1);
  EXPECT_NEAR(far.pan, 90.0 * kDegree, 1e-9);
  EXPECT_LT(far.field_of_view, near.field_of_view) << "the same metres are smaller from afar";
}

TEST_F(PanTiltZoomTest, DoesNotFidget) {
  const View first = camera_.follow(Point2{11.0, 2.0}, 0.1);
  for (double y = 1.9; y < 2.1; y += 0.02) EXPECT_EQ(camera_.follow(Point2{11.0, y}, 0.1).pan, first.pan);
}

TEST_F(PanTiltZoomTest, NeverLosesARobotThatIsWhereItBelievesToBe) {
  // Round the hall, with each step of 0.3 m, the robot stays well inside the picture.
  for (double way = 0.0; way < 60.0; way += 0.3) {
    const Point2 robot{8.0 + 6.0 * std::cos(way / 6.0), 8.0 + 6.0 * std::sin(way / 6.0)};
    const View& view = camera_.follow(robot, 0.2);
    EXPECT_LT(off(view, robot), 0.3 * view.field_of_view) << way;
  }
}

TEST_F(PanTiltZoomTest, IsWiderWhenUnsureAndShowsAllWhenTheRobotIsLost) {
  const double sure = camera_.follow(Point2{16.0, 2.0}, 0.1).field_of_view;
  const double unsure = camera_.follow(Point2{16.0, 2.0}, 1.5).field_of_view;
  EXPECT_GT(unsure, 1.3 * sure);
  const View lost = camera_.follow(std::nullopt, 0.0);
  EXPECT_NEAR(lost.field_of_view, params_.widest * kDegree, 1e-9);
  EXPECT_NEAR(lost.pan, std::atan2(8.0, 9.0), 1e-9);
  EXPECT_EQ(camera_.follow(Point2{4.0, 2.0}, std::nan("")).pan, lost.pan);
}

TEST_F(PanTiltZoomTest, StraightBelowItKeepsItsPan) {
  const View before = camera_.follow(Point2{4.0, 2.0}, 0.1);
  const View below = camera_.follow(Point2{1.01, 2.01}, 0.1);
  EXPECT_EQ(below.pan, before.pan);
  EXPECT_GE(below.tilt, -85.0 * kDegree - 1e-9);
}

TEST(PanTiltZoomParams, RefusesNonsense) {
  EXPECT_TRUE(PanTiltZoomParams{}.validate());
  EXPECT_FALSE((PanTiltZoomParams{.narrowest = 70.0}.validate()));
  EXPECT_FALSE((PanTiltZoomParams{.widest = 180.0}.validate()));
  EXPECT_FALSE((PanTiltZoomParams{.shown_m = std::nan("")}.validate()));
}

}  // namespace
}  // namespace docent::vision
