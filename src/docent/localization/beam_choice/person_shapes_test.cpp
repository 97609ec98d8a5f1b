#include "docent/localization/beam_choice/person_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "docent/base/random.h"
#include "docent/geometry/polygon.h"

namespace docent::localization::person_shapes_test {
namespace {

/// A robot in the middle of discs and straight walls, with two lasers' 360 beams and noise of 2 cm.
class Scene {
 public:
  explicit Scene(std::uint64_t seed) : rng_{seed} {}
  void add_person(Point2 centre, double radius = 0.24) { discs_.push_back({centre, radius}); }
  void add_wall(Point2 from, Point2 to) { walls_.push_back({from, to}); }
  void add_room(double left, double right, double half_width) {
    const Point2 a{-left, -half_width}, b{right, -half_width}, c{right, half_width}, d{-left, half_width};
    add_wall(a, b), add_wall(b, c), add_wall(c, d), add_wall(d, a);
  }

  struct Marked {
    int of_people = 0, people = 0;
    int of_walls = 0, walls = 0;
    [[nodiscard]] double share_of_people() const { return static_cast<double>(of_people) / std::max(people, 1); }
    [[nodiscard]] double share_of_walls() const { return static_cast<double>(of_walls) / std::max(walls, 1); }
  };
  [[nodiscard]] Marked look() {
    sensor_models::RangeSweep sweep;
    std::vector<bool> is_person;
    for (int i = -90; i < 270; ++i) {
      const Angle bearing = Angle::degrees(i + 0.5);
      const auto [range, person] = cast(unit(bearing));
      const bool none = range > 10.0;
      sweep.beams.push_back({bearing.radians(), none ? 10.0 : range + rng_.normal(0.0, 0.02), none});
      is_person.push_back(person);
    }
    const auto marks = on_person_shapes(sweep);
    Marked result;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      (is_person[i] ? result.people : result.walls) += sweep.beams[i].no_return ? 0 : 1;
      (is_person[i] ? result.of_people : result.of_walls) += marks[i];
    }
    return result;
  }

 private:
  struct Disc {
    Point2 centre;
    double radius;
  };
  [[nodiscard]] std::pair<double, bool> cast(Point2 ray) const {
    std::pair<double, bool> nearest{std::numeric_limits<double>::infinity(), false};
    for (const Disc& disc : discs_)
      if (const auto range = ray_distance({}, ray, disc.centre, disc.radius); range && *range < nearest.first)
        nearest = {*range, true};
    for (const Segment& wall : walls_)
      if (const auto range = ray_distance({}, ray, wall); range && *range < nearest.first) nearest = {*range, false};
    return nearest;
  }
  Rng rng_;
  std::vector<Disc> discs_;
  std::vector<Segment> walls_;
};

Point2 at(double range, double degrees) { return range * unit(Angle::degrees(degrees)); }

TEST(PersonShapes, AnEmptyRoomHasNone) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Scene scene{seed};
    Rng rng{seed};
    scene.add_room(rng.uniform(0.6, 4.0), rng.uniform(0.6, 4.0), rng.uniform(0.6, 4.0));
    EXPECT_LT(scene.look().share_of_walls(), 0.02) << seed;
  }
}

TEST(PersonShapes, WhoStandsInTheRoomIsOne) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Scene scene{seed};
    Rng rng{seed};
    scene.add_room(4.0, 5.0, 3.0);
    for (double degrees = 0.0; degrees < 330.0; degrees += 60.0)
      scene.add_person(at(rng.uniform(0.7, 2.4), degrees + rng.uniform(0.0, 20.0)), rng.uniform(0.18, 0.28));
    const auto marked = scene.look();
    EXPECT_GT(marked.share_of_people(), 0.9) << seed;
    EXPECT_LT(marked.share_of_walls(), 0.05) << seed;
  }
}

TEST(PersonShapes, LegsAreTwo) {
  Scene scene{1};
  scene.add_room(4.0, 5.0, 3.0);
  for (double degrees = 0.0; degrees < 360.0; degrees += 45.0) {
    scene.add_person(at(1.4, degrees - 5.0), 0.06);
    scene.add_person(at(1.5, degrees + 5.0), 0.06);
  }
  const auto marked = scene.look();
  EXPECT_GT(marked.share_of_people(), 0.9);
  EXPECT_LT(marked.share_of_walls(), 0.05);
}

TEST(PersonShapes, WallsSeenThroughTheGapsOfARingOfPeopleAreWalls) {
  double people = 0.0, walls = 0.0, seen = 0.0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Scene scene{seed};
    Rng rng{seed};
    scene.add_room(4.0, 5.0, 3.5);
    for (double degrees = 0.0; degrees < 350.0; degrees += rng.uniform(30.0, 40.0))
      scene.add_person(at(rng.uniform(0.8, 1.1), degrees), rng.uniform(0.2, 0.27));
    const auto marked = scene.look();
    people += marked.share_of_people() / 30.0;
    walls += marked.share_of_walls() / 30.0;
    seen += marked.walls / 30.0;
  }
  EXPECT_GT(seen, 15.0);
  EXPECT_GT(people, 0.85);
  EXPECT_LT(walls, 0.1);
}

TEST(PersonShapes, PeopleShoulderToShoulderAreNoWall) {
  double people = 0.0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Scene scene{seed};
    Rng rng{seed};
    scene.add_room(4.0, 5.0, 3.5);
    for (int i = -2; i <= 2; ++i) scene.add_person({1.3 + rng.uniform(-0.1, 0.1), 0.47 * i}, 0.24);
    people += scene.look().share_of_people() / 30.0;
  }
  EXPECT_GT(people, 0.75);
}

TEST(PersonShapes, CasesAndNichesAreNone) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Scene scene{seed};
    scene.add_room(4.0, 5.0, 3.0);
    // A case of 1 x 0.8 m, its corner towards the robot; and a recess of a metre in a wall.
    scene.add_wall({1.5, 0.2}, {2.2, 0.9}), scene.add_wall({1.5, 0.2}, {2.1, -0.4});
    scene.add_wall({-2.0, -3.0}, {-2.0, -1.8}), scene.add_wall({-2.0, -1.8}, {-1.2, -1.8});
    scene.add_wall({-1.2, -1.8}, {-1.2, -1.2}), scene.add_wall({-1.2, -1.2}, {0.0, -1.2});
    EXPECT_LT(scene.look().share_of_walls(), 0.06) << seed;
  }
}

TEST(PersonShapes, ACorridorOfPillarsIsNotThrownAway) {
  Scene scene{1};
  scene.add_room(20.0, 20.0, 1.6);
  int slim = 0;
  for (double x = -9.0; x <= 9.0; x += 1.5, ++slim) scene.add_person({x, 1.2}, 0.15), scene.add_person({x, -1.2}, 0.15);
  const auto marked = scene.look();  // pillars are as slim as people; what stands behind them counts
  EXPECT_GT(marked.walls, 100);
  EXPECT_LT(marked.share_of_walls(), 0.1);
}

TEST(PersonShapes, TheRoundIsClosed) {
  Scene scene{2};
  scene.add_room(4.0, 5.0, 3.0);
  scene.add_person({0.0, -1.2});  // across the end of the sweep
  const auto marked = scene.look();
  EXPECT_GT(marked.share_of_people(), 0.9);
}

TEST(PersonShapes, WithoutThemTheOthersStayInTheirOrder) {
  sensor_models::RangeSweep sweep;
  for (const double range : {1.0, 2.0, 3.0, 4.0}) sweep.beams.push_back({0.0, range, false});
  const sensor_models::RangeSweep rest = without(sweep, std::vector<std::uint8_t>{0, 1, 1, 0});
  ASSERT_EQ(rest.beams.size(), 2U);
  EXPECT_EQ(rest.beams[0].range, 1.0);
  EXPECT_EQ(rest.beams[1].range, 4.0);
}

TEST(PersonShapes, EmptySweepsAreEmpty) {
  EXPECT_TRUE(on_person_shapes({}).empty());
  sensor_models::RangeSweep none;
  none.beams.assign(10, {0.0, 10.0, true});
  const auto marks = on_person_shapes(none);
  EXPECT_EQ(std::count(marks.begin(), marks.end(), 1), 0);
}

}  // namespace
}  // namespace docent::localization::person_shapes_test
