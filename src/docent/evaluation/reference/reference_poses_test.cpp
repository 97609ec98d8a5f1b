#include "docent/evaluation/reference/reference_poses.h"

#include <gtest/gtest.h>

namespace docent::evaluation {
namespace {

recording::LoggedScan scan_at(double time, const Pose2& odom_from_base) {
  recording::LoggedScan scan;
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

const Angle kNorth = Angle::degrees(90);

TEST(ReferenceOf, FollowsOdometryBetweenTwoPosesAndMeetsBoth) {
  recording::LaserLog
      log;  // odometry: a detour to the side between the poses; and it is turned against the map by 90 degrees
  log.scans = {scan_at(0.0, {0, 0, Angle{}}), scan_at(1.0, {1, 0.4, Angle{}}), scan_at(2.0, {2, 0, Angle{}}),
               scan_at(9.0, {9, 0, Angle{}})};
  const std::vector<TimedPose> of_scans{{time_from_seconds(0), {5, 5, kNorth}},
                                        {time_from_seconds(2), {5, 7.1, kNorth}}};
  const std::vector<TimedPose> of_another_clock{{time_from_seconds(-0.001), {5, 5, kNorth}},
                                                {time_from_seconds(2.001), {5, 7.1, kNorth}}};
  for (const auto& poses : {of_scans, of_another_clock}) {
    const ScanReference reference = reference_of(log, poses);
    ASSERT_EQ(reference.size(), 4U);
    ASSERT_TRUE(reference[0] && reference[1] && reference[2]);
    EXPECT_NEAR(reference[0]->y, 5.0, 0.01);
    EXPECT_NEAR(reference[2]->y, 7.1, 0.01);
    EXPECT_NEAR(reference[1]->x, 4.6, 0.01);   // the detour
    EXPECT_NEAR(reference[1]->y, 6.05, 0.01);  // half of what odometry fell short by
    EXPECT_FALSE(reference[3]);                // after the last pose
  }
}

TEST(ReferenceOf, IsNotMisledByStampsOfArrival) {
  // A robot at 1 m/s, a scan every second. Poses of scans that the log does not hold any more lie between them; their
  // stamps are those of their arrival, three at once.
  recording::LaserLog log;
  std::vector<TimedPose> poses;
  for (int i = 0; i < 20; ++i) log.scans.push_back(scan_at(i, {0.97 * i, 0, Angle{}}));
  for (const double x : {0.0, 4.0, 8.0, 12.0, 16.0}) {
    poses.push_back({time_from_seconds(x), {x, 0, Angle{}}});
    for (const double late : {1.3, 1.9, 2.5})
      poses.push_back({time_from_seconds(x + 2.9 + 0.001 * late), {x + late, 0, Angle{}}});
  }
  const ScanReference reference = reference_of(log, poses);
  for (std::size_t i = 0; i <= 16; ++i) {
    ASSERT_TRUE(reference[i]) << i;
    EXPECT_NEAR(reference[i]->x, static_cast<double>(i), 1e-9);
  }
  EXPECT_FALSE(reference[17]);  // no scan after it has a pose
  ReferenceGaps only_known;
  only_known.between_own_scans = false;
  const ScanReference known = reference_of(log, poses, only_known);
  EXPECT_TRUE(known[4]);
  EXPECT_FALSE(known[5]);
}

TEST(ReferenceOf, SaysNothingWhereOdometryDisagreesWithThePoses) {
  recording::LaserLog log;
  log.scans = {scan_at(0.0, {}), scan_at(1.0, {}), scan_at(2.0, {}), scan_at(3.0, {}), scan_at(4.0, {})};
  const std::vector<TimedPose> poses{{time_from_seconds(0), {}},
                                     {time_from_seconds(2.000004), {0, 0, Angle::degrees(40)}},
                                     {time_from_seconds(4), {0.1, 0, Angle::degrees(40)}}};
  const ScanReference reference = reference_of(log, poses);
  EXPECT_TRUE(reference[0] && reference[2] && reference[4]);
  EXPECT_FALSE(reference[1]);  // somebody turned it
  EXPECT_TRUE(reference[3]);
  const std::vector<TimedPose> of_another_clock{{time_from_seconds(0.5), {}},
                                                {time_from_seconds(1.5), {0.4, 0, Angle{}}}};
  EXPECT_FALSE(reference_of(log, of_another_clock)[1]);
}

TEST(ReferenceOf, SaysNothingAcrossGapsAndTurnsOfAnotherClock) {
  recording::LaserLog log;
  log.scans = {scan_at(1.0, {}), scan_at(2.0, {0, 0, Angle::degrees(40)}), scan_at(10.0, {0, 0, Angle::degrees(40)}),
               scan_at(19.0, {0, 0, Angle::degrees(40)})};
  const std::vector<TimedPose> poses{{time_from_seconds(0.9), {}},
                                     {time_from_seconds(2.1), {0, 0, Angle::degrees(40)}},
                                     {time_from_seconds(18), {0, 0, Angle::degrees(40)}},
                                     {time_from_seconds(20), {0, 0, Angle::degrees(40)}}};
  const ScanReference reference = reference_of(log, poses);
  EXPECT_FALSE(reference[0] || reference[1]);  // somewhere in the turn
  EXPECT_FALSE(reference[2]);                  // 16 s without a pose
  EXPECT_TRUE(reference[3]);
}

TEST(LoggedReference, TakesTheLaserOffItsMountAndACorrectedPoseAsItIs) {
  recording::LaserLog log;
  log.scans = {scan_at(0.0, {1, 2, Angle{}}), scan_at(1.0, {1, 2, Angle{}}), scan_at(2.0, {1, 2, Angle{}})};
  log.scans[0].base_from_laser = log.scans[1].base_from_laser = {0.25, 0, Angle{}};
  log.scans[2].base_from_laser = {0, 0, Angle::degrees(180)};  // it looks back, and its pose is the robot's
  log.scans[2].logged_pose = {1, 2, Angle{}};
  log.scans[0].logged_pose = {1.25, 2, Angle{}};
  log.scans[1].logged_pose = {7, 8, Angle{}};
  const ScanReference reference = logged_reference(log);
  EXPECT_NEAR(reference[0]->x, 1.0, 1e-12);
  EXPECT_NEAR(reference[1]->x, 7.0, 1e-12);
  EXPECT_NEAR(reference[2]->theta.radians(), 0.0, 1e-12);
}

}  // namespace
}  // namespace docent::evaluation
