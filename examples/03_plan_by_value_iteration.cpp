// Value iteration finds the cost of the way to a goal from everywhere at once; a way is steepest descent. When the map
// changes, only what lost its ground is computed anew. Here a robot crosses a museum; then its way is barred.
#include <docent/planning/value_iteration/route.h>

#include <string>
#include <vector>

#include "text_map.h"

namespace {

double length_of(docent::Point2 from, const std::vector<docent::Point2>& way) {
  double sum = 0.0;
  for (const docent::Point2 point : way) sum += docent::distance(std::exchange(from, point), point);
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string museum = example::argument_or_exit(argc, argv, "MUSEUM", DOCENT_MUSEUM);
  const docent::OccupancyGrid map = example::value_or_exit(docent::load_map(museum + "/map.yaml"));
  const docent::Point2 start{9.0, 3.6}, goal{23.7, 13.4};  // from the entrance to the Transrapid

  // Costs come from clearance: tight places are dear, what the body does not fit through is closed.
  docent::planning::RoutePlanner planner{map, {}, {}, {}};
  planner.set_goal(goal, 0.3);
  planner.settle(start, 1'000'000);  // any-time: with a smaller budget it goes on where it stopped
  const std::vector<docent::Point2> way = planner.way(start);
  if (way.empty()) return 1;
  example::print(map, way);
  std::printf("%.1f m; %zu offers of one cell to another\n\n", length_of(start, way),
              static_cast<std::size_t>(planner.values().relaxations()));

  // A school class stands across the middle of it: dear, not closed, for people move. The rest of the values stays.
  const std::uint64_t before = planner.values().relaxations();
  const docent::Point2 crowd = way[way.size() / 2];
  std::vector<bool> obstacles(planner.frame().size(), false);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const int columns = planner.frame().columns;
    const docent::CellIndex cell{static_cast<int>(i) % columns, static_cast<int>(i) / columns};
    obstacles[i] = docent::distance(planner.frame().centre(cell), crowd) < 1.5;
  }
  planner.set_obstacles(obstacles);
  planner.settle(start, 1'000'000);
  const std::vector<docent::Point2> round = planner.way(start);
  double nearest = 1e9;
  for (const docent::Point2 point : round) nearest = std::min(nearest, docent::distance(point, crowd));
  example::print(map, round);
  std::printf("%.1f m round the crowd, %.1f m from its middle; %zu more offers\n", length_of(start, round), nearest,
              static_cast<std::size_t>(planner.values().relaxations() - before));
  return !round.empty() && nearest > 1.5 && length_of(start, round) > length_of(start, way) ? 0 : 1;
}
