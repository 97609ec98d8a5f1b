#include "docent/people/clusters.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent {
namespace {

/// The near side of a disc seen from the origin.
void add_disc(std::vector<Point2>& points, Point2 centre, double radius) {
  const double towards = std::atan2(-centre.y, -centre.x);
  for (int degree = -75; degree <= 75; degree += 15)
    points.push_back(centre + radius * unit(Angle::radians(towards) + Angle::degrees(degree)));
}

TEST(FindPeople, FindsSeparateDiscs) {
  std::vector<Point2> points;
  add_disc(points, {2.0, 0.0}, 0.22);
  add_disc(points, {2.0, 1.5}, 0.22);
  add_disc(points, {-1.0, -1.0}, 0.22);
  const auto people = find_people(points, {}, {});
  ASSERT_EQ(people.size(), 3U);
  EXPECT_LT(distance(people[0].position, {2.0, 0.0}), 0.08);
  EXPECT_LT(distance(people[1].position, {2.0, 1.5}), 0.08);
  EXPECT_LT(distance(people[2].position, {-1.0, -1.0}), 0.08);
}

TEST(FindPeople, CutsALineOfPeople) {
  std::vector<Point2> points;
  for (int i = 0; i <= 36; ++i) points.push_back({3.0, -0.9 + 0.05 * i});  // 1.8 m shoulder to shoulder
  const auto people = find_people(points, {}, {});
  ASSERT_EQ(people.size(), 3U);
  EXPECT_NEAR(people[0].position.y + people[2].position.y, 2.0 * people[1].position.y, 0.1);
}

TEST(FindPeople, LeavesStrayPointsOut) {
  const std::vector<Point2> points{{1.0, 0.0}, {3.0, 0.0}, {3.1, 0.0}};
  EXPECT_TRUE(find_people(points, {}, {}).empty());
  EXPECT_TRUE(find_people({}, {}, {}).empty());
}

}  // namespace
}  // namespace docent
