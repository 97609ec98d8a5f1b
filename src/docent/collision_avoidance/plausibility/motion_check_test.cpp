#include "docent/collision_avoidance/plausibility/motion_check.h"

#include <gtest/gtest.h>

#include <deque>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::collision_avoidance::motion_check_test {
namespace {

using Finding = MotionCheck::Finding;

/// What is found in a drive of some seconds that begins at rest.
class MotionCheckTest : public ::testing::Test {
 protected:
  MotionCheckTest() {
    room.box(-4, -3, 7, 4);
    room.discs = {{{2.0, 2.0}, 0.3}, {{3.0, -1.5}, 0.25}};
  }
  /// @param scale  of all ranges @param lag  sweeps that are given late @param odometry  what it says of a metre driven
  Finding drive(double scale, std::size_t lag = 0, double odometry = 1.0) {
    MotionCheck check;
    Finding found = Finding::nothing;
    std::deque<SensorSweep> late;
    Pose2 at;
    Pose2 said;
    for (int i = 0; i < 60; ++i) {
      const double speed = i < 10 ? 0.0 : std::min(0.5, 0.05 * (i - 10));
      const double turn = i > 30 ? 0.4 : 0.0;
      at = at * Pose2{0.1 * speed, 0.0, Angle::radians(0.1 * turn)};
      said = said * Pose2{0.1 * speed * odometry, 0.0, Angle::radians(0.1 * turn)};
      late.push_back(room.sweep(1.0 + 0.1 * i, at));
      SensorSweep sweep = late[late.size() > lag ? late.size() - 1 - lag : 0];
      sweep.stamp = late.back().stamp;
      for (float& range : sweep.ranges) range *= static_cast<float>(scale);
      sweep.max_range *= scale;
      const Finding now = check.add(view_of(sweep, said));
      if (now == Finding::too_long || now == Finding::late) {
        scale_found = check.scale();
        lag_found = check.lag();
        way = norm(said.position());
        return now;
      }
      if (now == Finding::in_order) found = now;
    }
    return found;
  }
  RoomForTest room;
  double scale_found = 0.0;
  double lag_found = 0.0;
  double way = 0.0;
};

TEST_F(MotionCheckTest, AScannerInOrderIs) { EXPECT_EQ(drive(1.0), Finding::in_order); }

TEST_F(MotionCheckTest, PeopleWhoWalkAboutAreNoLie) {
  room.discs.clear();
  for (int i = 0; i < 12; ++i) room.discs.push_back({{0.8 + 0.2 * i, i % 2 == 0 ? 0.9 : -0.9}, 0.25});
  EXPECT_EQ(drive(1.0), Finding::in_order);
}

TEST_F(MotionCheckTest, TwiceAsLongShowsWithinHalfAMetre) {
  EXPECT_EQ(drive(2.0), Finding::too_long);
  EXPECT_NEAR(scale_found, 2.0, 0.6);
  EXPECT_LT(way, 0.5);
  EXPECT_EQ(drive(3.28), Finding::too_long);
}

TEST_F(MotionCheckTest, SweepsOfASecondAgoShow) {
  EXPECT_EQ(drive(1.0, 10), Finding::late);
  EXPECT_GE(lag_found, 0.75);  // from rest, older ones look the same
}

TEST_F(MotionCheckTest, AnOdometryThatIsALittleOffIsNoLie) {
  EXPECT_EQ(drive(1.0, 0, 1.05), Finding::in_order);
  EXPECT_EQ(drive(1.0, 1), Finding::in_order);  // nor a tenth of a second
}

}  // namespace
}  // namespace docent::collision_avoidance::motion_check_test
