#include "docent/planning/mark_alignment/mark_alignment.h"

#include <gtest/gtest.h>

#include "docent/base/random.h"

namespace docent::planning::mark_alignment_test {
namespace {

const Polygon kArea{{1.0, 1.0}, {14.0, 1.0}, {18.0, 5.0}, {18.0, 12.0}, {6.0, 12.0}, {6.0, 9.0}, {1.0, 9.0}};
const Pose2 kStart{4.0, 4.0, {}};

/// Points on the walls `gap` outside the area's border, as a robot at the start sees them: within `reach`, in its own
/// frame, which is where it truly is; and furniture that has nothing to do with the border.
std::vector<mapping::SurfacePoint> walls_seen(const Pose2& site_from_survey, double gap, double reach, Rng& rng) {
  std::vector<mapping::SurfacePoint> walls;
  const auto see = [&](Point2 at, Point2 normal) {
    if (distance(at, site_from_survey * kStart.position()) > reach) return;
    const Point2 noise{rng.normal(0.0, 0.02), rng.normal(0.0, 0.02)};
    walls.push_back(mapping::transformed(inverse(site_from_survey), {at + noise, normal}));
  };
  for (const Segment& side : sides(kArea)) {
    const double length = distance(side.a, side.b);
    const Point2 along = (1.0 / length) * (side.b - side.a);
    const Point2 inward{-along.y, along.x};
    for (double s = 0.0; s < length; s += 0.15) see(side.a + s * along - gap * inward, inward);
  }
  for (double s = 0.0; s < 1.5; s += 0.15) {
    see({8.0 + s, 5.0}, {0.0, -1.0});
    see({3.0, 6.0 + s}, {1.0, 0.0});
    see({11.0 + 0.7 * s, 7.0 + 0.7 * s}, {0.7071, -0.7071});
  }
  return walls;
}

/// What is off: turned about the start, then shifted.
Pose2 off(double x, double y, double degrees) {
  const Point2 back = Pose2{0.0, 0.0, Angle::degrees(degrees)} * (-1.0 * kStart.position());
  return {kStart.x + back.x + x, kStart.y + back.y + y, Angle::degrees(degrees)};
}

TEST(MarkAlignment, FindsWhereTheRobotWasSetDown) {
  Rng rng{1};
  for (const auto& truth : {off(0.0, 0.0, 10.0), off(0.5, 0.0, 0.0), off(-0.3, 0.4, -5.0), off(0.1, -0.2, 1.0)}) {
    for (const double gap : {0.25, 0.0, 0.9}) {
      MarkAlignment alignment{{}, kArea, kStart};
      EXPECT_TRUE(alignment.align(walls_seen(truth, gap, 30.0, rng)));
      EXPECT_TRUE(alignment.is_aligned());
      for (const Point2 mark : {Point2{2.0, 8.0}, Point2{17.0, 11.0}}) {
        const Point2 missed = alignment.site_from_survey() * (inverse(truth) * mark) - mark;
        EXPECT_LT(norm(missed), 0.15) << gap << ": " << missed.x << ", " << missed.y;
        EXPECT_LT(alignment.margin_at(mark), 0.3);
        EXPECT_LE(norm(missed), alignment.margin_at(mark) + MarkAlignmentParams{}.free);
      }
    }
  }
}

TEST(MarkAlignment, KeepsOffTheMoreTheFartherWhileItKnowsNothing) {
  const MarkAlignment alignment{{}, kArea, kStart};
  EXPECT_NEAR(alignment.margin_at(kStart.position()), 2.5 * 0.2 - 0.15, 1e-9);
  EXPECT_GT(alignment.margin_at({14.0, 4.0}), 1.5) << "10 degrees of 10 m";
}

TEST(MarkAlignment, BelievesNoWallsThatHaveNothingToDoWithTheArea) {
  Rng rng{2};
  std::vector<mapping::SurfacePoint> scattered;
  for (int i = 0; i < 300; ++i) {
    const Angle side = Angle::radians(rng.uniform(-3.0, 3.0));
    scattered.push_back({{rng.uniform(0.0, 19.0), rng.uniform(0.0, 13.0)}, unit(side)});
  }
  MarkAlignment alignment{{}, kArea, kStart};
  EXPECT_FALSE(alignment.align(scattered));
  EXPECT_GT(alignment.margin_at({14.0, 4.0}), 1.5);
  EXPECT_FALSE(alignment.align({})) << "nothing was seen";
  MarkAlignment without{{}, {}, kStart};
  EXPECT_FALSE(without.align(walls_seen(off(0.0, 0.0, 5.0), 0.2, 30.0, rng))) << "no area";
}

TEST(MarkAlignment, SaysHowLittleOneWallTells) {
  Rng rng{3};
  std::vector<mapping::SurfacePoint> wall;
  for (const mapping::SurfacePoint& point : walls_seen({}, 0.25, 30.0, rng))
    if (point.normal.y > 0.9 && point.at.y < 2.0) wall.push_back(point);
  MarkAlignment alignment{{}, kArea, kStart};
  (void)alignment.align(wall);
  EXPECT_GT(alignment.margin_at(kStart.position()), 0.25) << "it does not tell the place along it, nor the gap";
}

}  // namespace
}  // namespace docent::planning::mark_alignment_test
