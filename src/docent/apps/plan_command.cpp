#include "docent/apps/plan_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "docent/apps/arguments.h"
#include "docent/apps/command.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/pictures/colors.h"
#include "docent/pictures/drawing.h"
#include "docent/pictures/map_picture.h"
#include "docent/planning/value_iteration/route.h"

namespace docent {
namespace {

struct Options {
  std::string map;
  std::string from;
  std::vector<std::string> goals;
  std::string planner = "shortest";
  std::string picture;
  double radius = 0.265;
};

/// The value function under the way: pale near the goals, dark far from them, clear where no way leads.
void draw_values(Image& image, const MapView& view, const ValueIteration& values) {
  const GridFrame& frame = values.frame();
  const auto is_shown = [&](CellIndex cell) {
    return values.value(cell) < ValueIteration::kClosed && values.cost(cell) < ValueIteration::kClosed;
  };
  const auto for_cells = [&](const auto& work) {
    for (int row = 0; row < frame.rows; ++row)
      for (int column = 0; column < frame.columns; ++column)
        if (is_shown({column, row})) work(CellIndex{column, row});
  };
  float most = 1e-6F;
  for_cells([&](CellIndex cell) { most = std::max(most, values.value(cell)); });
  const Point2 half{0.5 * frame.resolution, 0.5 * frame.resolution};
  for_cells([&](CellIndex cell) {
    const Point2 centre = frame.centre(cell);
    const Color color = heat(static_cast<double>(values.value(cell) / most));
    fill_rectangle(image, view.pixel({centre.x - half.x, centre.y + half.y}),
                   view.pixel({centre.x + half.x, centre.y - half.y}), with_alpha(color, 170));
  });
}

void draw_plan(const Options& options, const OccupancyGrid& map, const RoutePlanner& planner,
               const std::vector<Point2>& way, const std::vector<Point2>& goals) {
  const MapView view = MapView::whole(map.frame);
  Image image = draw_map(map, view);
  draw_values(image, view, planner.values());
  draw_path(image, view, way, 2.5, distinct(0));
  draw_robot(image, view, {way[0].x, way[0].y, direction(way[0], way[1])}, options.radius, distinct(1));
  for (const Point2& goal : goals) fill_disc(image, view.pixel(goal), 5.0, distinct(2));
  value_or_fail(save_png(image, options.picture));
  std::printf("picture %s\n", options.picture.c_str());
}

void plan(const Options& options) {
  const Point2 from = parse_point("--from", options.from);
  std::vector<Point2> goals;
  for (const std::string& goal : options.goals) goals.push_back(parse_point("--to", goal));
  const OccupancyGrid map = value_or_fail(load_map(options.map));
  RouteParams params;
  params.robot_radius = options.radius;
  // About 15 cm a cell, whatever the map's resolution.
  params.coarsening = std::max(1, static_cast<int>(std::lround(0.15 / map.frame.resolution)));
  value_or_fail(params.validate());
  RoutePlanner planner{map, {}, {}, params};
  if (planner.is_closed(from)) throw CommandFailed{"--from " + options.from + ": no room for the robot there"};
  for (std::size_t i = 0; i < goals.size(); ++i)
    if (planner.is_closed(goals[i])) throw CommandFailed{"--to " + options.goals[i] + ": no room for the robot there"};
  planner.set_goals(goals, 0.1);
  while (!planner.iterate(100)) {
  }
  std::vector<Point2> way = planner.way(from);
  if (way.empty()) throw CommandFailed{"no way from " + options.from + " to " + options.goals.front()};
  way.insert(way.begin(), from);
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += distance(way[i - 1], way[i]);
  const auto nearest = std::min_element(goals.begin(), goals.end(), [&](Point2 a, Point2 b) {
    return distance(a, way.back()) < distance(b, way.back());
  });
  if (goals.size() > 1)
    std::printf("to %s\n", options.goals[static_cast<std::size_t>(nearest - goals.begin())].c_str());
  std::printf("length %.2f m, cost %.2f m of free floor, %zu points\n", length, planner.cost_from(from),
              way.size() - 1);
  if (!options.picture.empty()) draw_plan(options, map, planner, way, goals);
}

}  // namespace

void add_plan_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan",
                                         "Plan the way through a map to a goal or to the nearest of several, with its "
                                         "cost and a picture of\nthe value function");
  command->add_option("--map", options->map, "map_server YAML file")->required();
  command->add_option("--from", options->from, "X,Y in metres, map frame")->required();
  command->add_option("--to,--goal", options->goals, "X,Y in metres, map frame; given again: the nearest by cost")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--planner", options->planner, "shortest")
      ->check(CLI::IsMember({"shortest"}))
      ->capture_default_str();
  command->add_option("--radius", options->radius, "radius of the robot [m]")->capture_default_str();
  command->add_option(
      "--picture", options->picture,
      "PNG file to write: the map, the value function (pale near the goals, dark far from them) and the way");
  command->callback([options] { plan(*options); });
}

}  // namespace docent
