#include "docent/planning/navigator/whereabouts.h"

#include <gtest/gtest.h>

namespace docent::planning::whereabouts_test {
namespace {

TEST(Whereabouts, CarriesThePoseOnByOdometry) {
  Whereabouts where;
  EXPECT_FALSE(where.map_from_base().has_value());
  where.map_from_odom = Pose2{3.0, 6.0, Angle::degrees(-90)};
  EXPECT_FALSE(where.map_from_base().has_value());
  where.odom_from_base = Pose2{0.0, 2.0, Angle::degrees(90)};
  const auto pose = where.map_from_base();
  ASSERT_TRUE(pose.has_value());
  EXPECT_NEAR(pose->x, 5.0, 1e-9);
  EXPECT_NEAR(pose->y, 6.0, 1e-9);
  EXPECT_NEAR(pose->theta.degrees(), 0.0, 1e-9);
  EXPECT_FALSE(where.odom_from_base_at(Time{}).has_value()) << "nobody has told of the past";
}

TEST(Whereabouts, AreKnownWhileTheBeliefIsSureAndFresh) {
  Whereabouts where;
  where.believed_at = time_from_seconds(10.0);
  EXPECT_FALSE(where.is_known(time_from_seconds(10.0)));
  where.is_localized = true;
  EXPECT_TRUE(where.is_known(time_from_seconds(10.0)));
  EXPECT_TRUE(where.is_known(time_from_seconds(12.9)));
  EXPECT_FALSE(where.is_known(time_from_seconds(13.0)));
}

}  // namespace
}  // namespace docent::planning::whereabouts_test
