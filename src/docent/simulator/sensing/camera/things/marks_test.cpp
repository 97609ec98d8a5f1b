#include "docent/simulator/sensing/camera/things/marks.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <vector>

namespace docent::simulator {
namespace {

TEST(Marks, AreWhiteRoundBlackRoundACodeOfTheirOwn) {
  std::set<std::vector<std::uint8_t>> codes;
  for (int tag = 0; tag < 40; ++tag) {
    const pictures::Image image = picture_of_tag(tag);
    ASSERT_EQ(image.width(), 10);
    ASSERT_EQ(image.height(), 10);
    std::vector<std::uint8_t> code;
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 10; ++x) {
        const int rim = std::min(std::min(x, 9 - x), std::min(y, 9 - y));
        const std::uint8_t shade = image.at(x, y).green;
        EXPECT_TRUE(rim != 0 || shade > 200);
        EXPECT_TRUE(rim != 1 || shade < 60);
        if (rim > 1) code.push_back(shade > 127 ? 1 : 0);
      }
    codes.insert(code);
  }
  EXPECT_EQ(codes.size(), 40U);
}

TEST(Marks, LookWhereTheyAreTurned) {
  const auto corners = [](double heading, double tilt) {
    Mesh mesh;
    add_mark(mesh, {"m", 0, {1.0, 2.0}, 0.5, Angle::degrees(heading), tilt, 0.16}, 0);
    return mesh;
  };
  const Mesh wall = corners(90.0, 0.0);
  EXPECT_NEAR(wall.normals[0].y, 1.0F, 1e-5F);
  EXPECT_NEAR(wall.points[0].z, 0.6F, 1e-5F) << "10 of 8 cells of 16 cm are 20 cm";
  EXPECT_NEAR(wall.points[0].x, 1.1F, 1e-5F) << "its left, as one looks at it from the north";
  const Mesh overhead = corners(0.0, -std::numbers::pi / 2.0);
  EXPECT_NEAR(overhead.normals[0].z, -1.0F, 1e-5F);
  EXPECT_NEAR(overhead.points[0].x, 1.1F, 1e-5F) << "its upper side";
}

}  // namespace
}  // namespace docent::simulator
