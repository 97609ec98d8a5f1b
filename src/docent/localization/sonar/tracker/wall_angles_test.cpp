#include "docent/localization/sonar/tracker/wall_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::localization::wall_angles_test {
namespace {

/// Drives along the x axis past the wall y = 1.2 + slope * x; the sonar looks to the left, `bearing` off.
struct Passage {
  double slope = 0.0;
  double bearing = 90.0;  // [deg]
  double noise = 0.01;    // [m]
  double swing = 0.0;     // [deg] of the robot's heading

  std::vector<WallAngle> drive(Rng& rng, double metres = 6.0) const {
    WallAngles walls{{}, 24};
    std::vector<WallAngle> found;
    const double incline = std::atan(slope);
    for (double x = 0.0; x < metres; x += 0.2) {
      const Angle heading = Angle::degrees(swing * std::sin(x));
      const Pose2 sonar{x, 0.0, heading + Angle::degrees(bearing)};
      // The foot of the perpendicular answers, wherever it lies in the cone.
      const double range = (1.2 + slope * x) * std::cos(incline) + rng.normal(0.0, noise);
      if (const auto wall = walls.add(6, sonar, range)) found.push_back(*wall);
    }
    return found;
  }
};

TEST(WallAngles, FindsTheDirectionOfAWall) {
  Rng rng{1};
  for (const double degrees : {-8.0, 0.0, 5.0, 12.0}) {
    for (const double bearing : {80.0, 90.0, 97.0}) {
      if (std::abs(90.0 + degrees - bearing) > 18.0) continue;
      const Passage passage{std::tan(degrees * std::numbers::pi / 180.0), bearing, 0.008, 3.0};
      const auto found = passage.drive(rng);
      ASSERT_GE(found.size(), 3U) << degrees;
      for (const WallAngle& wall : found) {
        const double off = (wall.normal - Angle::degrees(90.0 + degrees)).radians();
        EXPECT_LT(std::abs(off), 4.0 * wall.deviation) << degrees << ' ' << bearing;
        EXPECT_LT(wall.deviation, 0.04);
      }
    }
  }
}

TEST(WallAngles, ItsDeviationIsNotTooSmall) {
  Rng rng{2};
  int within = 0;
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    for (const WallAngle& wall : Passage{0.05, 90.0, 0.015, 2.0}.drive(rng)) {
      const double off = (wall.normal - Angle::radians(std::numbers::pi / 2.0 + std::atan(0.05))).radians();
      if (std::abs(off) < wall.deviation) ++within;
      ++count;
    }
  }
  ASSERT_GT(count, 300);
  EXPECT_GT(static_cast<double>(within) / count, 0.6);
}

TEST(WallAngles, ScatteredEchoesAreNoWall) {
  Rng rng{3};
  EXPECT_TRUE((Passage{0.0, 90.0, 0.08, 0.0}.drive(rng).empty()));
}

TEST(WallAngles, AWallSeenTooObliquelyIsNotTrusted) {
  Rng rng{3};
  EXPECT_TRUE((Passage{0.0, 55.0, 0.005, 0.0}.drive(rng).empty()));
}

TEST(WallAngles, ARunEndsWithSilenceWithATurnAndWithAJump) {
  const auto fed = [](auto&& range_at, auto&& heading_at) {
    WallAngles walls{{}, 24};
    int found = 0;
    for (int i = 0; i < 12; ++i) {
      const Pose2 sonar{0.2 * i, 0.0, Angle::degrees(90.0 + heading_at(i))};
      if (walls.add(6, sonar, range_at(i))) ++found;
    }
    return found;
  };
  const auto straight = [](int) { return 0.0; };
  using Range = std::optional<double>;
  EXPECT_EQ(fed([](int) { return Range{1.0}; }, straight), 2);
  EXPECT_EQ(fed([](int i) { return i % 4 == 3 ? Range{} : Range{1.0}; }, straight), 0);
  EXPECT_EQ(fed([](int i) { return Range{i % 8 < 4 ? 1.0 : 1.5}; }, straight), 0);
  EXPECT_EQ(fed([](int) { return Range{1.0}; }, [](int i) { return 4.0 * i; }), 0);
  EXPECT_EQ(fed([](int) { return Range{3.5}; }, straight), 0) << "too far away";
}

TEST(WallAngles, ARobotThatStandsLearnsNothingAndAnUnknownSonarIsNobody) {
  WallAngles walls{{}, 24};
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(walls.add(6, {0.001 * i, 0.0, Angle::degrees(90.0)}, 1.0));
  EXPECT_FALSE(walls.add(24, {}, 1.0));
  EXPECT_FALSE(walls.add(-1, {}, 1.0));
}

TEST(WallAngles, RefusesWildParameters) {
  EXPECT_TRUE(WallAngleParams{}.validate());
  WallAngleParams params;
  params.echoes = 2;
  EXPECT_FALSE(params.validate());
  params = {};
  params.oblique = 80.0;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::localization::wall_angles_test
