#include "docent/modules/shared/person_beams.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace docent::modules::person_beams_test {
namespace {

using sensor_models::BeamOrigin;

TEST(PersonBeams, TellWhatEachBeamEndedOn) {
  const sensor_models::RangeSweep sweep{{{0.25, 2.0, false}, {0.5, 10.0, true}}};
  const std::vector<BeamOrigin> origins{BeamOrigin::not_map, BeamOrigin::unknown};
  const std::vector<Point2> ends{{1.5, 0.5}};
  const Pose2 map_from_base{3.0, 4.0, Angle::radians(0.125)};
  const Pose2 odom_from_base{5.0, 6.0, Angle::radians(-0.5)};
  const auto message =
      person_beams_message({Time{2'000'000'007}, true, map_from_base, odom_from_base, sweep, origins, ends});
  EXPECT_EQ(message.header.frame_id, "base_link");
  EXPECT_EQ(message.header.stamp.nanosec, 7U);
  EXPECT_TRUE(message.localized);
  EXPECT_EQ(message.map_from_base, (std::array<double, 3>{3.0, 4.0, 0.125}));
  EXPECT_EQ(message.odom_from_base, (std::array<double, 3>{5.0, 6.0, -0.5}));
  EXPECT_EQ(message.bearings, (std::vector<float>{0.25F, 0.5F}));
  EXPECT_EQ(message.ranges, (std::vector<float>{2.0F, -10.0F})) << "nothing came back from 10 m";
  EXPECT_EQ(message.origins, (std::vector<std::uint8_t>{3, 0}));
  EXPECT_EQ(message.x, (std::vector<float>{1.5F}));
  EXPECT_EQ(message.y, (std::vector<float>{0.5F}));
}

TEST(PersonBeams, OfARobotThatDoesNotKnowItsPlaceHaveNoPose) {
  const sensor_models::RangeSweep nothing;
  const auto message = person_beams_message({Time{}, false, std::nullopt, {1.0, 0.0, {}}, nothing, {}, {}});
  EXPECT_FALSE(message.localized);
  EXPECT_EQ(message.map_from_base, (std::array<double, 3>{}));
  EXPECT_EQ(message.odom_from_base[0], 1.0);
  EXPECT_TRUE(message.bearings.empty());
}

}  // namespace
}  // namespace docent::modules::person_beams_test
