#include "docent/mapping/mount_calibration/mount_calibrator.h"

#include <gtest/gtest.h>

#include <optional>

#include "docent/mapping/mount_calibration/testing.h"

namespace docent::mapping::mount_calibrator_test {
namespace {

struct Case {
  Pose2 truth;
  double late = 0.0;
  testing::OdometryErrors odometry{};
  double way = 20.0;
  double field = std::numbers::pi;
  std::uint64_t seed = 1;
};

MountCalibrator driven(const Case& one, const Pose2& nominal, bool has_people = false,
                       const MountCalibratorParams& params = {}) {
  MountCalibrator calibrator{params, {{"front", nominal}}};
  testing::TestDrive drive{one.truth, one.late, one.odometry, one.seed};
  drive.field = one.field;
  if (has_people)  // they walk along beside the robot and about in the hall
    drive.people = [](double t) {
      std::vector<Point2> people;
      for (int i = 0; i < 12; ++i)
        people.push_back({6.0 + 5.0 * std::sin(0.13 * t + 0.9 * i), 4.5 + 3.8 * std::cos(0.17 * t + 1.7 * i)});
      return people;
    };
  drive.go(
      one.way, [&](Time stamp, const Pose2& odom) { calibrator.move(stamp, odom); },
      [&](Time stamp, const auto& reading) {
        calibrator.see(0, stamp, reading);
        calibrator.work();
      });
  return calibrator;
}

void expect_near(const MountCalibrator& calibrator, const Pose2& truth, double metres, double degrees) {
  const CalibratedScanner& scanner = calibrator.scanners().front();
  const Pose2& found = scanner.estimate.state.base_from_sensor;
  EXPECT_TRUE(scanner.is_known);
  EXPECT_LT(distance(found.position(), truth.position()), metres) << found.x << ", " << found.y;
  EXPECT_LT(std::abs((found.theta - truth.theta).degrees()), degrees) << found.theta.degrees();
}

TEST(MountCalibrator, FindsNothingWhereThereIsNothing) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Pose2 mount{0.1, 0.0, {}};
    const auto calibrator = driven({.truth = mount, .seed = seed}, mount);
    expect_near(calibrator, mount, 0.02, 0.7);
    EXPECT_EQ(calibrator.finding(), "");
    EXPECT_EQ(calibrator.scanners().front().delay, 0.0);
    EXPECT_EQ(calibrator.scanners().front().base_from_sensor.x, mount.x) << "as robot.yaml has it";
  }
}

TEST(MountCalibrator, FindsTurnedScanners) {
  for (const double degrees : {3.0, -10.0, 45.0, 180.0}) {
    const Pose2 truth{0.1, 0.05, Angle::degrees(degrees)};
    const auto calibrator = driven({.truth = truth}, {0.1, 0.05, {}});
    expect_near(calibrator, truth, 0.03, 1.0);
    EXPECT_NE(calibrator.finding().find("scanner front: turned by"), std::string::npos) << calibrator.finding();
    EXPECT_LT(std::abs((calibrator.scanners().front().base_from_sensor.theta - truth.theta).degrees()), 1.0);
  }
}

TEST(MountCalibrator, FindsDisplacedScannersAndAmongPeople) {
  for (const Point2 off : {Point2{0.05, 0.0}, Point2{0.0, -0.1}, Point2{-0.2, 0.2}}) {
    const Pose2 nominal{0.1, 0.0, {}};
    const Pose2 truth{nominal.x + off.x, nominal.y + off.y, {}};
    const auto calibrator = driven({.truth = truth}, nominal, true);
    expect_near(calibrator, truth, 0.03, 1.0);
    EXPECT_NE(calibrator.finding().find("displaced"), std::string::npos) << calibrator.finding();
  }
}

TEST(MountCalibrator, FindsLateStampsOfAnyField) {
  for (const double late : {0.06, 0.15, -0.1}) {
    const auto calibrator = driven({.truth = {}, .late = late, .field = 1.5 * std::numbers::pi}, {});
    EXPECT_NEAR(calibrator.scanners().front().estimate.state.delay, late, 0.02);
    EXPECT_NEAR(calibrator.scanners().front().delay, late, 0.02);
    expect_near(calibrator, {}, 0.03, 1.0);
  }
}

TEST(MountCalibrator, FollowsADelayThatChanges) {
  for (const double change : {0.15, -0.2, 0.28}) {
    MountCalibrator calibrator{{}, {{"front", {0.1, 0.0, {}}}}};
    testing::TestDrive drive{{0.1, 0.0, {}}, 0.02, {}, 3};
    double way = 0.0;
    double known_after = -1.0;  // [m]
    bool was_known = true;
    std::optional<Pose2> last;
    drive.go(
        90.0,
        [&](Time stamp, const Pose2& odom) {
          if (last) way += distance(last->position(), odom.position());
          last = odom;
          calibrator.move(stamp, odom);
        },
        [&](Time stamp, const auto& reading) {
          calibrator.see(0, stamp + seconds(way > 45.0 ? change : 0.0), reading);
          calibrator.work();
          if (way > 45.0) was_known = was_known && calibrator.is_known();
          if (known_after < 0.0 && std::abs(calibrator.scanners().front().delay - 0.02 - change) < 0.03)
            known_after = way - 45.0;
        });
    EXPECT_NEAR(calibrator.scanners().front().estimate.state.delay, 0.02 + change, 0.02);
    EXPECT_TRUE(known_after > 0.0 && known_after < 25.0) << known_after << " m after " << change << " s";
    EXPECT_TRUE(was_known) << "where it is mounted is known all the while";
    expect_near(calibrator, {0.1, 0.0, {}}, 0.03, 1.0);
  }
}

TEST(MountCalibrator, TellsScalesOfOdometryFromMounts) {
  const auto calibrator = driven({.truth = {}, .odometry = {.way = 1.08, .turn = 0.93}, .way = 40.0}, {});
  expect_near(calibrator, {}, 0.03, 1.0);
  const CalibratedBase base = calibrator.base();
  EXPECT_NEAR(base.way_scale, 1.0 / 1.08, 0.015);
  EXPECT_NEAR(base.turn_scale, 1.0 / 0.93, 0.015);
  EXPECT_NE(base.finding.find("each metre"), std::string::npos) << base.finding;
}

TEST(MountCalibrator, DoesNotKnowBeforeItHasDriven) {
  MountCalibrator calibrator{{}, {{"front", {}}}};
  EXPECT_FALSE(calibrator.is_known());
  EXPECT_GT(calibrator.scanners().front().doubt_heading, 0.1);
  EXPECT_FALSE(calibrator.work());
  const auto a_metre = driven({.truth = {}, .way = 0.4}, {});
  EXPECT_FALSE(a_metre.is_known());
}

TEST(MountCalibrator, NoticesAScannerThatIsKnockedAskew) {
  const Pose2 after{0.1, 0.0, Angle::degrees(12.0)};
  auto calibrator = driven({.truth = {0.1, 0.0, {}}, .way = 40.0}, {0.1, 0.0, {}});
  EXPECT_EQ(calibrator.finding(), "");
  testing::TestDrive drive{after, 0.0, {}, 7};
  drive.go(
      90.0, [&](Time stamp, const Pose2& odom) { calibrator.move(stamp + seconds(1000.0), odom); },
      [&](Time stamp, const auto& reading) {
        calibrator.see(0, stamp + seconds(1000.0), reading);
        calibrator.work();
      });
  expect_near(calibrator, after, 0.03, 1.5);
  EXPECT_NE(calibrator.finding(), "");
}

TEST(MountCalibrator, WheelsThatSlipAreNoScannerThatIsKnockedAskew) {
  const Pose2 mount{0.1, 0.0, {}};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto calibrator = driven({.truth = mount, .odometry = {.noise = 0.03}, .way = 60.0, .seed = seed}, mount);
    EXPECT_GT(calibrator.scanners().front().pairs, 30U) << "it has forgotten";
    EXPECT_EQ(calibrator.finding(), "");
  }
}

TEST(MountCalibrator, RemembersUntilTheScannersSayOtherwise) {
  const Pose2 truth{0.1, 0.0, Angle::degrees(8.0)};
  const auto first = driven({.truth = truth}, {0.1, 0.0, {}});
  MountCalibrator second{{}, {{"front", {0.1, 0.0, {}}}}};
  second.remember(0, first.scanners().front().estimate, first.scanners().front().pairs);
  EXPECT_TRUE(second.is_known());
  expect_near(second, truth, 0.03, 1.0);
  EXPECT_NE(second.finding(), "");
}

/// As if a drive had said so.
void tell(MountCalibrator& calibrator, double degrees, double sigma_degrees, double x = 0.1, double sigma_x = 0.01) {
  constexpr double kRadian = std::numbers::pi / 180.0;
  MountEstimate estimate{.state = {.base_from_sensor = {x, 0.0, Angle::degrees(degrees)}}};
  estimate.covariance.diagonal().setConstant(1e-6);
  estimate.covariance(kMountHeading, kMountHeading) = sigma_degrees * sigma_degrees * kRadian * kRadian;
  estimate.covariance(kMountX, kMountX) = sigma_x * sigma_x;
  calibrator.remember(0, estimate, 40);
}

TEST(MountCalibrator, WhatIsNamedStaysUntilASmallErrorSaysOtherwise) {
  MountCalibrator calibrator{{}, {{"front", {0.1, 0.0, {}}}}};
  const auto names = [&](const char* what) { return calibrator.finding().find(what) != std::string::npos; };
  tell(calibrator, 3.0, 2.0, 0.16, 0.04);
  EXPECT_EQ(calibrator.finding(), "") << "hardly known";
  tell(calibrator, 3.0, 0.3, 0.16, 0.01);
  EXPECT_TRUE(names("turned"));
  EXPECT_TRUE(names("displaced"));
  tell(calibrator, 2.0, 3.0, 0.14, 0.05);
  EXPECT_TRUE(names("turned")) << "the next corridor contradicts it";
  EXPECT_TRUE(names("displaced"));
  tell(calibrator, 0.3, 3.0, 0.11, 0.05);
  EXPECT_TRUE(names("turned")) << "and nobody knows better";
  EXPECT_NE(calibrator.scanners().front().base_from_sensor.theta.radians(), 0.0) << "it is used, too";
  tell(calibrator, 0.3, 0.4, 0.105, 0.01);
  EXPECT_EQ(calibrator.finding(), "") << "it is known well that there is nothing";
}

TEST(MountCalibrator, WhatIsBeyondDoubtIsNamedThoughMostPairsAreOfVisitors) {
  const MountCalibratorParams params;
  EXPECT_TRUE(is_named({0.3, 0.02, 0.03}, 40, 7.0, params));
  EXPECT_FALSE(is_named({0.3, 0.05, 0.03}, 40, 7.0, params)) << "it may be doubted";
  EXPECT_FALSE(is_named({0.3, 0.02, 0.03}, 20, 7.0, params)) << "few pairs agree by chance";
  EXPECT_FALSE(is_named({0.3, 0.02, 0.03}, 40, 8.0, params)) << "hardly a pair agrees";
  EXPECT_TRUE(is_named({0.3, 0.02, 0.03}, 20, 3.0, params));
  EXPECT_FALSE(is_named({0.3, 0.02, 0.03}, 2, 3.0, params));
  EXPECT_FALSE(is_named({0.01, 0.002, 0.03}, 40, 3.0, params)) << "below what is named";
}

TEST(MountCalibrator, IsNotSlowAgainWhenItsErrorGrows) {
  MountCalibrator calibrator{{}, {{"front", {0.1, 0.0, {}}}}};
  EXPECT_TRUE(calibrator.is_slow());
  tell(calibrator, 0.0, 0.3);
  EXPECT_FALSE(calibrator.is_slow());
  tell(calibrator, 0.0, 2.7);
  EXPECT_FALSE(calibrator.is_known());
  EXPECT_FALSE(calibrator.is_slow());
  EXPECT_FALSE((MountCalibrator{{}, {}}.is_slow())) << "a base of sonars has no mounts to find";
}

TEST(MountCalibrator, WhatHardlyIsKnownIsBorneOutByAWay) {
  const Pose2 mount{0.1, 0.0, {}};
  MountCalibratorParams params;
  const double sigma = driven({.truth = mount, .way = 14.0}, mount).scanners().front().estimate.sigma(kMountHeading);
  params.known_heading = sigma * 180.0 / std::numbers::pi / 1.5;
  const auto long_way = driven({.truth = mount, .way = 14.0}, mount, false, params);
  EXPECT_FALSE(long_way.is_known());
  EXPECT_FALSE(long_way.is_slow());
  EXPECT_TRUE(driven({.truth = mount, .way = 8.0}, mount, false, params).is_slow()) << "a way that is too short";
  params.known_heading /= 4.0;
  EXPECT_TRUE(driven({.truth = mount, .way = 14.0}, mount, false, params).is_slow()) << "known far too badly";
}

TEST(MountCalibrator, IsTheSameEachTime) {
  const Case one{.truth = {0.1, 0.0, Angle::degrees(5.0)}};
  const auto a = driven(one, {}).scanners().front().estimate.state;
  const auto b = driven(one, {}).scanners().front().estimate.state;
  EXPECT_EQ(a.base_from_sensor.x, b.base_from_sensor.x);
  EXPECT_EQ(a.delay, b.delay);
}

}  // namespace
}  // namespace docent::mapping::mount_calibrator_test
