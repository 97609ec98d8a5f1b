#include "docent/geometry/point_transform.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(PointTransform, DoesWhatThePoseDoes) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 pose{0.37 * i, -1.9 * i, Angle::radians(0.61 * i)};
    const Point2 point{12.3 - i, 0.071 * i};
    EXPECT_EQ(PointTransform{pose} * point, pose * point) << i;
  }
}

}  // namespace
}  // namespace docent
