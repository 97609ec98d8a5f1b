#include "docent/people/sightlines.h"

#include <gtest/gtest.h>

#include "docent/people/testing.h"

namespace docent::people {
namespace {

TEST(Sightlines, FreeHiddenAndUnclear) {
  Scene scene{nullptr, {1.0, 1.0, Angle::degrees(30.0)}};
  scene.add_disc({3.0, 1.0}, 0.3);
  scene.add_wall({8.0, -5.0}, {8.0, 5.0});
  const PeopleSweep seen = scene.sweep();
  const Sightlines lines{seen.sweep, seen.odom_from_base};
  EXPECT_EQ(lines.look({4.5, 1.0}, 0.22), Look::hidden);
  EXPECT_EQ(lines.look({4.0, 3.5}, 0.22), Look::free);
  EXPECT_EQ(lines.look({3.0, 1.0}, 0.3), Look::unclear) << "beams end just there";
  EXPECT_EQ(lines.look({1.0, 1.0}, 0.3), Look::unclear) << "the robot's own place";
  EXPECT_GT(lines.share_on({3.0, 1.0}, 0.3), 0.9);
  EXPECT_LT(lines.share_on({4.0, 3.5}, 0.22), 0.1);
  EXPECT_EQ(lines.share_on({4.5, 1.0}, 0.22), 1.0) << "all end before it";
}

}  // namespace
}  // namespace docent::people
