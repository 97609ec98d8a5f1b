#include "docent/people/body_fit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/base/random.h"
#include "docent/people/testing.h"

namespace docent::people {
namespace {

TEST(BodyFit, FindsOneBodyOfAnySize) {
  for (const double radius : {0.16, 0.22, 0.28}) {
    Scene scene;
    scene.add_disc({2.5, 0.4}, radius);
    const BodyFit fit = fit_bodies(scene.ends_on_things(), {}, {});
    ASSERT_EQ(fit.bodies.size(), 1U) << radius;
    EXPECT_LT(distance(fit.bodies[0].centre, {2.5, 0.4}), 0.07) << radius;
  }
}

TEST(BodyFit, PartsPeopleShoulderToShoulder) {
  Rng rng{5};
  constexpr int kTrials = 60;
  double gain = 0.0;
  int like_a_thing = 0;
  for (int i = 0; i < kTrials; ++i) {
    Scene scene{&rng};
    const double range = rng.uniform(1.0, 4.0);
    const std::vector<Point2> people{{range, -0.5}, {range + rng.uniform(-0.1, 0.1), 0.0}, {range, 0.5}};
    for (const Point2 person : people) scene.add_disc(person, 0.24);
    const BodyFit fit = fit_bodies(scene.ends_on_things(), {}, {});
    EXPECT_EQ(fit.bodies.size(), 3U) << range;
    gain += fit.thing_gain / kTrials;
    like_a_thing += fit.thing_gain > 1.0 ? 1 : 0;
    for (const Point2 person : people) {
      EXPECT_TRUE(std::any_of(fit.bodies.begin(), fit.bodies.end(), [&](const Body& body) {
        return distance(body.centre, person) < 0.2;
      })) << range;
    }
  }
  EXPECT_LT(gain, -4.0);
  EXPECT_LE(like_a_thing, kTrials / 20) << "a sweep may err: trackers weigh many";
}

TEST(BodyFit, KnowsABenchAndAColumnFromPeople) {
  Rng rng{6};
  for (int i = 0; i < 40; ++i) {
    Scene bench{&rng};
    const double range = rng.uniform(1.5, 3.5);
    const double turned = rng.uniform(-0.6, 0.6);
    bench.add_wall({range - 0.8 * turned, -0.8}, {range + 0.8 * turned, 0.8});
    EXPECT_GT(fit_bodies(bench.ends_on_things(), {}, {}).thing_gain, 1.0) << range << " " << turned;
    // Nor when a tracker already believes in people there.
    const std::vector<Point2> known{{range, -0.5}, {range, 0.0}, {range, 0.5}};
    EXPECT_GT(fit_bodies(bench.ends_on_things(), {}, known).thing_gain, 1.0) << range << " " << turned;
    Scene column{&rng};
    column.add_disc({range + 0.4, 0.0}, 0.6);
    EXPECT_GT(fit_bodies(column.ends_on_things(), {}, {}).thing_gain, 1.0) << range;
  }
}

}  // namespace
}  // namespace docent::people
