#include "docent/collision_avoidance/obstacle_field/unmapped_places.h"

#include <gtest/gtest.h>

#include <array>

namespace docent::collision_avoidance::unmapped_places_test {
namespace {

Time at(double time) { return time_from_seconds(100.0 + time); }
const Pose2 kOdomFromBase{1.0, 0.0, Angle::degrees(90)};

TEST(UnmappedPlaces, StayWhereTheyAreInTheOdometrysFrame) {
  UnmappedPlaces places;
  EXPECT_FALSE(places.judge(at(0.0))) << "nothing was said so far";
  places.add(at(0.0), at(0.0), kOdomFromBase, std::array{Point2{2.0, 0.0}}, true);
  ASSERT_TRUE(places.judge(at(0.5)));
  EXPECT_TRUE(places.is_near({1.2, 2.2}));
  EXPECT_FALSE(places.is_near({1.0, 2.5}));
  EXPECT_FALSE(places.judge(at(0.7))) << "somebody else may have come since";
}

TEST(UnmappedPlaces, WhatAnotherLaserMetAMomentAgoStays) {
  UnmappedPlaces places;
  places.add(at(0.0), at(0.0), {}, std::array{Point2{2.0, 0.0}}, true);
  places.add(at(0.1), at(0.1), {}, std::array{Point2{-2.0, 0.0}}, true);
  EXPECT_TRUE(places.is_near({2.0, 0.0}));
  EXPECT_TRUE(places.is_near({-2.0, 0.0}));
  places.add(at(0.2), at(0.2), {}, {}, true);
  EXPECT_FALSE(places.is_near({2.0, 0.0})) << "of the scan before";
}

TEST(UnmappedPlaces, WithoutAPlaceInTheMapNothingIsJudged) {
  UnmappedPlaces places;
  places.add(at(0.0), at(0.0), {}, std::array{Point2{2.0, 0.0}}, false);
  EXPECT_FALSE(places.judge(at(0.1)));
}

}  // namespace
}  // namespace docent::collision_avoidance::unmapped_places_test
