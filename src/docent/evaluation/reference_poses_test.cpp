#include "docent/evaluation/reference_poses.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

LoggedScan scan_at(double time, const Pose2& odom_from_base) {
  LoggedScan scan;
  scan.time = time_from_seconds(time);
  scan.odom_from_base = odom_from_base;
  return scan;
}

TEST(TimedPoses, AreReadSortedAndFaultsNameTheLine) {
  const auto poses = parse_timed_poses("# t x y theta\n 2 1.5 -2 3.1 # here\r\n\n1 0 0 0\n", "ref.txt");
  ASSERT_TRUE(poses) << poses.error().message;
  ASSERT_EQ(poses->size(), 2U);
  EXPECT_EQ((*poses)[0].time, time_from_seconds(1));
  EXPECT_NEAR((*poses)[1].map_from_base.y, -2.0, 1e-12);
  EXPECT_NEAR((*poses)[1].map_from_base.theta.radians(), 3.1, 1e-12);
  for (const char* bad : {"1 0 0 0\n1 2 3\n", "1 0 0 0\n1 2 3 4 5\n", "1 0 0 0\n1 2 x 4\n", "1 0 0 0\n1 2 nan 4\n",
                          "1 0 0 0\n1e11 0 0 0\n", "1 0 0 0\n1 2 3 4z\n"}) {
    const auto read = parse_timed_poses(bad, "ref.txt");
    ASSERT_FALSE(read) << bad;
    EXPECT_TRUE(read.error().message.starts_with("ref.txt:2: ")) << read.error().message;
  }
  EXPECT_FALSE(parse_timed_poses("# nothing\n", "ref.txt"));
}

TEST(ReferenceOf, FollowsOdometryBetweenTwoPosesAndMeetsBoth) {
  LaserLog log;  // odometry: a detour to the side between the poses; and it is turned against the map by 90 degrees
  log.scans = {scan_at(0.0, {0, 0, Angle{}}), scan_at(1.0, {1, 0.4, Angle{}}), scan_at(2.0, {2, 0, Angle{}}),
               scan_at(9.0, {9, 0, Angle{}})};
  const Angle north = Angle::degrees(90);
  const std::vector<TimedPose> poses{{time_from_seconds(0), {5, 5, north}}, {time_from_seconds(2), {5, 7.2, north}}};
  const ScanReference reference = reference_of(log, poses);
  ASSERT_EQ(reference.size(), 4U);
  ASSERT_TRUE(reference[0] && reference[1] && reference[2]);
  EXPECT_NEAR(reference[0]->y, 5.0, 1e-9);
  EXPECT_NEAR(reference[2]->y, 7.2, 1e-9);
  EXPECT_NEAR(reference[1]->x, 4.6, 1e-9);  // the detour
  EXPECT_NEAR(reference[1]->y, 6.1, 1e-9);  // half of what odometry fell short by
  EXPECT_FALSE(reference[3]);               // after the last pose
}

TEST(ReferenceOf, SaysNothingAcrossGapsAndTurnsButAtAPoseItself) {
  LaserLog log;
  log.scans = {scan_at(0.0, {}), scan_at(1.0, {}), scan_at(2.0, {}), scan_at(10.0, {}), scan_at(20.0, {})};
  const std::vector<TimedPose> poses{{time_from_seconds(0), {}},
                                     {time_from_seconds(2.0004), {0, 0, Angle::degrees(40)}},
                                     {time_from_seconds(20), {0, 0, Angle::degrees(40)}}};
  const ScanReference reference = reference_of(log, poses);
  EXPECT_TRUE(reference[0]);
  EXPECT_FALSE(reference[1]);  // somewhere in the turn
  EXPECT_TRUE(reference[2]);
  EXPECT_FALSE(reference[3]);  // 18 s without a pose
  EXPECT_TRUE(reference[4]);
}

TEST(LoggedReference, TakesTheLaserOffItsMountAndACorrectedPoseAsItIs) {
  LaserLog log;
  log.scans = {scan_at(0.0, {1, 2, Angle{}}), scan_at(1.0, {1, 2, Angle{}})};
  log.scans[0].base_from_laser = log.scans[1].base_from_laser = {0.25, 0, Angle{}};
  log.scans[0].logged_pose = {1.25, 2, Angle{}};
  log.scans[1].logged_pose = {7, 8, Angle{}};
  const ScanReference reference = logged_reference(log);
  EXPECT_NEAR(reference[0]->x, 1.0, 1e-12);
  EXPECT_NEAR(reference[1]->x, 7.0, 1e-12);
}

}  // namespace
}  // namespace docent
