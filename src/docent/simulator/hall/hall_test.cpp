#include "docent/simulator/hall/hall.h"

#include <gtest/gtest.h>

#include "docent/simulator/crowd/walkable_floor.h"

namespace docent::simulator {
namespace {

TEST(Hall, IsFreeOfFurnitureFromStartToGoal) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Hall hall = draw_hall(Rng{seed});
    const WalkableFloor floor{hall.world};
    EXPECT_TRUE(floor.is_clear(hall.start.position(), hall.goal, 0.6)) << "seed " << seed;
    EXPECT_GT(floor.free_area(), 100.0);
    EXPECT_NEAR(distance(hall.start.position(), hall.goal), 11.4, 1e-9);
  }
}

TEST(Hall, HasCasesAndTwoToFourTalksApart) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto attractions = draw_hall(Rng{seed}).world.attractions;
    ASSERT_GE(attractions.size(), 8U);
    ASSERT_LE(attractions.size(), 10U);
    for (std::size_t i = 6; i < attractions.size(); ++i) {
      for (std::size_t k = 6; k < i; ++k) EXPECT_GT(distance(attractions[i].centre, attractions[k].centre), 2.49);
    }
  }
}

TEST(Hall, IsTheSameForASeed) {
  const Hall one = draw_hall(Rng{7});
  const Hall two = draw_hall(Rng{7});
  const Hall other = draw_hall(Rng{8});
  EXPECT_EQ(one.world.attractions.back().centre, two.world.attractions.back().centre);
  EXPECT_NE(one.world.attractions.back().centre, other.world.attractions.back().centre);
}

}  // namespace
}  // namespace docent::simulator
