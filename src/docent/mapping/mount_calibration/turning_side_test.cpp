#include "docent/mapping/mount_calibration/turning_side.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/mapping/mount_calibration/mount_calibrator.h"
#include "docent/mapping/mount_calibration/testing.h"

namespace docent::mapping::turning_side_test {
namespace {

struct Case {
  bool is_mirrored = false;
  double late = 0.0;
  double field = std::numbers::pi;
  double way = 30.0;  ///< [m] with some turns in it
  double turn = 1.0;  ///< degrees of odometry for a true one
  bool has_people = false;
  std::uint64_t seed = 1;
};

/// Drives about in the hall. A scanner that hangs writes its beams the other way round.
template <class OnOdometry, class OnScan>
void drive(const Case& one, OnOdometry&& on_odometry, OnScan&& on_scan) {
  testing::TestDrive drive{{0.15, 0.0, {}}, one.late, {.turn = one.turn}, one.seed};
  drive.field = one.field;
  if (one.has_people)
    drive.people = [](double t) {
      std::vector<Point2> people;
      for (int i = 0; i < 12; ++i)
        people.push_back({6.0 + 5.0 * std::sin(0.13 * t + 0.9 * i), 4.5 + 3.8 * std::cos(0.17 * t + 1.7 * i)});
      return people;
    };
  drive.go(one.way, on_odometry, [&](Time stamp, sensor_models::LaserReading reading) {
    if (one.is_mirrored) {
      reading.first_bearing = Angle::radians(-reading.first_bearing.radians());
      reading.bearing_step = -reading.bearing_step;
    }
    on_scan(stamp, reading);
  });
}

TurningSide::Side side_after(const Case& one) {
  TurningSide watch;
  motion_models::OdometryHistory odometry;
  drive(
      one, [&](Time stamp, const Pose2& pose) { odometry.add(stamp, pose); },
      [&](Time stamp, const sensor_models::LaserReading& reading) {
        watch.keep(stamp, reading);
        watch.follow(odometry);
      });
  return watch.side();
}

TEST(TurningSide, TellsWhichWayUpOfAnyFieldAmongPeopleAndWithLateStamps) {
  for (const bool is_mirrored : {false, true})
    for (const double field : {std::numbers::pi, 1.5 * std::numbers::pi, 2.0 * std::numbers::pi})
      for (const double late : {0.0, 0.1, -0.05})
        for (const bool has_people : {false, true})
          EXPECT_EQ(side_after({is_mirrored, late, field, 30.0, 1.0, has_people}),
                    is_mirrored ? TurningSide::Side::mirrored : TurningSide::Side::right)
              << field << " rad, " << late << " s late, people " << has_people;
}

TEST(TurningSide, OdometryThatTurnsTheWrongWayLooksTheSame) {
  EXPECT_EQ(side_after({.turn = -1.0}), TurningSide::Side::mirrored);
  EXPECT_EQ(side_after({.turn = 0.9}), TurningSide::Side::right) << "a wrong scale is none";
}

TEST(TurningSide, SaysNothingWithoutATurnAndInARoundRoom) {
  TurningSide watch;
  motion_models::OdometryHistory odometry;
  const std::vector<float> round(360, 4.0F);
  for (int i = 0; i < 400; ++i) {
    odometry.add(time_from_seconds(0.1 * i), {0.0, 0.0, Angle::radians(0.1 * i)});
    watch.keep(time_from_seconds(0.1 * i), {round, Angle::degrees(-180.0), std::numbers::pi / 180.0, 0.05, 10.0});
    watch.follow(odometry);
  }
  EXPECT_EQ(watch.side(), TurningSide::Side::unknown);
  EXPECT_EQ(side_after({.is_mirrored = true, .way = 2.0}), TurningSide::Side::unknown) << "straight on";
}

TEST(TurningSide, TheCalibratorNamesItAndSlowsDown) {
  for (const bool is_said : {false, true}) {
    MountCalibrator calibrator{{}, {{"front", {0.15, 0.0, {}}, is_said}}};
    double named_at = 0.0;
    Time begin{};
    Point2 last{};
    double way = 0.0;
    drive(
        {.is_mirrored = true, .way = 90.0},
        [&](Time stamp, const Pose2& odom) {
          if (begin == Time{}) begin = stamp;
          way += distance(last, odom.position());
          last = odom.position();
          calibrator.move(stamp, odom);
        },
        [&](Time stamp, const sensor_models::LaserReading& reading) {
          calibrator.see(0, stamp, reading);
          calibrator.work();
          if (named_at == 0.0 && !calibrator.finding().empty()) named_at = way;
        });
    EXPECT_NE(calibrator.finding().find(is_said ? "write upside_down: false" : "write upside_down: true"),
              std::string::npos)
        << calibrator.finding();
    EXPECT_EQ(calibrator.finding().find(','), std::string::npos) << "tables of health have commas between columns";
    EXPECT_GT(named_at, 0.0);
    EXPECT_LT(named_at, 15.0) << "[m] of way, with some turns in it";
    EXPECT_TRUE(calibrator.is_slow()) << "for ever: what it sees is not where it seems";
    EXPECT_FALSE(calibrator.is_known());
  }
}

}  // namespace
}  // namespace docent::mapping::turning_side_test
