#include "docent/apps/laboratory/score_map/map_score.h"

#include <gtest/gtest.h>

#include "docent/simulator/office/office.h"
#include "docent/simulator/world/survey.h"

namespace docent::apps::score_map_command {
namespace {

simulator::SurveyParams without_errors() {
  simulator::SurveyParams params;
  params.least_error = params.greatest_error = 0.0;
  params.moved_share = params.missing_share = 0.0;
  return params;
}

TEST(MapScore, FindsAMapOfAnotherFrameAndMeasuresIt) {
  const auto office = simulator::draw_office(3);
  OccupancyGrid map = simulator::survey(office.world, without_errors(), Rng{1}).map;
  const Point2 shift{7.3, -4.1};
  map.frame.origin = map.frame.origin + shift;
  const auto score = score_map(map, office.world);
  ASSERT_TRUE(score) << score.error().message;
  EXPECT_NEAR(score->world_from_map.x, -shift.x, 0.1);
  EXPECT_NEAR(score->world_from_map.y, -shift.y, 0.1);
  EXPECT_LT(score->wall_error, 0.08) << "a survey fills its walls";
  EXPECT_GT(score->found, 0.9);
}

TEST(MapScore, CountsWhatIsNowhereInTheWorld) {
  const auto office = simulator::draw_office(3);
  OccupancyGrid map = simulator::survey(office.world, without_errors(), Rng{1}).map;
  const auto before = score_map(map, office.world);
  std::size_t added = 0;
  for (std::size_t i = 0; i < map.cells.size() && added < 500; i += 11) {
    if (map.cells[i] != OccupancyGrid::kFree) continue;
    map.cells[i] = OccupancyGrid::kOccupied;
    ++added;
  }
  const auto after = score_map(map, office.world);
  ASSERT_TRUE(before && after);
  EXPECT_GT(after->ghosts, before->ghosts + added / 3);
}

TEST(MapScore, RefusesWhatHoldsNothing) {
  const auto office = simulator::draw_office(3);
  OccupancyGrid map = simulator::survey(office.world, without_errors(), Rng{1}).map;
  std::fill(map.cells.begin(), map.cells.end(), OccupancyGrid::kFree);
  EXPECT_FALSE(score_map(map, office.world));
}

}  // namespace
}  // namespace docent::apps::score_map_command
