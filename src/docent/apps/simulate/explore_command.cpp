#include "docent/apps/simulate/explore_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/log.h"
#include "docent/apps/shared/map_note.h"
#include "docent/apps/shared/temporary_folder.h"
#include "docent/apps/simulate/simulation_run.h"
#include "docent/base/files.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/museum/museum.h"
#include "docent/pictures/map_picture.h"

namespace docent::apps::simulate_command {
namespace {

struct ExploreOptions {
  SimulationRunOptions run;
  std::string start;
  double most_hours = 2.0;
  std::string out;
  std::string picture_format = "png";
  bool quiet = false;
};

std::vector<Point2> way_of(const std::filesystem::path& poses) {
  std::vector<Point2> way;
  std::ifstream file{poses};
  for (std::string line; std::getline(file, line);) {
    std::istringstream words{line};
    Point2 at;
    if (words >> at.x >> at.y) way.push_back(at);
  }
  return way;
}

pictures::Figure draw(const OccupancyGrid& map, const std::vector<Point2>& way, const docent_msgs::Exploration& state) {
  constexpr double kPoseDot = 2.0;   // [points]
  constexpr double kPlaceDot = 6.0;  // [points]
  pictures::Figure figure{"Explored: " + std::to_string(static_cast<int>(std::lround(state.known_m2))) + " m²"};
  pictures::Axes& axes = figure.add(pictures::Axes::metres(map.frame));
  pictures::draw_map(axes, map);
  pictures::draw_points(axes, way, kPoseDot, pictures::distinct(0));
  std::vector<Point2> unreached;
  for (std::size_t i = 0; i < std::min(state.unreached_x.size(), state.unreached_y.size()); ++i)
    unreached.push_back({state.unreached_x[i], state.unreached_y[i]});
  pictures::draw_points(axes, unreached, kPlaceDot, pictures::distinct(1));
  pictures::add_map_legend(figure);
  figure.add_legend(pictures::legend_disc("robot at a scan", kPoseDot, pictures::distinct(0)));
  if (!unreached.empty())
    figure.add_legend(pictures::legend_disc("not reached or not seen into", kPlaceDot, pictures::distinct(1)));
  return figure;
}

std::string line_of(const docent_msgs::Exploration& state, double minutes) {
  char text[160];
  std::snprintf(text, sizeof text, "%.1f min: %s, %.0f m2 known, %.0f m driven, %u cells to explore, %u loops", minutes,
                state.state.c_str(), static_cast<double>(state.known_m2), static_cast<double>(state.way_m),
                state.frontier, state.loops);
  return text;
}

/// @returns what the robot says in the end
docent_msgs::Exploration drive(SimulationRun& run, const ExploreOptions& options) {
  Progress progress{::isatty(STDERR_FILENO) != 0};
  const auto start = std::chrono::steady_clock::now();
  const Time end = time_from_seconds(options.most_hours * 3600.0);
  docent_msgs::Exploration state;
  while (run.now() < end && state.state != "done" && state.state != "stranded") {
    value_or_fail(run.run_until(run.now() + seconds(5.0)));
    state = run.exploration().value_or(docent_msgs::Exploration{});
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double done = to_seconds(run.now()) / to_seconds(end);
    if (options.quiet || !progress.is_due(done, wall_s)) continue;
    std::fputs(progress.shown(line_of(state, to_seconds(run.now()) / 60.0)).c_str(), stderr);
  }
  if (!options.quiet) std::fputs(progress.end().c_str(), stderr);
  return state;
}

void explore(ExploreOptions& options) {
  if (!(options.most_hours > 0.0 && options.most_hours <= 100.0)) throw CommandFailed{"--hours must be in (0, 100]", 2};
  const museum::Museum museum =
      options.quiet ? value_or_fail(museum::load_museum(options.run.museum)) : load_museum_and_say(options.run.museum);
  options.run.explore = options.start.empty() ? museum.home : parse_pose("--start", options.start);
  const std::filesystem::path out{options.out};
  std::error_code code;
  std::filesystem::create_directories(out, code);
  if (code) throw CommandFailed{options.out + ": cannot be made: " + code.message()};
  const TemporaryFolder temporary;
  if (options.run.state.empty()) options.run.state = temporary.path().string();
  const auto run = value_or_fail(SimulationRun::create(options.run));
  const docent_msgs::Exploration state = drive(*run, options);
  value_or_fail(run->finish());
  const double minutes = to_seconds(run->now()) / 60.0;
  if (state.state != "done" && state.state != "stranded")
    throw CommandFailed{"not done after " + std::to_string(options.most_hours) + " h: " + line_of(state, minutes)};
  const std::filesystem::path explored = std::filesystem::path{options.run.state} / "explored";
  const OccupancyGrid map = value_or_fail(load_map(explored / "map.yaml"));
  value_or_fail(save_map(map, out / "map"));
  value_or_fail(draw(map, way_of(explored / "poses.txt"), state).save(out / ("map." + options.picture_format)));
  nlohmann::json report = nlohmann::json::parse(run->report_json());
  nlohmann::json unreached = nlohmann::json::array();
  for (std::size_t i = 0; i < state.unreached_x.size(); ++i)
    unreached.push_back({state.unreached_x[i], state.unreached_y[i]});
  report["exploration"] = {{"minutes", minutes},   {"known_m2", state.known_m2}, {"way_m", state.way_m},
                           {"loops", state.loops}, {"unreached", unreached},     {"warning", state.warning},
                           {"state", state.state}};
  value_or_fail(write_file_atomically(out / "report.json", report.dump(2) + "\n"));
  std::printf("%s\n", line_of(state, minutes).c_str());
  std::printf("%s: %d x %d cells; %zu places not reached or not seen into\n", (out / "map.yaml").c_str(),
              map.frame.columns, map.frame.rows, state.unreached_x.size());
  if (!options.quiet) say_classes((out / "map.yaml").string(), map, {});
  if (state.state == "stranded")
    throw CommandFailed{"the map is made, but the exploration is not done: " + state.warning};
  if (!state.warning.empty()) std::fprintf(stderr, "warning: do not trust this map: %s\n", state.warning.c_str());
}

}  // namespace

void add_explore_command(CLI::App& app, std::shared_ptr<RobotMaker> robot) {
  auto options = std::make_shared<ExploreOptions>();
  options->run.robot_maker = std::move(robot);
  options->run.museum = default_museum();
  options->run.crowd = "empty";
  options->run.requests_per_hour = 0.0;
  CLI::App* command = app.add_subcommand(
      "explore",
      "A robot without a map maps a simulated museum by itself, faster than real time; a real one: up --explore");
  command->add_option("--museum", options->run.museum, "museum folder: its hazards and area are known, its map is not")
      ->capture_default_str();
  command->add_option("--out", options->out, "folder for map.yaml, map.pgm, a picture and report.json")
      ->check(output_folder())
      ->required();
  command->add_option("--start", options->start, "X,Y,DEG where the robot begins; without: the museum's home")
      ->check(pose_option());
  command
      ->add_option("--scenario", options->run.scenario,
                   "file of timed events, and of what is built or told otherwise than robot.yaml and --start say")
      ->check(CLI::ExistingFile);
  command->add_option("--robot", options->run.robot, "robot.yaml; without: all defaults");
  command->add_option("--set", options->run.settings, "section.key=value over robot.yaml; may be repeated");
  command->add_option("--hours", options->most_hours, "virtual hours after which it is given up")
      ->capture_default_str();
  add_seed(*command, "--seed", options->run.seed, "same seed, same run");
  command->add_option("--crowd", options->run.crowd, "persons: empty, quiet, busy, packed")
      ->check(CLI::IsMember({"empty", "quiet", "busy", "packed"}))
      ->capture_default_str();
  command->add_option("--people", options->run.people, "so many persons instead of the crowd's density")
      ->check(CLI::Range(0, 10000));
  command->add_option("--state", options->run.state, "folder of checkpoints; without: a temporary one")
      ->check(kept_folder());
  command->add_option("--record", options->run.recording, "MCAP file of all messages and the truth")
      ->check(output_file());
  command->add_option("--event-log", options->run.event_log, "CSV file to write: touches, with times and places")
      ->check(output_file());
  command->add_option("--health-log", options->run.health_log, "CSV file to write: what the modules said of themselves")
      ->check(output_file());
  command
      ->add_option("--drive-log", options->run.drive_log,
                   "CSV file to write: how the robot drives beside what collision avoidance says")
      ->check(output_file());
  add_picture_format(*command, options->picture_format);
  command->add_flag("--quiet", options->quiet, "no progress");
  command->callback([options] { explore(*options); });
}

}  // namespace docent::apps::simulate_command
