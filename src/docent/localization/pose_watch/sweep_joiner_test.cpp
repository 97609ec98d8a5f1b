#include "docent/localization/pose_watch/sweep_joiner.h"

#include <gtest/gtest.h>

#include <numbers>

namespace docent::localization::sweep_joiner_test {
namespace {

Time at(double s) { return time_from_seconds(100.0 + s); }

/// A robot with a laser of three beams ahead and one behind.
class SweepJoiner : public ::testing::Test {
 protected:
  void see(std::size_t laser, Time stamp, float range) {
    const std::vector<float> ranges(3, range);
    joiner.keep(laser, stamp, {ranges, Angle::degrees(-10.0), Angle::degrees(10.0).radians(), 0.02, 10.0});
  }

  OdometryTrail odometry;
  localization::SweepJoiner joiner{{Pose2{0.1, 0.0, {}}, Pose2{-0.1, 0.0, Angle::radians(std::numbers::pi)}}};
};

TEST_F(SweepJoiner, JoinsAllLasersAboutTheRobotsCentre) {
  EXPECT_FALSE(joiner.join(odometry)) << "nothing has come";
  EXPECT_FALSE(joiner.has_new());
  odometry.add(at(0.0), {1.0, 2.0, {}});
  see(0, at(0.0), 2.0F);
  see(1, at(0.0), 3.0F);
  EXPECT_TRUE(joiner.has_new());
  EXPECT_EQ(joiner.newest(), at(0.0));
  const auto joined = joiner.join(odometry);
  ASSERT_TRUE(joined);
  ASSERT_EQ(joined->sweep.beams.size(), 6U);
  EXPECT_EQ(joined->stamp, at(0.0));
  EXPECT_EQ(joined->odom_from_base.y, 2.0);
  EXPECT_NEAR(joined->sweep.beams[1].range, 2.1, 1e-6);
  EXPECT_NEAR(joined->sweep.beams[4].range, 3.1, 1e-6);
  EXPECT_FALSE(joiner.join(odometry)) << "nothing is new";
  EXPECT_FALSE(joiner.has_new());
}

TEST_F(SweepJoiner, TheStampIsThatOfTheNewestAndOlderOnesAreMovedByOdometry) {
  odometry.add(at(0.0), {0.0, 0.0, {}});
  odometry.add(at(0.2), {0.1, 0.0, {}});
  see(1, at(0.0), 3.0F);
  see(0, at(0.2), 2.0F);
  const auto joined = joiner.join(odometry);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->stamp, at(0.2));
  EXPECT_NEAR(joined->sweep.beams[1].range, 2.1, 1e-6);
  EXPECT_NEAR(joined->sweep.beams[4].range, 3.2, 1e-6) << "it has left that behind";
}

TEST_F(SweepJoiner, AScanOfAnotherTimeIsLeftOut) {
  for (int i = 0; i <= 10; ++i) odometry.add(at(0.1 * i), {});
  see(1, at(0.0), 3.0F);
  see(0, at(0.5), 2.0F);
  EXPECT_EQ(joiner.join(odometry)->sweep.beams.size(), 3U);
  see(0, at(0.2), 2.0F);
  EXPECT_EQ(joiner.join(odometry)->sweep.beams.size(), 6U) << "an old scan counts as long as it is of about that time";
}

TEST_F(SweepJoiner, ALaserThatIsLateTakesPart) {
  for (int i = 0; i <= 10; ++i) odometry.add(at(0.1 * i), {});
  for (int i = 5; i <= 9; ++i) {
    see(1, at(0.1 * i - 0.35), 3.0F);
    see(0, at(0.1 * i), 2.0F);
    EXPECT_EQ(joiner.join(odometry)->sweep.beams.size(), 6U);
  }
  see(0, at(1.0), 2.0F);
  EXPECT_EQ(joiner.join(odometry)->sweep.beams.size(), 3U) << "what is not new is too old";
}

TEST_F(SweepJoiner, WaitsForTheOdometryOfThen) {
  odometry.add(at(0.0), {});
  see(0, at(0.5), 2.0F);
  EXPECT_FALSE(joiner.join(odometry));
  odometry.add(at(0.5), {0.2, 0.0, {}});
  const auto joined = joiner.join(odometry);
  ASSERT_TRUE(joined) << "the scan was kept";
  EXPECT_EQ(joined->odom_from_base.x, 0.2);
}

TEST_F(SweepJoiner, AScanThatComesTwiceIsNoNewOne) {
  odometry.add(at(0.5), {});
  see(0, at(0.5), 2.0F);
  ASSERT_TRUE(joiner.join(odometry));
  see(0, at(0.5), 2.0F);
  EXPECT_FALSE(joiner.join(odometry));
}

TEST_F(SweepJoiner, OfEachLaserTheNewestScanCounts) {
  odometry.add(at(0.0), {});
  see(0, at(0.0), 2.0F);
  see(0, at(0.0), 5.0F);
  const auto joined = joiner.join(odometry);
  ASSERT_EQ(joined->sweep.beams.size(), 3U);
  EXPECT_NEAR(joined->sweep.beams[1].range, 5.1, 1e-6);
}

TEST_F(SweepJoiner, TakesALaserFromWhereItIsFoundToBeMounted) {
  odometry.add(at(0.0), {});
  odometry.add(at(0.1), {});
  const Pose2 before = joiner.mount(0, Pose2{0.3, 0.0, {}});
  see(0, at(0.1), 2.0F);
  const auto after = joiner.join(odometry);
  ASSERT_TRUE(after);
  double farthest = 0.0;
  for (const auto& beam : after->sweep.beams) farthest = std::max(farthest, beam.range);
  EXPECT_NEAR(farthest, 2.3, 1e-6) << before.x;
}

}  // namespace
}  // namespace docent::localization::sweep_joiner_test
