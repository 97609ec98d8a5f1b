#include "docent/apps/plan_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

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
  std::string to;
  std::string planner = "shortest";
  std::string picture;
  double radius = 0.265;
};

void plan(const Options& options) {
  const Point2 from = parse_point("--from", options.from);
  const Point2 to = parse_point("--to", options.to);
  const OccupancyGrid map = value_or_fail(load_map(options.map));
  RouteParams params;
  params.robot_radius = options.radius;
  // About 15 cm a cell, whatever the map's resolution.
  params.coarsening = std::max(1, static_cast<int>(std::lround(0.15 / map.frame.resolution)));
  value_or_fail(params.validate());
  RoutePlanner planner{map, {}, {}, params};
  if (planner.is_closed(from)) throw CommandFailed{"--from " + options.from + ": no room for the robot there"};
  if (planner.is_closed(to)) throw CommandFailed{"--to " + options.to + ": no room for the robot there"};
  planner.set_goal(to, 0.1);
  while (!planner.iterate(100)) {
  }
  const auto way = planner.way(from);
  if (way.empty()) throw CommandFailed{"no way from " + options.from + " to " + options.to};
  double length = distance(from, way.front());
  for (std::size_t i = 1; i < way.size(); ++i) length += distance(way[i - 1], way[i]);
  std::printf("length %.2f m, cost %.2f m of free floor, %zu points\n", length, planner.cost_from(from), way.size());
  if (options.picture.empty()) return;
  const MapView view = MapView::whole(map.frame);
  Image image = draw_map(map, view);
  std::vector<Point2> points{from};
  points.insert(points.end(), way.begin(), way.end());
  draw_path(image, view, points, 2.5, distinct(0));
  draw_robot(image, view, {from.x, from.y, direction(from, way.front())}, options.radius, distinct(1));
  fill_disc(image, view.pixel(to), 5.0, distinct(2));
  value_or_fail(save_png(image, options.picture));
  std::printf("picture %s\n", options.picture.c_str());
}

}  // namespace

void add_plan_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan", "Plan one way through a map, with its cost and a picture");
  command->add_option("--map", options->map, "map_server YAML file")->required();
  command->add_option("--from", options->from, "X,Y in metres, map frame")->required();
  command->add_option("--to", options->to, "X,Y in metres, map frame")->required();
  command->add_option("--planner", options->planner, "shortest")
      ->check(CLI::IsMember({"shortest"}))
      ->capture_default_str();
  command->add_option("--radius", options->radius, "radius of the robot [m]")->capture_default_str();
  command->add_option("--picture", options->picture, "PNG file to write");
  command->callback([options] { plan(*options); });
}

}  // namespace docent
