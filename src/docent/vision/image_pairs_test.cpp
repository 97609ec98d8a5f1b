#include "docent/vision/image_pairs.h"

#include <gtest/gtest.h>

namespace docent::vision {
namespace {

Picture at(double time) { return {Time{} + seconds(time), std::make_shared<const std::vector<std::uint8_t>>()}; }
double time_of(const Picture& picture) { return to_seconds(picture.stamp - Time{}); }

TEST(ImagePairs, TakesTheNearestInTime) {
  ImagePairs pairs{seconds(0.3)};
  EXPECT_FALSE(pairs.newest());
  pairs.add_robot(at(1.0));
  EXPECT_FALSE(pairs.newest());
  pairs.add_scene(at(0.6));
  EXPECT_FALSE(pairs.newest()) << "0.4 s apart";
  pairs.add_scene(at(1.2));
  pairs.add_scene(at(1.6));
  ASSERT_TRUE(pairs.newest());
  EXPECT_NEAR(time_of(pairs.newest()->scene), 1.2, 1e-6);
  pairs.add_robot(at(5.0));  // the hall's camera is late: the last pair still holds
  ASSERT_TRUE(pairs.newest());
  EXPECT_NEAR(time_of(pairs.newest()->robot), 1.0, 1e-6);
}

TEST(ImagePairs, IsBoundedAndSurvivesAClockThatGoesBack) {
  ImagePairs pairs{seconds(0.3)};
  pairs.add_robot(at(100.0));
  for (int i = 0; i < 100; ++i) pairs.add_scene(at(i));
  EXPECT_FALSE(pairs.newest()) << "1 s apart";
  for (int i = 0; i < 10; ++i) pairs.add_robot(at(90.0 + i));
  ASSERT_TRUE(pairs.newest());
  EXPECT_NEAR(time_of(pairs.newest()->robot), 99.0, 1e-6);
  pairs.add_robot(at(2.0));
  pairs.add_scene(at(2.1));
  ASSERT_TRUE(pairs.newest());
  EXPECT_NEAR(time_of(pairs.newest()->robot), 2.0, 1e-6);
}

}  // namespace
}  // namespace docent::vision
