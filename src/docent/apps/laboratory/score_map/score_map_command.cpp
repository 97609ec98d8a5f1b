#include "docent/apps/laboratory/score_map/score_map_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/laboratory/score_map/map_score.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/map_note.h"
#include "docent/base/files.h"

namespace docent::apps::score_map_command {
namespace {

struct ScoreOptions {
  std::string map;
  std::string world;
  std::string report;
};

void run(const ScoreOptions& options) {
  const OccupancyGrid map = load_and_say(options.map);
  const simulator::World world = value_or_fail(simulator::load_world(options.world));
  const MapScore score = value_or_fail(score_map(map, world));
  const double ghost_share = static_cast<double>(score.ghosts) / static_cast<double>(score.free);
  std::printf("%zu occupied cells, %.3f m from true structure in the mean, 19 of 20 within %.3f m\n", score.occupied,
              score.wall_error, score.wall_error_p95);
  std::printf(
      "%zu ghosts more than 0.3 m off, %.3f %% of %zu free cells; %.1f %% of the surfaces beside free floor found\n",
      score.ghosts, 100.0 * ghost_share, score.free, 100.0 * score.found);
  std::printf("%.2f %% of %.0f m2 of floor covered that lasers can see from where the robot can drive\n",
              100.0 * score.covered, score.floor);
  if (options.report.empty()) return;
  const nlohmann::json report{
      {"world_from_map", {score.world_from_map.x, score.world_from_map.y, score.world_from_map.theta.radians()}},
      {"occupied", score.occupied},
      {"free", score.free},
      {"wall_error_m", score.wall_error},
      {"wall_error_p95_m", score.wall_error_p95},
      {"ghosts", score.ghosts},
      {"floor_m2", score.floor},
      {"covered", score.covered},
      {"found", score.found}};
  value_or_fail(write_file_atomically(options.report, report.dump(2) + "\n"));
}

}  // namespace

void add_score_map_command(CLI::App& app) {
  auto* command = app.add_subcommand("score-map", "How far a learned map is from the true world of a simulation");
  auto options = std::make_shared<ScoreOptions>();
  command->add_option("--map", options->map, "map_server YAML file")->required();
  command->add_option("--world", options->world, "simulation.yaml")->required();
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::score_map_command
