#include "docent/apps/laboratory/plan/plan_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "docent/apps/laboratory/plan/plan_picture.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/map_note.h"
#include "docent/base/files.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/museum/museum.h"
#include "docent/planning/coastal/coastal_planner.h"
#include "docent/planning/value_iteration/route.h"

namespace docent::apps::plan_command {
namespace {

constexpr double kKnownStart = 0.05;  // [m] to which the pose is known at the start of a coastal way
constexpr double kUsualWeight = 0.2;  // [1/nat] of --planner coastal
constexpr int kCoarser = 2;           // a cell of the coastal planner = so many planning cells

struct Options {
  std::string map;
  std::string museum;
  std::string from;
  std::vector<std::string> goals;
  std::string planner = "shortest";
  std::string picture;
  std::string ways;
  double radius = 0.265;
  planning::CoastalParams coastal;
};

struct Way {
  std::string name;
  std::vector<Point2> points;  ///< [m], map, with its start
  double length = 0.0;         ///< [m]
  double entropy = 0.0;        ///< [nat] to be expected at the goal
};

Way way_of(const std::string& name, planning::RoutePlanner& planner, Point2 from) {
  while (!planner.iterate(100)) {
  }
  Way way{name, {from}};
  for (const Point2& point : planner.way(from)) {
    way.length += distance(way.points.back(), point);
    way.points.push_back(point);
  }
  return way;
}

void expect_entropy(Way& way, const planning::CoastalPlanner& coastal) {
  const auto variances = coastal.variances_along(way.points.front(), way.points, kKnownStart * kKnownStart);
  way.entropy = coastal.uncertainty().entropy(variances.back());
}

Result<void> save_ways(const std::vector<Way>& ways, const std::string& path) {
  nlohmann::json json;
  for (const Way& way : ways) {
    auto& entry = json[way.name];
    entry = {{"length_m", way.length}, {"entropy_at_goal", way.entropy}, {"points", nlohmann::json::array()}};
    for (const Point2& point : way.points) entry["points"].push_back({point.x, point.y});
  }
  return write_file_atomically(path, json.dump() + "\n");
}

/// The floor that the ways lead over: of a museum, or of a map alone.
planning::RoutePlanner planner_of(const OccupancyGrid& map, const std::optional<museum::Museum>& museum,
                                  const Options& options) {
  planning::RouteParams params;
  params.robot_radius = options.radius;
  // About 15 cm a cell, whatever the map's resolution.
  params.coarsening = std::max(1, static_cast<int>(std::lround(0.15 / map.frame.resolution)));
  value_or_fail(params.validate());
  if (!museum) return {map, {}, {}, params};
  return {map, museum->hazard_polygons(), museum->area, params};
}

void plan(Options& options) {
  if (options.planner == "coastal" && options.coastal.weight == 0.0) options.coastal.weight = kUsualWeight;
  const Point2 from = parse_point("--from", options.from);
  std::vector<Point2> goals;
  for (const std::string& goal : options.goals) goals.push_back(parse_point("--to", goal));
  if (options.coastal.weight > 0.0 && goals.size() > 1) throw CommandFailed{"--coastal plans to one goal", 2};
  if (options.map.empty() == options.museum.empty()) throw CommandFailed{"either --map or --museum is needed", 2};
  value_or_fail(options.coastal.validate());
  std::optional<museum::Museum> museum;
  if (!options.museum.empty()) museum = load_museum_and_say(options.museum);
  const OccupancyGrid map = museum ? museum->map : load_and_say(options.map);
  planning::RoutePlanner planner = planner_of(map, museum, options);
  if (planner.is_closed(from)) throw CommandFailed{"--from " + options.from + ": no room for the robot there"};
  for (std::size_t i = 0; i < goals.size(); ++i)
    if (planner.is_closed(goals[i])) throw CommandFailed{"--to " + options.goals[i] + ": no room for the robot there"};
  planner.set_goals(goals, 0.1);
  std::vector<Way> ways{way_of("shortest", planner, from)};
  if (ways[0].points.size() < 2) throw CommandFailed{"no way from " + options.from + " to " + options.goals.front()};
  if (goals.size() > 1) {
    const auto nearest = std::min_element(goals.begin(), goals.end(), [&](Point2 a, Point2 b) {
      return distance(a, ways[0].points.back()) < distance(b, ways[0].points.back());
    });
    std::printf("to %s\n", options.goals[static_cast<std::size_t>(nearest - goals.begin())].c_str());
  }
  std::printf("length %.2f m, cost %.2f m of free floor, %zu points\n", ways[0].length, planner.cost_from(from),
              ways[0].points.size() - 1);

  std::optional<planning::CoastalPlanner> coastal;
  if (options.coastal.weight > 0.0) {
    coastal.emplace(map, planning::CoastalFloor::of(planner.frame(), planner.static_costs(), kCoarser),
                    options.coastal);
    coastal->set_goal(goals.front(), 0.1);
    while (!coastal->iterate(100)) {
    }
    planner.prefer(coastal->way(from, kKnownStart * kKnownStart));
    ways.push_back(way_of("coastal", planner, from));
    for (Way& way : ways) expect_entropy(way, *coastal);
    std::printf("coastal: length %.2f m; entropy to be expected at the goal %.2f nat, by the shortest way %.2f\n",
                ways[1].length, ways[1].entropy, ways[0].entropy);
  }
  if (!options.ways.empty()) value_or_fail(save_ways(ways, options.ways));
  if (options.picture.empty()) return;
  std::vector<DrawnWay> drawn;
  for (const Way& way : ways)
    drawn.push_back(
        {way.name, way.points, way.length, drawn.empty() ? pictures::colors::kBlue : pictures::colors::kRed});
  const PlanGround ground{&planner.values(), coastal ? &coastal->information() : nullptr,
                          options.coastal.uncertainty.heading_scale};
  value_or_fail(draw_plan(map, drawn, goals, options.radius, ground).save(options.picture));
  std::printf("picture %s\n", options.picture.c_str());
}

}  // namespace

void add_plan_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan", "Plan the way through a map to a goal, with its cost and a picture");
  command->add_option("--map", options->map, "map_server YAML file");
  command->add_option("--museum", options->museum, "folder of a museum, instead of a map: with its area and hazards");
  command->add_option("--from", options->from, "X,Y in metres, map frame")->required();
  command->add_option("--to,--goal", options->goals, "X,Y in metres, map frame; given again: the nearest by cost")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--planner", options->planner, "shortest, or coastal for --coastal 0.2")
      ->check(CLI::IsMember({"shortest", "coastal"}))
      ->capture_default_str();
  command
      ->add_option("--coastal", options->coastal.weight,
                   "a second way, which keeps the pose known: metres that a nat of entropy adds to a metre [1/nat]")
      ->capture_default_str();
  command->add_option("--range", options->coastal.places.range, "reach of the laser [m], for --coastal")
      ->capture_default_str();
  command->add_option("--blocked", options->coastal.places.blocked, "share of its beams that people hide, 0..0.95")
      ->capture_default_str();
  command->add_option("--radius", options->radius, "radius of the robot [m]")->capture_default_str();
  command->add_option("--ways", options->ways, "JSON file to write: the ways and what was said of them")
      ->check(output_file());
  command
      ->add_option("--picture", options->picture,
                   "to write: the ways over the value function, pale near the goals and dark far from\n"
                   "them; with --coastal over the information of places, dark where a scan tells most")
      ->check(output_picture());
  command->callback([options] { plan(*options); });
}

}  // namespace docent::apps::plan_command
