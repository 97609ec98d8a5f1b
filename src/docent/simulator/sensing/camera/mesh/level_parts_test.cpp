#include "docent/simulator/sensing/camera/mesh/level_parts.h"

#include <gtest/gtest.h>

#include <map>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

Polygon turned_box(Point2 middle, double length, double width, double angle) {
  const Pose2 at{middle.x, middle.y, Angle::radians(angle)};
  return {at * Point2{-length, -width}, at * Point2{length, -width}, at * Point2{length, width},
          at * Point2{-length, width}};
}

std::map<int, double> areas(const LevelParts& parts) {
  std::map<int, double> sums;
  for (const auto& piece : parts.pieces) sums[piece.owner] += signed_area({piece.corners.begin(), piece.corners.end()});
  return sums;
}

TEST(LevelParts, CutAHoleOutOfAFloor) {
  const std::vector<Polygon> hole{turned_box({5.0, 4.0}, 1.0, 0.5, 0.3)};
  const LevelParts parts = level_parts({0.0, 0.0}, {10.0, 8.0}, hole);
  auto sums = areas(parts);
  EXPECT_NEAR(sums[-1], 78.0, 1e-9);
  EXPECT_NEAR(sums[0], 2.0, 1e-9);
  ASSERT_EQ(parts.borders.size(), 4U);
  for (const auto& border : parts.borders) {
    EXPECT_EQ(border.left, 0) << "the outline runs counter-clockwise";
    EXPECT_EQ(border.right, -1);
  }
}

TEST(LevelParts, WithoutPolygonsAreOnePiece) {
  const LevelParts parts = level_parts({0.0, 0.0}, {10.0, 8.0}, {});
  ASSERT_EQ(parts.pieces.size(), 1U);
  EXPECT_TRUE(parts.borders.empty());
}

TEST(LevelParts, TheLastOfSeveralOwnsAPlace) {
  Rng rng{1};
  for (int round = 0; round < 40; ++round) {
    std::vector<Polygon> polygons;
    for (int i = 0; i < 5; ++i)
      polygons.push_back(turned_box({rng.uniform(0.0, 10.0), rng.uniform(0.0, 8.0)}, rng.uniform(0.3, 3.0),
                                    rng.uniform(0.3, 3.0), rng.uniform(0.0, 3.0)));
    const LevelParts parts = level_parts({0.0, 0.0}, {10.0, 8.0}, polygons);
    double whole = 0.0;
    for (const auto& [owner, area] : areas(parts)) whole += area;
    EXPECT_NEAR(whole, 80.0, 1e-6) << round;
    for (const auto& piece : parts.pieces) {
      const Point2 middle = 0.25 * (piece.corners[0] + piece.corners[1] + piece.corners[2] + piece.corners[3]);
      EXPECT_EQ(owner_at(polygons, middle), piece.owner) << round;
      EXPECT_GT(signed_area({piece.corners.begin(), piece.corners.end()}), 0.0);
    }
    // Along a border both owners are as it says.
    for (const auto& border : parts.borders) {
      const Point2 along = border.line.b - border.line.a;
      if (norm(along) < 0.01) continue;
      const Point2 left = (1e-5 / norm(along)) * Point2{-along.y, along.x};
      for (const double share : {0.1, 0.5, 0.9}) {
        const Point2 at = border.line.a + share * along;
        EXPECT_EQ(owner_at(polygons, at + left), border.left);
        EXPECT_EQ(owner_at(polygons, at - left), border.right);
      }
    }
  }
}

}  // namespace
}  // namespace docent::simulator
