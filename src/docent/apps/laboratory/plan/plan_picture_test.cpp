#include "docent/apps/laboratory/plan/plan_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent::apps::plan_command {
namespace {

std::string svg_of(const pictures::Figure& figure) {
  const auto path = std::filesystem::temp_directory_path() / ("docent_plan_" + std::to_string(getpid()) + ".svg");
  EXPECT_TRUE(figure.save(path));
  const auto svg = read_file(path);
  std::filesystem::remove(path);
  return svg ? *svg : "";
}

OccupancyGrid floor() {
  OccupancyGrid map;
  map.frame = {40, 20, 0.1, {0.0, 0.0}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  return map;
}

TEST(PlanPicture, SaysWhatItsColoursAndLinesMean) {
  const OccupancyGrid map = floor();
  planning::ValueIteration values{map.frame};
  values.set_costs(std::vector<float>(map.frame.size(), 0.1F));
  const planning::ValueIteration::Goal goals[] = {{{35, 10}, 0.0F}};
  values.set_goals(goals);
  while (!values.iterate(100)) {
  }
  const std::vector<DrawnWay> ways{{"shortest", {{0.5, 1.0}, {3.5, 1.0}}, 3.0, pictures::colors::kBlue}};
  const std::string svg = svg_of(draw_plan(map, ways, {{3.5, 1.0}}, 0.2, {&values}));
  for (const char* word :
       {"x [m], y [m], cost to the goal [m of free floor]", "shortest way, 3.0 m", "start", "goal", "occupied"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  const std::string plain = svg_of(draw_plan(map, ways, {{3.5, 1.0}}, 0.2, {}));
  EXPECT_EQ(plain.find("cost to the goal"), std::string::npos);
}

}  // namespace
}  // namespace docent::apps::plan_command
