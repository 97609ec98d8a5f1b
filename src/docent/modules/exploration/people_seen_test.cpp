#include "docent/modules/exploration/people_seen.h"

#include <gtest/gtest.h>

namespace docent::modules {
namespace {

TEST(PeopleSeen, WhoWalksIsSomebodyAndWhatStandsMayBeAColumn) {
  PeopleSeen seen;
  docent_msgs::People people;
  people.people = {{1, 2.0F, 0.0F, 0.0F, 0.0F}, {2, 4.0F, 0.0F, 0.0F, 0.0F}};
  seen.note(people);
  EXPECT_TRUE(seen.walkers().empty());
  people.people[1].x = 4.9F;
  seen.note(people);
  ASSERT_EQ(seen.walkers().size(), 1U);
  EXPECT_NEAR(seen.walkers().front().x, 4.9, 1e-6);
  seen.note(people);
  EXPECT_EQ(seen.walkers().size(), 1U) << "who walked and stands now is still somebody";
  people.people.pop_back();
  seen.note(people);
  EXPECT_TRUE(seen.walkers().empty());
}

TEST(PeopleSeen, ABeamIsAskedOfTheMap) {
  OccupancyGrid map;
  map.frame = {200, 200, 0.05, {-5.0, -5.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 60; row < 140; ++row)
    for (int column = 60; column < 140; ++column)
      map.cells[map.frame.index({column, row})] = column == 139 ? OccupancyGrid::kOccupied : OccupancyGrid::kFree;
  Keyframes::Look look;
  look.sweep.beams = {{0.0, 1.0, false}, {0.0, 1.96, false}, {1.57, 4.0, false}, {3.0, 10.0, true}};
  const auto message = person_beams(look, {}, map);
  ASSERT_EQ(message.origins.size(), 4U);
  EXPECT_EQ(message.origins[0], static_cast<int>(sensor_models::BeamOrigin::not_map)) << "on floor that was free";
  EXPECT_EQ(message.origins[1], static_cast<int>(sensor_models::BeamOrigin::map));
  EXPECT_EQ(message.origins[2], static_cast<int>(sensor_models::BeamOrigin::unknown)) << "nobody has looked there";
  EXPECT_EQ(message.origins[3], static_cast<int>(sensor_models::BeamOrigin::unknown));
  EXPECT_LT(message.ranges[3], 0.0F);
  EXPECT_EQ(message.x.size(), 1U);
}

}  // namespace
}  // namespace docent::modules
